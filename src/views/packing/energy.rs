//! Repulsion between the points of a band, in coordinates without constraints.

use super::Region;
use crate::geometry::Vector;

/// Numbers per free point: see [`Repulsion::points`].
pub(super) const COORDINATES: usize = 4;
/// Terms below this share of the largest do not count.
const NEGLIGIBLE: f64 = 1e-17;

/// The energy `sum over pairs of (reference / squared distance)^(2^doublings)`.
pub(super) struct Repulsion<'a> {
    pub region: &'a Region,
    /// Squared distance that has energy 1.
    pub reference: f64,
    /// The exponent's binary logarithm: a power of two needs only multiplications.
    pub doublings: u32,
    /// Pairs that may matter, as indices of points; all others are too far apart.
    pub pairs: Vec<(u32, u32)>,
    points: Vec<Vector>,
    gradients: Vec<Vector>,
}

impl<'a> Repulsion<'a> {
    /// The repulsion at these `points`: the reference is their least squared distance; pairs
    /// further apart than `reach` times the least distance are left out if their energy is
    /// negligible.
    pub(super) fn at(points: &[Vector], region: &'a Region, doublings: u32, reach: f64) -> Self {
        let reference = super::least_squared_distance(points).max(1e-12);
        let far = reference * reach * reach;
        let mut pairs = Vec::new();
        for (i, a) in points.iter().enumerate() {
            for (j, b) in points.iter().enumerate().take(i) {
                if (a - b).norm_squared() <= far {
                    pairs.push((i as u32, j as u32));
                }
            }
        }
        let zero = vec![Vector::zeros(); points.len()];
        Repulsion { region, reference, doublings, pairs, points: points.to_vec(), gradients: zero }
    }

    /// Coordinates of the free points (all but the first): four numbers each. The first two give
    /// the azimuth as a vector in the plane, the last two the height: `z` is the middle of the
    /// region plus half its width times the sine of the vector's angle. The rim is an ordinary
    /// point of these coordinates (the height folds back there), so nothing needs a constraint.
    pub(super) fn coordinates(&self) -> Vec<f64> {
        let half = 0.5 * (self.region.high - self.region.low);
        let middle = 0.5 * (self.region.high + self.region.low);
        let mut coordinates = Vec::with_capacity(COORDINATES * self.points.len());
        for point in &self.points[1..] {
            let horizontal = (point.x * point.x + point.y * point.y).sqrt();
            let (ax, ay) =
                if horizontal > 0.0 { (point.x / horizontal, point.y / horizontal) } else { (1.0, 0.0) };
            let sine = if half > 0.0 { ((point.z - middle) / half).clamp(-1.0, 1.0) } else { 0.0 };
            coordinates.extend([ax, ay, sine, (1.0 - sine * sine).sqrt()]);
        }
        coordinates
    }

    /// The points with these coordinates, the fixed one first.
    pub(super) fn points(&mut self, coordinates: &[f64]) -> &[Vector] {
        let half = 0.5 * (self.region.high - self.region.low);
        let middle = 0.5 * (self.region.high + self.region.low);
        for (point, c) in self.points[1..].iter_mut().zip(coordinates.chunks_exact(COORDINATES)) {
            let z = middle + half * c[2] / norm(c[2], c[3]);
            let scale = (1.0 - z * z).max(0.0).sqrt() / norm(c[0], c[1]);
            *point = Vector::new(c[0] * scale, c[1] * scale, z);
        }
        &self.points
    }

    /// The energy at `coordinates`; its gradient into `gradient`.
    pub(super) fn evaluate(&mut self, coordinates: &[f64], gradient: &mut [f64]) -> f64 {
        self.points(coordinates);
        self.gradients.fill(Vector::zeros());
        let exponent = (1u64 << self.doublings) as f64;
        let mut energy = 0.0;
        for &(i, j) in &self.pairs {
            let (i, j) = (i as usize, j as usize);
            let difference = self.points[i] - self.points[j];
            let inverse = 1.0 / difference.norm_squared().max(1e-30);
            let mut power = self.reference * inverse;
            for _ in 0..self.doublings {
                power *= power;
            }
            if power < NEGLIGIBLE {
                continue;
            }
            energy += power;
            let pull = difference * (-2.0 * exponent * power * inverse);
            self.gradients[i] += pull;
            self.gradients[j] -= pull;
        }
        let half = 0.5 * (self.region.high - self.region.low);
        for (k, (c, g)) in
            coordinates.chunks_exact(COORDINATES).zip(gradient.chunks_exact_mut(COORDINATES)).enumerate()
        {
            let (point, force) = (&self.points[k + 1], &self.gradients[k + 1]);
            let (azimuth_norm, height_norm) = (norm(c[0], c[1]), norm(c[2], c[3]));
            let (ax, ay) = (c[0] / azimuth_norm, c[1] / azimuth_norm);
            let (sine, cosine) = (c[2] / height_norm, c[3] / height_norm);
            let horizontal = (1.0 - point.z * point.z).max(0.0).sqrt();
            // Azimuth: the point moves by `horizontal` times the change of the angle.
            let turn = horizontal * (ax * force.y - ay * force.x) / azimuth_norm;
            g[0] = -ay * turn;
            g[1] = ax * turn;
            // Height: moving up also moves the point inwards.
            let inward = point.z / horizontal.max(1e-9);
            let lift = force.z - inward * (ax * force.x + ay * force.y);
            let swing = half * cosine * lift / height_norm;
            g[2] = cosine * swing;
            g[3] = -sine * swing;
        }
        energy
    }
}

/// Length of a vector in the plane, never zero. Not `hypot`, which differs between C libraries.
fn norm(x: f64, y: f64) -> f64 {
    (x * x + y * y).sqrt().max(1e-12)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::views::Band;
    use rand_chacha::{ChaCha8Rng, rand_core::SeedableRng};

    #[test]
    fn the_gradient_agrees_with_finite_differences() {
        let region = Region::of(Band::from_degrees(-20.0, 70.0).unwrap());
        let mut rng = ChaCha8Rng::seed_from_u64(3);
        let points = super::super::start::random_points(9, &region, &mut rng);
        let mut repulsion = Repulsion::at(&points, &region, 2, 9.0);
        let mut at = repulsion.coordinates();
        at.iter_mut().enumerate().for_each(|(k, x)| *x *= 1.0 + 0.1 * (k % 3) as f64);
        let mut gradient = vec![0.0; at.len()];
        let mut ignored = vec![0.0; at.len()];
        repulsion.evaluate(&at, &mut gradient);
        for k in 0..at.len() {
            let h = 1e-6;
            let mut probe = at.clone();
            probe[k] += h;
            let above = repulsion.evaluate(&probe, &mut ignored);
            probe[k] -= 2.0 * h;
            let below = repulsion.evaluate(&probe, &mut ignored);
            let numeric = (above - below) / (2.0 * h);
            assert!((numeric - gradient[k]).abs() < 1e-5 * (1.0 + gradient[k].abs()), "{k}");
        }
    }
}

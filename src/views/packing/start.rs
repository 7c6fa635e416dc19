//! Where the search begins.

use rand::Rng;

use super::Region;
use crate::geometry::Vector;

/// The fixed point and `n - 1` points uniform over the region's area.
pub(super) fn random_points(n: usize, region: &Region, rng: &mut impl Rng) -> Vec<Vector> {
    let mut points = Vec::with_capacity(n);
    points.push(region.top);
    while points.len() < n {
        // A direction in the plane from the unit disc, so that no sine is needed.
        let (x, y): (f64, f64) = (rng.random_range(-1.0..1.0), rng.random_range(-1.0..1.0));
        let square = x * x + y * y;
        if !(1e-6..=1.0).contains(&square) {
            continue;
        }
        let z = region.low + (region.high - region.low) * rng.random::<f64>();
        let scale = ((1.0 - z * z).max(0.0) / square).sqrt();
        points.push(Vector::new(x * scale, y * scale, z));
    }
    points
}

/// `points` with one to four free ones thrown somewhere else and all others shaken a little.
pub(super) fn disturbed(points: &[Vector], region: &Region, rng: &mut impl Rng) -> Vec<Vector> {
    let n = points.len();
    let mut moved = points.to_vec();
    let shake = 0.2 * rng.random::<f64>() * (2.0 / n as f64).sqrt();
    for point in &mut moved[1..] {
        let offset = Vector::new(
            rng.random_range(-shake..=shake),
            rng.random_range(-shake..=shake),
            rng.random_range(-shake..=shake),
        );
        let target = *point + offset;
        let z = (target.z / target.norm()).clamp(region.low, region.high);
        let horizontal = (target.x * target.x + target.y * target.y).sqrt().max(1e-9);
        let scale = (1.0 - z * z).max(0.0).sqrt() / horizontal;
        *point = Vector::new(target.x * scale, target.y * scale, z);
    }
    if n > 1 {
        for _ in 0..rng.random_range(1..=4) {
            let thrown = random_points(2, region, rng)[1];
            moved[rng.random_range(1..n)] = thrown;
        }
    }
    moved
}

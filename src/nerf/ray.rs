//! Rays through the unit cube, and where along them samples lie.

use super::distance_map::DistanceMap;
use super::field::{HARMONICS, spherical_harmonics};

/// Distance between samples along a ray, in units of the cube's edge.
pub(super) const STEP: f32 = 1.0 / 96.0;

/// A ray and how far it has been marched.
#[derive(Clone, Debug)]
pub(super) struct Ray {
    origin: [f32; 3],
    direction: [f32; 3],
    pub harmonics: [f32; HARMONICS],
    /// Distance to the first sample.
    near: f32,
    samples: u32,
    next: u32,
    /// Samples a cell's width is long, at least.
    samples_per_cell: f32,
    /// Light that passes the samples seen so far.
    pub transmittance: f32,
}

impl Ray {
    /// The ray from `origin` along the unit vector `direction`, both in units of
    /// the cube, with samples at `(k + phase) * STEP` after its entry. `None` if
    /// it misses the cube or has no sample in it.
    pub fn through_cube(origin: [f32; 3], direction: [f32; 3], phase: f32) -> Option<Ray> {
        let (mut enter, mut leave) = (0.0f32, f32::INFINITY);
        for (o, d) in origin.into_iter().zip(direction) {
            // An exact zero would make 0 / 0 on a face.
            let inverse = 1.0 / if d.abs() < 1e-9 { 1e-9 } else { d };
            let (a, b) = (-o * inverse, (1.0 - o) * inverse);
            enter = enter.max(a.min(b));
            leave = leave.min(a.max(b));
        }
        let near = enter + phase * STEP;
        let count = (leave - near) / STEP;
        let finite = origin.iter().chain(&direction).all(|x| x.is_finite());
        if !(finite && count > 0.0 && count.is_finite()) {
            return None;
        }
        let steepest = direction.iter().fold(0.0f32, |m, d| m.max(d.abs()));
        Some(Ray {
            origin,
            direction,
            harmonics: spherical_harmonics(direction),
            near,
            // A cube's diagonal holds 167 steps; the bound guards against rounding.
            samples: (count.ceil() as u32).min(200),
            next: 0,
            samples_per_cell: DistanceMap::CELL / (STEP * steepest),
            transmittance: 1.0,
        })
    }

    /// The next sample in an occupied cell.
    #[inline]
    pub fn next_sample(&mut self, map: &DistanceMap) -> Option<[f32; 3]> {
        while self.next < self.samples {
            let t = self.near + self.next as f32 * STEP;
            let position: [f32; 3] = std::array::from_fn(|a| self.origin[a] + t * self.direction[a]);
            let distance = map.cells_to_occupied(position);
            self.next += 1;
            if distance == 0 {
                return Some(position);
            }
            // Within `distance - 1` cells' width of here nothing is occupied.
            self.next += (f32::from(distance - 1) * self.samples_per_cell) as u32;
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn marching_by_distance_finds_the_samples_that_a_march_over_all_finds(
            origin in prop::array::uniform3(-1.0..2.0f32), through in prop::array::uniform3(0.2..0.8f32),
            phase in 0.0..1.0f32, seeds in prop::collection::vec(0usize..64 * 64 * 64, 1..30),
        ) {
            let mut occupied = vec![false; 64 * 64 * 64];
            for cell in seeds {
                occupied[cell] = true;
            }
            let map = DistanceMap::new(&occupied);
            let d: [f32; 3] = std::array::from_fn(|a| through[a] - origin[a]);
            let norm = d.iter().map(|x| x * x).sum::<f32>().sqrt();
            prop_assume!(norm > 1e-3);
            let Some(mut ray) = Ray::through_cube(origin, d.map(|x| x / norm), phase) else {
                return Err(TestCaseError::reject("misses"));
            };
            let mut all = ray.clone();
            let full = DistanceMap::new(&vec![true; 64 * 64 * 64]);
            let expected: Vec<_> = std::iter::from_fn(|| all.next_sample(&full))
                .filter(|&p| map.cells_to_occupied(p) == 0).collect();
            let found: Vec<_> = std::iter::from_fn(|| ray.next_sample(&map)).collect();
            prop_assert_eq!(found, expected);
        }
    }

    #[test]
    fn a_ray_beside_the_cube_or_away_from_it_has_no_samples() {
        assert!(Ray::through_cube([-1.0, 2.0, 0.5], [1.0, 0.0, 0.0], 0.5).is_none());
        assert!(Ray::through_cube([-1.0, 0.5, 0.5], [-1.0, 0.0, 0.0], 0.5).is_none());
        assert!(Ray::through_cube([f32::NAN, 0.5, 0.5], [1.0, 0.0, 0.0], 0.5).is_none());
        let inside = Ray::through_cube([0.5, 0.5, 0.5], [1.0, 0.0, 0.0], 0.0).unwrap();
        assert_eq!(inside.samples, 48);
    }
}

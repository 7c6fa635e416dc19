//! Rays through the unit cube, and where along them samples lie.

use super::distance_map::DistanceMap;
use super::field::{HARMONICS, spherical_harmonics};

/// Distance between samples along a ray, in units of the cube's edge.
pub(super) const STEP: f32 = 1.0 / 96.0;

/// A ray through the cube and its evenly spaced samples.
#[derive(Clone, Debug)]
pub(super) struct Ray {
    pub origin: [f32; 3],
    /// Of unit length.
    pub direction: [f32; 3],
    pub harmonics: [f32; HARMONICS],
    /// Distance to the first sample.
    pub near: f32,
    pub samples: u32,
    /// Steps that lead no farther than a cell's width along any axis.
    pub samples_per_cell: f32,
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
            samples_per_cell: DistanceMap::CELL / (STEP * steepest),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ray_beside_the_cube_or_away_from_it_has_no_samples() {
        assert!(Ray::through_cube([-1.0, 2.0, 0.5], [1.0, 0.0, 0.0], 0.5).is_none());
        assert!(Ray::through_cube([-1.0, 0.5, 0.5], [-1.0, 0.0, 0.0], 0.5).is_none());
        assert!(Ray::through_cube([f32::NAN, 0.5, 0.5], [1.0, 0.0, 0.0], 0.5).is_none());
        let inside = Ray::through_cube([0.5, 0.5, 0.5], [1.0, 0.0, 0.0], 0.0).unwrap();
        assert_eq!(inside.samples, 48);
    }
}

//! Directions as azimuth and elevation.

use super::{Direction, Vector};

/// The unit direction at `azimuth_rad` (from +x towards +y) and
/// `elevation_rad` (from the xy plane towards +z).
pub fn direction_from_azimuth_elevation(azimuth_rad: f64, elevation_rad: f64) -> Direction {
    let (sin_az, cos_az) = azimuth_rad.sin_cos();
    let (sin_el, cos_el) = elevation_rad.sin_cos();
    Direction::new_normalize(Vector::new(cos_el * cos_az, cos_el * sin_az, sin_el))
}

/// Azimuth in `(-pi, pi]` and elevation in `[-pi/2, pi/2]` of `direction`, radians.
/// The azimuth of a pole is 0.
pub fn azimuth_elevation_from_direction(direction: &Direction) -> (f64, f64) {
    let horizontal = direction.x.hypot(direction.y);
    let azimuth = if horizontal < 1e-12 { 0.0 } else { direction.y.atan2(direction.x) };
    (azimuth, direction.z.atan2(horizontal))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn azimuth_and_elevation_survive_the_round_trip(az in -3.1..3.1f64, el in -1.5..1.5f64) {
            let (az2, el2) = azimuth_elevation_from_direction(&direction_from_azimuth_elevation(az, el));
            prop_assert!((az - az2).abs() < 1e-9 && (el - el2).abs() < 1e-9);
        }
    }
}

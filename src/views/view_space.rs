//! Camera poses on a sphere around the object.

use super::{Band, ViewsError};
use crate::geometry::{Direction, Point, Pose, look_at};

/// The part of a sphere around the object that cameras may stand on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ViewSpace {
    /// Centre of the object, robot base frame, metres.
    pub center_in_base: Point,
    /// Distance of every camera from the centre, metres.
    pub radius_m: f64,
    /// Elevations that cameras may have.
    pub band: Band,
}

impl ViewSpace {
    /// Checks the band and the radius.
    ///
    /// # Errors
    /// Names the field and its value.
    pub fn validate(&self) -> Result<(), ViewsError> {
        self.band.validate()?;
        if self.radius_m.is_finite() && self.radius_m > 0.0 {
            Ok(())
        } else {
            Err(ViewsError::Radius { value_m: self.radius_m })
        }
    }

    /// Where the camera of the view from `direction` stands, base frame, metres.
    pub fn position(&self, direction: &Direction) -> Point {
        self.center_in_base + direction.into_inner() * self.radius_m
    }

    /// `base_from_camera` of the view from `direction`: the optical axis passes
    /// through the centre, the horizon is level at `roll_rad = 0` (see
    /// [`look_at`] for the view from the top and for the sense of the roll).
    pub fn pose(&self, direction: &Direction, roll_rad: f64) -> Pose {
        look_at(&self.position(direction), &self.center_in_base, roll_rad)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Vector;
    use crate::views::{initial_views, tammes};

    #[test]
    fn every_pose_stands_at_the_radius_and_looks_at_the_centre() {
        let space =
            ViewSpace { center_in_base: Point::new(0.5, 0.1, 0.08), radius_m: 0.3, band: Band::DEFAULT };
        let set = tammes(7, space.band).unwrap();
        for direction in set.directions.iter().chain(initial_views().iter().map(|view| &view.direction)) {
            let pose = space.pose(direction, 0.4);
            let center_in_camera = pose.inverse_transform_point(&space.center_in_base);
            assert!((center_in_camera.coords - Vector::new(0.0, 0.0, 0.3)).norm() < 1e-9);
        }
    }

    #[test]
    fn a_radius_that_is_no_length_is_refused_with_its_value() {
        let space = ViewSpace { center_in_base: Point::origin(), radius_m: -0.3, band: Band::DEFAULT };
        assert_eq!(space.validate(), Err(ViewsError::Radius { value_m: -0.3 }));
    }
}

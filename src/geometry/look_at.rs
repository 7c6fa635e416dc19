//! Camera poses that look at a point.

use nalgebra::{Matrix3, Rotation3, Translation3, UnitQuaternion};

use super::{Point, Pose, Vector};

/// Distance below which eye and target, or the optical axis and the vertical, count as the same.
const DEGENERATE: f64 = 1e-9;

/// `frame_from_camera` of a camera at `eye_in_frame` whose optical axis (+z)
/// passes through `target_in_frame`, OpenCV axes.
///
/// With `roll_rad = 0` the horizon is level: the image's x axis is horizontal
/// and its y axis points down as far as possible. A camera that looks straight
/// down (or up) has no horizon; it gets the limit for a camera that comes from
/// azimuth 0, so image "up" is -x of the frame when looking down. `roll_rad`
/// then turns the camera about its optical axis (positive from camera x to
/// camera y).
///
/// An eye on the target looks down.
pub fn look_at(eye_in_frame: &Point, target_in_frame: &Point, roll_rad: f64) -> Pose {
    let toward = target_in_frame - eye_in_frame;
    let forward = if toward.norm() < DEGENERATE { -Vector::z() } else { toward.normalize() };
    let horizontal = forward.cross(&Vector::z());
    let right = if horizontal.norm() < DEGENERATE { Vector::y() } else { horizontal.normalize() };
    let down = forward.cross(&right);
    let axes = Rotation3::from_matrix_unchecked(Matrix3::from_columns(&[right, down, forward]));
    let rotation = UnitQuaternion::from_rotation_matrix(&axes)
        * UnitQuaternion::from_axis_angle(&Vector::z_axis(), roll_rad);
    Pose::from_parts(Translation3::from(eye_in_frame.coords), rotation)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::direction_from_azimuth_elevation;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn the_optical_axis_passes_through_the_target(az in -3.1..3.1f64, el in -1.57..1.57f64, r in 0.1..2.0f64, roll in -3.0..3.0f64) {
            let target = Point::new(0.4, -0.2, 0.1);
            let eye = target + direction_from_azimuth_elevation(az, el).into_inner() * r;
            let seen = look_at(&eye, &target, roll).inverse_transform_point(&target);
            prop_assert!((seen - Point::new(0.0, 0.0, r)).norm() < 1e-9);
        }

        #[test]
        fn the_horizon_is_level_without_roll(az in -3.1..3.1f64, el in -1.5..1.5f64) {
            let eye = Point::origin() + direction_from_azimuth_elevation(az, el).into_inner();
            let pose = look_at(&eye, &Point::origin(), 0.0);
            prop_assert!((pose.rotation * Vector::x()).z.abs() < 1e-9);
            prop_assert!((pose.rotation * Vector::y()).z < 0.0);
        }
    }

    #[test]
    fn the_top_view_is_the_limit_from_azimuth_zero() {
        let near_top = direction_from_azimuth_elevation(0.0, std::f64::consts::FRAC_PI_2 - 1e-6);
        let near = look_at(&(Point::origin() + near_top.into_inner()), &Point::origin(), 0.0);
        let top = look_at(&Point::new(0.0, 0.0, 1.0), &Point::origin(), 0.0);
        assert!(top.rotation.angle_to(&near.rotation) < 1e-5);
    }
}

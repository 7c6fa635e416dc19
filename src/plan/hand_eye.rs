//! Whether a hand-eye calibration can be one.

use super::{PlanError, Warning};
use crate::geometry::{Pose, Vector};

/// Farthest a camera may sit from the flange, metres.
const FARTHEST_M: f64 = 2.0;
/// A camera farther from the flange than this is unusual, metres.
const UNUSUAL_M: f64 = 0.5;
/// A camera this far behind the flange is inside the wrist, metres.
const BEHIND_M: f64 = 0.03;

/// Refuses what no mount can be and warns of what looks like the inverse transform.
pub(super) fn check(flange_from_camera: &Pose) -> Result<Vec<Warning>, PlanError> {
    let position = flange_from_camera.translation.vector;
    for (axis, value) in position.iter().enumerate() {
        if !(value.abs() <= FARTHEST_M) {
            let code = if value.abs() <= FARTHEST_M * 1000.0 { "millimetres" } else { "out_of_range" };
            let hint = if code == "millimetres" { " (millimetres?)" } else { "" };
            let bound = format!("from -{FARTHEST_M} to {FARTHEST_M} m{hint}");
            return Err(PlanError::number(
                code,
                format!("flange_from_camera.position[{axis}]"),
                *value,
                bound,
            ));
        }
    }
    let mut warnings = Vec::new();
    let optical_axis_in_flange = flange_from_camera.rotation * Vector::z();
    if position.norm() > UNUSUAL_M {
        warnings.push(Warning::new(
            "hand_eye_far",
            format!("flange_from_camera puts the camera {:.3} m from the flange", position.norm()),
        ));
    }
    if optical_axis_in_flange.z < -0.5 {
        warnings.push(Warning::new(
            "hand_eye_backwards",
            "flange_from_camera makes the camera look back at the arm: are its axes OpenCV's (z forward)?",
        ));
    }
    if position.z < -BEHIND_M {
        warnings.push(Warning::new(
            "hand_eye_inverted",
            format!(
                "flange_from_camera puts the camera {:.3} m behind the flange: was camera_from_flange given?",
                -position.z
            ),
        ));
    }
    Ok(warnings)
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{Translation3, UnitQuaternion};

    fn codes(pose: &Pose) -> Vec<&'static str> {
        check(pose).unwrap().iter().map(|warning| warning.code).collect()
    }

    #[test]
    fn a_usual_mount_passes_and_its_inverse_is_suspected() {
        let turn = UnitQuaternion::from_euler_angles(0.1, -0.05, 1.57);
        let mount = Pose::from_parts(Translation3::new(0.02, 0.06, 0.07), turn);
        assert!(codes(&mount).is_empty());
        assert_eq!(codes(&mount.inverse()), ["hand_eye_inverted"]);
    }

    #[test]
    fn a_camera_that_looks_at_the_arm_is_suspected() {
        let mount = Pose::from_parts(
            Translation3::new(0.0, 0.06, 0.05),
            UnitQuaternion::from_euler_angles(std::f64::consts::PI, 0.0, 0.0),
        );
        assert_eq!(codes(&mount), ["hand_eye_backwards"]);
    }

    #[test]
    fn millimetres_are_named() {
        let error = check(&Pose::translation(0.0, 60.0, 0.05)).unwrap_err();
        assert!(
            matches!(error, PlanError::Invalid { code: "millimetres", ref field, .. } if field == "flange_from_camera.position[1]")
        );
        assert!(check(&Pose::translation(f64::NAN, 0.0, 0.0)).is_err());
    }
}

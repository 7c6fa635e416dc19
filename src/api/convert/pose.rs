//! Poses.

use nalgebra::{Quaternion, Translation3, UnitQuaternion};

use crate::api::problem::Problem;
use crate::api::wire::PoseJson;
use crate::geometry::Pose;

/// Largest deviation of a quaternion's norm from 1.
pub const NORM_TOLERANCE: f64 = 1e-3;
/// Largest coordinate, metres; what is beyond is no pose of an arm or its camera.
pub const FARTHEST_M: f64 = 1e4;

/// The pose, its quaternion normalised.
///
/// # Errors
/// 422 for a quaternion that is not of unit length and for absurd coordinates.
pub fn pose(field: &str, json: &PoseJson) -> Result<Pose, Problem> {
    let [x, y, z, w] = json.orientation;
    let norm = (x * x + y * y + z * z + w * w).sqrt();
    // NaN fails here too.
    if !((norm - 1.0).abs() <= NORM_TOLERANCE) {
        let mut problem = Problem::field(
            "non_unit_quaternion",
            format!("{field}.orientation"),
            json.orientation.to_vec(),
            format!("a quaternion x, y, z, w of norm 1 within {NORM_TOLERANCE}"),
        );
        problem.detail.push_str(&format!(" (its norm is {norm})"));
        return Err(problem);
    }
    for (axis, value) in json.position.iter().enumerate() {
        if !(value.abs() <= FARTHEST_M) {
            let path = format!("{field}.position[{axis}]");
            return Err(Problem::field("out_of_range", path, *value, format!("within +-{FARTHEST_M} m")));
        }
    }
    let [px, py, pz] = json.position;
    let rotation = UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z));
    Ok(Pose::from_parts(Translation3::new(px, py, pz), rotation))
}

/// The pose with w >= 0: a rotation has one text.
pub fn pose_json(pose: &Pose) -> PoseJson {
    let t = pose.translation.vector;
    let q = pose.rotation.quaternion();
    let sign = if q.w < 0.0 { -1.0 } else { 1.0 };
    // Adding zero turns -0 into 0.
    let clean = |value: f64| value + 0.0;
    PoseJson {
        position: [clean(t.x), clean(t.y), clean(t.z)],
        orientation: [q.i, q.j, q.k, q.w].map(|value| clean(sign * value)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_quaternion_of_another_length_is_named_with_its_norm() {
        let json = PoseJson { position: [0.0; 3], orientation: [0.0, 0.0, 0.0, 2.0] };
        let problem = pose("flange_from_camera", &json).unwrap_err();
        assert_eq!(problem.code, "non_unit_quaternion");
        assert_eq!(problem.field.as_deref(), Some("flange_from_camera.orientation"));
        assert!(problem.detail.contains("norm is 2"));
        let zero = PoseJson { orientation: [0.0; 4], ..json };
        assert!(pose("p", &zero).is_err());
    }

    #[test]
    fn a_pose_survives_the_round_trip() {
        let json = PoseJson { position: [0.1, -0.2, 0.3], orientation: [0.5, -0.5, 0.5, 0.5] };
        let back = pose_json(&pose("p", &json).unwrap());
        assert_eq!(back.position, json.position);
        assert!(back.orientation.iter().zip(json.orientation).all(|(a, b)| (a - b).abs() < 1e-12));
    }
}

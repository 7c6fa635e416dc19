//! Joint states against joint limits.

use super::{Joint, RobotError};

/// How far outside its limit a start value may lie and still be taken, radians.
/// Encoders and rounding put real states there.
pub const START_TOLERANCE_RAD: f64 = 1e-3;

/// A start value that was moved onto its limit.
#[derive(Debug, Clone, PartialEq)]
pub struct ClampedJoint {
    /// The joint.
    pub joint: String,
    /// The value given, radians.
    pub given_rad: f64,
    /// The limit it was moved to, radians.
    pub used_rad: f64,
}

impl std::fmt::Display for ClampedJoint {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} starts at {} rad, taken as its limit {} rad", self.joint, self.given_rad, self.used_rad)
    }
}

/// A start state within the limits: values up to [`START_TOLERANCE_RAD`]
/// outside are moved onto the limit and reported, NaN and anything further out
/// is an error that names the joint, its value and the bound.
pub fn clamp_start(joints: &[Joint], start_rad: &[f64]) -> Result<(Vec<f64>, Vec<ClampedJoint>), RobotError> {
    if start_rad.len() != joints.len() {
        return Err(RobotError::StateLength { found: start_rad.len(), expected: joints.len() });
    }
    let mut clamped = Vec::new();
    let mut state = Vec::with_capacity(joints.len());
    for (index, (joint, &given_rad)) in joints.iter().zip(start_rad).enumerate() {
        let used_rad = given_rad.max(joint.lower_rad).min(joint.upper_rad);
        if given_rad.is_nan() || (given_rad - used_rad).abs() > START_TOLERANCE_RAD {
            let bound_rad = if given_rad < joint.lower_rad { joint.lower_rad } else { joint.upper_rad };
            return Err(RobotError::BeyondLimit {
                index,
                joint: joint.name.clone(),
                value_rad: given_rad,
                bound_rad,
            });
        }
        if used_rad != given_rad {
            clamped.push(ClampedJoint { joint: joint.name.clone(), given_rad, used_rad });
        }
        state.push(used_rad);
    }
    Ok((state, clamped))
}

/// The joint of `state_rad` that lies farthest outside its limits:
/// its index and the angle beyond, radians. `None` if all lie within.
pub fn limit_violation(joints: &[Joint], state_rad: &[f64]) -> Option<(usize, f64)> {
    let beyond = joints.iter().zip(state_rad).map(|(joint, &q)| {
        if joint.contains(q) {
            0.0
        } else if q.is_nan() {
            f64::INFINITY
        } else {
            joint.violation_rad(q)
        }
    });
    beyond.enumerate().filter(|(_, b)| *b > 0.0).max_by(|a, b| a.1.total_cmp(&b.1))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robot::RobotModel;
    use std::f64::consts::PI;

    fn ur5e() -> Vec<Joint> {
        RobotModel::named("ur5e").unwrap().joints
    }

    #[test]
    fn a_start_a_hair_outside_its_limit_is_clamped_and_reported() {
        let (state, warnings) =
            clamp_start(&ur5e(), &[0.0, -1.0, PI + 1e-8, 0.0, 0.0, -2.0 * PI - 9e-4]).unwrap();
        assert_eq!(state[2], PI);
        assert_eq!(state[5], -2.0 * PI);
        assert_eq!(warnings.len(), 2);
        assert_eq!(warnings[0].joint, "elbow_joint");
    }

    #[test]
    fn a_start_beyond_its_limit_names_joint_value_and_bound() {
        let error = clamp_start(&ur5e(), &[0.0, 0.0, -3.2, 0.0, 0.0, 0.0]).unwrap_err();
        assert_eq!(
            error,
            RobotError::BeyondLimit {
                index: 2,
                joint: "elbow_joint".into(),
                value_rad: -3.2,
                bound_rad: -PI
            }
        );
    }

    #[test]
    fn a_start_that_is_no_number_or_of_the_wrong_length_is_refused() {
        assert!(matches!(
            clamp_start(&ur5e(), &[0.0, f64::NAN, 0.0, 0.0, 0.0, 0.0]),
            Err(RobotError::BeyondLimit { .. })
        ));
        assert!(matches!(
            clamp_start(&ur5e(), &[0.0; 5]),
            Err(RobotError::StateLength { found: 5, expected: 6 })
        ));
        assert!(clamp_start(&ur5e(), &[f64::INFINITY; 6]).is_err());
    }

    #[test]
    fn the_worst_violation_is_named() {
        let joints = ur5e();
        assert_eq!(limit_violation(&joints, &[0.0; 6]), None);
        let (index, beyond) = limit_violation(&joints, &[0.0, 6.5, 4.0, 0.0, 0.0, 0.0]).unwrap();
        assert_eq!(index, 2);
        assert!((beyond - (4.0 - PI)).abs() < 1e-12);
    }
}

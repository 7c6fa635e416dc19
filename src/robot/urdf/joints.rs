//! Joints, origins and limits out of URDF elements.

use std::f64::consts::TAU;

use nalgebra::{Translation3, UnitQuaternion, Vector3};

use super::tree::element;
use crate::geometry::{Direction, Pose, Vector};
use crate::robot::described::check_joint;
use crate::robot::error::short;
use crate::robot::{Joint, RobotError, RobotModel, RobotWarning};

/// Largest coordinate of an origin, metres; more looks like millimetres.
const FARTHEST_M: f64 = 5.0;

/// The transform of an `<origin>` that belongs to the `kind` called `name`.
pub(super) fn origin(kind: &'static str, name: &str, origin: &urdf_rs::Pose) -> Result<Pose, RobotError> {
    let outside = |value: &&f64, bound: f64| !(-bound..=bound).contains(*value);
    if let Some(value) = origin.xyz.iter().find(|v| outside(v, FARTHEST_M)) {
        let problem =
            format!("origin xyz has {value}, at most {FARTHEST_M} m are taken; millimetres given as metres?");
        return Err(element(kind, name, problem));
    }
    if let Some(value) = origin.rpy.iter().find(|v| outside(v, 2.0 * TAU)) {
        return Err(element(kind, name, format!("origin rpy has {value}; degrees given as radians?")));
    }
    let ([x, y, z], [roll, pitch, yaw]) = (origin.xyz.0, origin.rpy.0);
    Ok(Pose::from_parts(Translation3::new(x, y, z), UnitQuaternion::from_euler_angles(roll, pitch, yaw)))
}

/// The unit axis of a turning joint.
pub(super) fn axis(joint: &urdf_rs::Joint) -> Result<Direction, RobotError> {
    let axis = Vector3::from(joint.axis.xyz.0);
    // Not a NaN, and neither of a length whose square leaves the range of numbers.
    if !(1e-6..=1e6).contains(&axis.norm()) {
        return Err(element("joint", &joint.name, format!("axis {:?} has no direction", joint.axis.xyz.0)));
    }
    Ok(Direction::new_normalize(Vector::from(axis)))
}

/// The limits of a turning joint; what the URDF lacks is assumed and said in `warnings`.
pub(super) fn limits(joint: &urdf_rs::Joint, warnings: &mut Vec<RobotWarning>) -> Result<Joint, RobotError> {
    let name = short(&joint.name);
    if joint.mimic.is_some() {
        return Err(element(
            "joint",
            &joint.name,
            "it mimics another joint, which is not supported in the arm itself",
        ));
    }
    let continuous = joint.joint_type == urdf_rs::JointType::Continuous;
    let (lower_rad, upper_rad) = if continuous {
        warnings.push(RobotWarning::description(format!(
            "{name} turns without end; plans keep it within one turn each way, +-{TAU:.4} rad"
        )));
        (-TAU, TAU)
    } else {
        (joint.limit.lower, joint.limit.upper)
    };
    let max_speed_rad_per_s = if joint.limit.velocity == 0.0 {
        warnings.push(RobotWarning::description(format!(
            "{name} has no velocity limit, {} rad/s assumed",
            RobotModel::ASSUMED_SPEED_RAD_PER_S
        )));
        RobotModel::ASSUMED_SPEED_RAD_PER_S
    } else {
        joint.limit.velocity
    };
    let limits = Joint {
        name,
        lower_rad,
        upper_rad,
        max_speed_rad_per_s,
        max_acceleration_rad_per_s2: RobotModel::ASSUMED_ACCELERATION_RAD_PER_S2,
        max_jerk_rad_per_s3: None,
        continuous,
    };
    check_joint(&limits)?;
    warnings.extend(RobotWarning::speed_in_degrees(&limits));
    Ok(limits)
}

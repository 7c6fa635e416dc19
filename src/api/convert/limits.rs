//! A robot with a request's limits.

use super::robot;
use crate::api::problem::Problem;
use crate::api::wire::{LimitsJson, RobotJson};
use crate::robot::{JointLimits, RobotModel};

/// The robot of a request, with the request's joint limits in place of its own.
///
/// # Errors
/// 422 naming the joint and the member: those of the robot, a joint that it has not, and limits
/// that no arm can have.
pub fn limited_robot(json: &RobotJson, limits: Option<&LimitsJson>) -> Result<RobotModel, Problem> {
    let model = robot(json)?;
    let Some(limits) = limits else { return Ok(model) };
    let limits = limits.iter().map(|(name, json)| {
        let limits = JointLimits {
            lower_rad: json.min,
            upper_rad: json.max,
            max_speed_rad_per_s: json.max_speed,
            max_acceleration_rad_per_s2: json.max_acceleration,
            max_jerk_rad_per_s3: json.max_jerk,
        };
        (name.as_str(), limits)
    });
    Ok(model.with_limits(limits)?)
}

/// Leaves out of `limits` what the robot has anyway.
pub fn drop_own(limits: &mut LimitsJson, model: &RobotModel) {
    for joint in &model.joints {
        let Some(json) = limits.get_mut(&joint.name) else { continue };
        for (given, own) in [
            (&mut json.min, Some(joint.lower_rad)),
            (&mut json.max, Some(joint.upper_rad)),
            (&mut json.max_speed, Some(joint.max_speed_rad_per_s)),
            (&mut json.max_acceleration, Some(joint.max_acceleration_rad_per_s2)),
            (&mut json.max_jerk, joint.max_jerk_rad_per_s3),
        ] {
            if *given == own {
                *given = None;
            }
        }
    }
}

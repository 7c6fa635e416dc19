//! Limits that a cell sets in place of the maker's.

use std::f64::consts::TAU;
use std::ops::RangeInclusive;

use super::bounds::{JERKS, RATES};
use super::{Joint, NumberGroup, RobotError, RobotModel, RobotWarning, Source};

/// Farthest that a joint may be allowed to turn, radians: two turns.
const WIDEST_RAD: f64 = 2.0 * TAU;

/// What replaces a joint's limits; `None` leaves the robot's own.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct JointLimits {
    /// Smallest angle, radians.
    pub lower_rad: Option<f64>,
    /// Largest angle, radians.
    pub upper_rad: Option<f64>,
    /// Largest speed, rad/s.
    pub max_speed_rad_per_s: Option<f64>,
    /// Largest acceleration, rad/s2.
    pub max_acceleration_rad_per_s2: Option<f64>,
    /// Largest jerk, rad/s3.
    pub max_jerk_rad_per_s3: Option<f64>,
}

impl RobotModel {
    /// The same arm with other limits, by joint name. Position limits beyond the
    /// arm's own are taken and get a warning.
    ///
    /// # Errors
    /// [`RobotError::UnknownJoint`]; [`RobotError::Limit`] for a number that is no limit.
    pub fn with_limits<'a>(
        self,
        limits: impl IntoIterator<Item = (&'a str, JointLimits)>,
    ) -> Result<Self, RobotError> {
        let mut joints = self.joints.clone();
        let mut warnings = Vec::new();
        let mut named = Vec::new();
        for (name, limits) in limits {
            let Some(joint) = joints.iter_mut().find(|joint| joint.name == name) else {
                let known = self.joints.iter().map(|joint| joint.name.as_str());
                return Err(RobotError::UnknownJoint {
                    name: super::error::short(name),
                    known: known.collect::<Vec<_>>().join(", "),
                });
            };
            replace(joint, &limits, &mut warnings)?;
            named.push(joint.name.clone());
        }
        if named.is_empty() {
            return Ok(self);
        }
        let mut model = self;
        model.kinematics = model.kinematics.with_joints(joints.clone())?;
        model.joints = joints;
        model.warnings.append(&mut warnings);
        let text = format!("the request, for {}.", named.join(", "));
        model.sources.push(Source::new(NumberGroup::ReplacedLimits, text));
        Ok(model)
    }
}

fn span(range: RangeInclusive<f64>) -> (f64, f64) {
    (*range.start(), *range.end())
}

fn replace(
    joint: &mut Joint,
    limits: &JointLimits,
    warnings: &mut Vec<RobotWarning>,
) -> Result<(), RobotError> {
    let name = joint.name.clone();
    let within = |field: &'static str, value: f64, (least, most): (f64, f64)| {
        // A NaN is not within any range.
        if (least..=most).contains(&value) {
            return Ok(value);
        }
        let bound = match field {
            "min" | "max" if value.is_finite() && value.abs() > WIDEST_RAD => format!(
                "within [{least:.4}, {most:.4}] rad (degrees? {value} degrees are {:.4} rad)",
                value.to_radians()
            ),
            "min" | "max" => format!("within [{least:.4}, {most:.4}] rad"),
            "max_speed" => format!("within [{least}, {most}] rad/s"),
            "max_acceleration" => format!("within [{least}, {most}] rad/s2"),
            _ => format!("within [{least}, {most}] rad/s3"),
        };
        Err(RobotError::Limit { joint: name.clone(), field, value, bound })
    };
    let (own_lower, own_upper) = (joint.lower_rad, joint.upper_rad);
    let range = |own: f64| (-WIDEST_RAD.max(own.abs()), WIDEST_RAD.max(own.abs()));
    if let Some(lower) = limits.lower_rad {
        joint.lower_rad = within("min", lower, range(own_lower))?;
    }
    if let Some(upper) = limits.upper_rad {
        joint.upper_rad = within("max", upper, range(own_upper))?;
    }
    if !(joint.lower_rad < joint.upper_rad) {
        // The member that was given is the one to blame.
        let (field, value, bound) = match limits.upper_rad {
            Some(upper) => ("max", upper, format!("above min, {:.4} rad", joint.lower_rad)),
            None => ("min", joint.lower_rad, format!("below max, {:.4} rad", joint.upper_rad)),
        };
        return Err(RobotError::Limit { joint: name.clone(), field, value, bound });
    }
    if let Some(speed) = limits.max_speed_rad_per_s {
        joint.max_speed_rad_per_s = within("max_speed", speed, span(RATES))?;
        warnings.extend(RobotWarning::speed_in_degrees(joint));
    }
    if let Some(acceleration) = limits.max_acceleration_rad_per_s2 {
        joint.max_acceleration_rad_per_s2 = within("max_acceleration", acceleration, span(RATES))?;
    }
    if let Some(jerk) = limits.max_jerk_rad_per_s3 {
        joint.max_jerk_rad_per_s3 = Some(within("max_jerk", jerk, span(JERKS))?);
    }
    if joint.lower_rad < own_lower || joint.upper_rad > own_upper {
        warnings.push(RobotWarning::limit_widened(format!(
            "{}: the request allows {} to {} rad, the robot's own limits are {own_lower} to {own_upper} rad",
            joint.name, joint.lower_rad, joint.upper_rad
        )));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn limited(joint: &str, limits: JointLimits) -> Result<RobotModel, RobotError> {
        RobotModel::named("ur5e").unwrap().with_limits([(joint, limits)])
    }

    #[test]
    fn what_is_given_replaces_what_the_robot_has_and_binds_the_solutions() {
        let limits = JointLimits {
            lower_rad: Some(0.0),
            max_speed_rad_per_s: Some(0.5),
            max_jerk_rad_per_s3: Some(50.0),
            ..JointLimits::default()
        };
        let robot = limited("elbow_joint", limits).unwrap();
        let elbow = &robot.joints[2];
        assert_eq!((elbow.lower_rad, elbow.max_speed_rad_per_s), (0.0, 0.5));
        assert_eq!((elbow.max_jerk_rad_per_s3, elbow.upper_rad), (Some(50.0), std::f64::consts::PI));
        assert_eq!(robot.warnings, []);
        let target = robot.kinematics.forward(&[0.3, -1.2, 1.4, -0.9, 1.1, 0.4]);
        let solutions = robot.kinematics.inverse(&target, &[]).solutions;
        assert!(solutions.len() == 4 && solutions.iter().all(|q| q[2] >= 0.0));
    }

    #[test]
    fn a_wider_position_limit_is_taken_with_a_warning() {
        let robot =
            limited("elbow_joint", JointLimits { upper_rad: Some(5.0), ..JointLimits::default() }).unwrap();
        assert_eq!(robot.warnings[0].code, "limit_widened");
        assert!(robot.warnings[0].message.contains("elbow_joint") && robot.warnings[0].message.contains('5'));
    }

    #[test]
    fn a_speed_that_must_be_in_degrees_gets_a_warning() {
        let robot = limited(
            "elbow_joint",
            JointLimits { max_speed_rad_per_s: Some(180.0), ..JointLimits::default() },
        );
        let warnings = robot.unwrap().warnings;
        assert_eq!(warnings[0].code, "speed_in_degrees");
        assert!(warnings[0].message.contains("180 deg/s are 3.1416 rad/s"), "{}", warnings[0]);
    }

    #[test]
    fn what_is_no_limit_is_refused_by_joint_field_and_bound() {
        let none = JointLimits::default();
        let cases = [
            (JointLimits { upper_rad: Some(-4.0), ..none }, "max is -4"),
            (JointLimits { lower_rad: Some(3.5), ..none }, "min is 3.5"),
            (JointLimits { lower_rad: Some(1.0), upper_rad: Some(1.0), ..none }, "max is 1"),
            (JointLimits { upper_rad: Some(180.0), ..none }, "max is 180"),
            (JointLimits { max_speed_rad_per_s: Some(0.0), ..none }, "max_speed is 0"),
            (JointLimits { max_acceleration_rad_per_s2: Some(f64::NAN), ..none }, "max_acceleration is NaN"),
            (JointLimits { max_jerk_rad_per_s3: Some(-1.0), ..none }, "max_jerk is -1"),
            (JointLimits { lower_rad: Some(f64::NEG_INFINITY), ..none }, "min is -inf"),
        ];
        for (limits, text) in cases {
            let error = limited("elbow_joint", limits).unwrap_err().to_string();
            assert!(error.contains("elbow_joint") && error.contains(text), "{error}");
        }
        let error = limited("elbow", none).unwrap_err().to_string();
        assert!(error.contains("elbow_joint"), "{error}");
    }
}

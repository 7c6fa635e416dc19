//! What can be wrong with a motion.

use crate::motion::plan::TrajectoryPoint;

/// Something wrong with a plan.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Violation {
    /// A point's vectors have the wrong length, or hold a NaN or infinity.
    #[error("point {point}: malformed")]
    Malformed {
        /// Index of the point.
        point: usize,
    },
    /// Time does not increase.
    #[error("point {point}: time {time_s:.9} s is not after the one before")]
    Time {
        /// Index of the point.
        point: usize,
        /// Its time.
        time_s: f64,
    },
    /// A joint beyond its position, speed, acceleration or jerk limit.
    #[error("point {point}: {quantity} of {joint} is {value:.9}, its limit {limit:.9}")]
    Limit {
        /// Index of the point.
        point: usize,
        /// What is beyond.
        quantity: &'static str,
        /// Name of the joint.
        joint: String,
        /// Its value, rad, rad/s, rad/s2 or rad/s3.
        value: f64,
        /// The limit.
        limit: f64,
    },
    /// Positions do not follow from velocities.
    #[error("point {point}: {joint} jumps by {jump_rad:.9} rad against its speeds")]
    Jump {
        /// Index of the point.
        point: usize,
        /// Name of the joint.
        joint: String,
        /// Difference to the motion its velocities give, radians.
        jump_rad: f64,
    },
    /// The motion does not begin at the start state.
    #[error("the motion begins {largest_rad:.9} rad from the start state")]
    Start {
        /// Largest difference of a joint, radians.
        largest_rad: f64,
    },
    /// A planned view is not visited as it should be.
    #[error("view {view}: {problem}")]
    View {
        /// Index of the view.
        view: usize,
        /// What is wrong.
        problem: &'static str,
    },
    /// The camera is not where a view wants it.
    #[error("view {view}: camera is {position_m:.9} m and {rotation_rad:.9} rad off")]
    PoseError {
        /// Index of the view.
        view: usize,
        /// Distance, metres.
        position_m: f64,
        /// Angle, radians.
        rotation_rad: f64,
    },
    /// Two bodies come too near.
    #[error("{time_s:.3} s: {first} and {second} are {distance_m:.4} m apart, margin {margin_m:.4} m")]
    TooNear {
        /// Time, seconds.
        time_s: f64,
        /// A link or the camera.
        first: String,
        /// What it comes too near to.
        second: String,
        /// Their distance, metres; negative when they overlap.
        distance_m: f64,
        /// The margin asked for.
        margin_m: f64,
    },
    /// Too much motion between two points to be judged.
    #[error("{time_s:.3} s: the motion from here on cannot be judged within the bounds of this check")]
    NotProven {
        /// Time, seconds.
        time_s: f64,
    },
}

impl Violation {
    /// The stable code.
    pub fn code(&self) -> &'static str {
        match self {
            Violation::Malformed { .. } => "malformed_point",
            Violation::Time { .. } => "time_not_increasing",
            Violation::Limit { quantity, .. } => match *quantity {
                "position" => "joint_limit",
                "acceleration" | "mean acceleration" => "acceleration_limit",
                "jerk" => "jerk_limit",
                _ => "speed_limit",
            },
            Violation::Jump { .. } => "jump",
            Violation::Start { .. } => "wrong_start",
            Violation::View { .. } => "view_not_taken",
            Violation::PoseError { .. } => "wrong_pose",
            Violation::TooNear { .. } => "too_near",
            Violation::NotProven { .. } => "not_proven",
        }
    }

    /// The numbers of the message by name, each with its unit in the name.
    pub fn numbers(&self) -> Vec<(&'static str, f64)> {
        match self {
            Violation::Malformed { point } => vec![("point", *point as f64)],
            Violation::Time { point, time_s } => vec![("point", *point as f64), ("time_s", *time_s)],
            Violation::Limit { point, quantity, value, limit, .. } => {
                let (value_name, limit_name) = match *quantity {
                    "position" => ("value_rad", "limit_rad"),
                    "acceleration" | "mean acceleration" => ("value_rad_per_s2", "limit_rad_per_s2"),
                    "jerk" => ("value_rad_per_s3", "limit_rad_per_s3"),
                    _ => ("value_rad_per_s", "limit_rad_per_s"),
                };
                vec![("point", *point as f64), (value_name, *value), (limit_name, *limit)]
            }
            Violation::Jump { point, jump_rad, .. } => {
                vec![("point", *point as f64), ("jump_rad", *jump_rad)]
            }
            Violation::Start { largest_rad } => vec![("largest_rad", *largest_rad)],
            Violation::View { view, .. } => vec![("view", *view as f64)],
            Violation::PoseError { view, position_m, rotation_rad } => {
                vec![("view", *view as f64), ("position_m", *position_m), ("rotation_rad", *rotation_rad)]
            }
            Violation::TooNear { distance_m, margin_m, .. } => {
                vec![("distance_m", *distance_m), ("margin_m", *margin_m)]
            }
            Violation::NotProven { .. } => Vec::new(),
        }
    }

    /// Names of the joint or of the two parts concerned.
    pub fn parts(&self) -> Vec<String> {
        match self {
            Violation::Limit { joint, .. } | Violation::Jump { joint, .. } => vec![joint.clone()],
            Violation::TooNear { first, second, .. } => vec![first.clone(), second.clone()],
            _ => Vec::new(),
        }
    }

    /// When it happens, as far as the violation or the trajectory's points tell, seconds.
    pub fn time_s(&self, trajectory: &[TrajectoryPoint]) -> Option<f64> {
        let at = |point: usize| trajectory.get(point).map(|p| p.time_from_start_s);
        match self {
            Violation::TooNear { time_s, .. } | Violation::NotProven { time_s } => Some(*time_s),
            Violation::Malformed { point }
            | Violation::Time { point, .. }
            | Violation::Limit { point, .. }
            | Violation::Jump { point, .. } => at(*point),
            Violation::Start { .. } => at(0),
            Violation::View { view, .. } | Violation::PoseError { view, .. } => {
                let taken = trajectory.iter().find(|p| p.view == Some(*view));
                taken.map(|p| p.time_from_start_s)
            }
        }
    }
}

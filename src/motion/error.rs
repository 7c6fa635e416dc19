//! What makes a motion request unusable as a whole. A view that cannot be reached is not an error.

use crate::robot::RobotError;

/// Why no plan can be made.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum MotionError {
    /// The start state does not fit the arm.
    #[error("start: {0}")]
    Start(#[from] RobotError),
    /// The arm has too many joints, or its parts disagree about their number.
    #[error("the arm has {found} joints, this planner takes 1 to {most}")]
    JointCount {
        /// Joints of the kinematics.
        found: usize,
        /// Most joints.
        most: usize,
    },
    /// A joint's limits leave no room to move.
    #[error("joint {joint}: limits must be ordered, speed and acceleration finite and above 0")]
    JointLimits {
        /// The joint's name.
        joint: String,
    },
    /// A NaN, an infinity or a negative size.
    #[error("{field} must be finite numbers with sizes of at least 0")]
    NotFinite {
        /// The field.
        field: String,
    },
    /// A number beyond its bounds.
    #[error("{field} is {value}, must be within [{least}, {most}]")]
    OutOfRange {
        /// The field.
        field: String,
        /// Its value.
        value: f64,
        /// Least allowed.
        least: f64,
        /// Most allowed.
        most: f64,
    },
    /// The arm collides where it starts.
    #[error("start: {first} and {second} overlap by {depth_m:.4} m")]
    StartCollides {
        /// A link or the camera.
        first: String,
        /// What it collides with.
        second: String,
        /// Penetration, metres.
        depth_m: f64,
    },
    /// The ordering callback did not return each view it was given exactly once.
    #[error("the order is no permutation of the {expected} reachable views")]
    BadOrder {
        /// Number of views that had to be ordered.
        expected: usize,
    },
    /// The trajectory would be too long.
    #[error("the motion takes {duration_s:.1} s, more than {most} points at one every {sample_period_s} s")]
    TooManyPoints {
        /// Most points.
        most: usize,
        /// Time in motion, rests left out, seconds.
        duration_s: f64,
        /// The period asked for, seconds.
        sample_period_s: f64,
        /// The share of the speed limits asked for.
        speed_scale: f64,
        /// The least period that would do, seconds; `None` where none does.
        least_period_s: Option<f64>,
    },
    /// Nobody waits for the answer any more: see [`Stop`](super::Stop).
    #[error("stopped before the end")]
    Stopped,
}

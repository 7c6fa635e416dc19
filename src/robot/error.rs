//! What can be wrong with a robot's description or a joint state.

/// A robot that cannot be built, or a joint state it cannot take.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum RobotError {
    /// No built-in model has this name.
    #[error("unknown robot model {name:?}; known: {known}")]
    UnknownModel {
        /// The name given (cut to 64 characters).
        name: String,
        /// The names there are.
        known: String,
    },
    /// Too few or too many moving joints.
    #[error("{found} moving joints; {least} to {most} are supported")]
    JointCount {
        /// The number found.
        found: usize,
        /// The smallest number supported.
        least: usize,
        /// The largest number supported.
        most: usize,
    },
    /// A number that is NaN, infinite or out of its bounds.
    #[error("{joint}: {field} is {value}, must be within [{least}, {most}]{hint}")]
    OutOfRange {
        /// The joint (or link) it belongs to.
        joint: String,
        /// The field of it.
        field: &'static str,
        /// Its value.
        value: f64,
        /// Smallest allowed value.
        least: f64,
        /// Largest allowed value.
        most: f64,
        /// What may have gone wrong, starting with a separator; or empty.
        hint: &'static str,
    },
    /// A number of a DH table that is NaN, infinite or out of its bounds.
    #[error("dh[{row}].{field} is {value}, must be within [{least}, {most}]{hint}")]
    DhRow {
        /// Index of the row.
        row: usize,
        /// The member of it, as in a request.
        field: &'static str,
        /// Its value.
        value: f64,
        /// Smallest allowed value.
        least: f64,
        /// Largest allowed value.
        most: f64,
        /// What may have gone wrong, starting with a separator; or empty.
        hint: &'static str,
    },
    /// No joint of the robot has this name.
    #[error("the robot has no joint {name:?}; its joints: {known}")]
    UnknownJoint {
        /// The name given (cut to 64 characters).
        name: String,
        /// The names there are.
        known: String,
    },
    /// A number that is no limit of a joint.
    #[error("{joint}: {field} is {value}, must be {bound}")]
    Limit {
        /// The joint.
        joint: String,
        /// `min`, `max`, `max_speed`, `max_acceleration` or `max_jerk`.
        field: &'static str,
        /// The number given.
        value: f64,
        /// What it must be.
        bound: String,
    },
    /// A joint state of the wrong length.
    #[error("{found} joint values given, the robot has {expected} joints")]
    StateLength {
        /// The number of values given.
        found: usize,
        /// The number of joints.
        expected: usize,
    },
    /// A joint state beyond a joint's limit.
    #[error("{joint} is at {value_rad} rad, beyond its limit {bound_rad} rad")]
    BeyondLimit {
        /// Index of the joint.
        index: usize,
        /// The joint.
        joint: String,
        /// Its value, radians.
        value_rad: f64,
        /// The limit it breaks, radians.
        bound_rad: f64,
    },
    /// A URDF that is too large, or no URDF.
    #[error("URDF: {0}")]
    Urdf(String),
    /// A URDF joint or link that does not fit a serial arm.
    #[error("URDF {kind} {name:?}: {problem}")]
    UrdfElement {
        /// `joint` or `link`.
        kind: &'static str,
        /// Its name (cut to 64 characters).
        name: String,
        /// What is wrong with it.
        problem: String,
    },
}

/// `name` cut to 64 characters, for messages that carry text from outside.
pub(super) fn short(name: &str) -> String {
    name.chars().take(64).collect()
}

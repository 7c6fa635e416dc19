//! What a caller should know about a robot although it can be planned with.

use super::Joint;

/// Speeds beyond this are no arm's, rad/s: small arms turn their wrists at 6, the fastest at 20.
const FASTEST_RAD_PER_S: f64 = 30.0;

/// A warning about a robot.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RobotWarning {
    /// Stable name: `robot_description`, `mesh_left_out`, `mesh_replaced`, `mesh_unused`, `limit_widened`,
    /// `unused_jerk_limit` or `speed_in_degrees`.
    pub code: &'static str,
    /// For people, with names and numbers.
    pub message: String,
}

impl RobotWarning {
    /// Something left out of or assumed about a described robot.
    pub fn description(message: impl Into<String>) -> Self {
        Self { code: "robot_description", message: message.into() }
    }

    /// A collision mesh that is not part of the links' shapes.
    pub fn mesh_left_out(message: impl Into<String>) -> Self {
        Self { code: "mesh_left_out", message: message.into() }
    }

    /// A collision mesh that another shape stands for.
    pub fn mesh_replaced(message: impl Into<String>) -> Self {
        Self { code: "mesh_replaced", message: message.into() }
    }

    /// An attached file that no collision mesh names.
    pub fn mesh_unused(message: impl Into<String>) -> Self {
        Self { code: "mesh_unused", message: message.into() }
    }

    /// Jerk limits of a request that bounds no jerk.
    pub fn unused_jerk_limit(joints: &[&str]) -> Self {
        let message =
            format!("the jerk limits of {} bind nothing: timing.jerk_limited is false", joints.join(", "));
        Self { code: "unused_jerk_limit", message }
    }

    /// A speed limit that no arm has but many have in degrees.
    pub fn speed_in_degrees(joint: &Joint) -> Option<Self> {
        let speed = joint.max_speed_rad_per_s;
        (speed > FASTEST_RAD_PER_S).then(|| {
            let message = format!(
                "{}: a speed limit of {speed} rad/s is taken as given; degrees? {speed} deg/s are {:.4} rad/s",
                joint.name,
                speed.to_radians()
            );
            Self { code: "speed_in_degrees", message }
        })
    }

    /// A position limit beyond the model's own.
    pub fn limit_widened(message: impl Into<String>) -> Self {
        Self { code: "limit_widened", message: message.into() }
    }
}

impl std::fmt::Display for RobotWarning {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.message)
    }
}

//! What a caller should know about a robot although it can be planned with.

/// A warning about a robot.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RobotWarning {
    /// Stable name: `robot_description`, `mesh_left_out`, `mesh_replaced` or `limit_widened`.
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

//! Why a run cannot go on.

/// A run that cannot start or go on.
#[derive(Debug, thiserror::Error)]
pub enum SimulateError {
    /// The trajectory has no points, times that do not increase, or joints that do not fit.
    #[error("point {index} of the trajectory: {problem}")]
    Trajectory {
        /// Index of the point.
        index: usize,
        /// What is wrong with it.
        problem: String,
    },
    /// The speed factor.
    #[error("speed_factor is {value}, must be from {least} to {most}")]
    SpeedFactor {
        /// The value.
        value: f64,
        /// Least.
        least: f64,
        /// Most.
        most: f64,
    },
    /// Nothing to photograph: no planned views.
    #[error("the plan visits no view")]
    NoViews,
    /// An image or file could not be written.
    #[error("{path}: {reason}")]
    Write {
        /// Which file.
        path: String,
        /// Why.
        reason: String,
    },
}

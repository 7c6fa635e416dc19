//! Why there is no plan.

use crate::imaging::CameraError;
use crate::motion::MotionError;
use crate::order::OrderError;
use crate::predict::PredictError;
use crate::robot::RobotError;
use crate::views::ViewsError;

/// A refused value.
#[derive(Clone, Debug, PartialEq)]
pub enum FieldValue {
    /// Nothing was given.
    Missing,
    /// A number.
    Number(f64),
    /// Several numbers.
    Numbers(Vec<f64>),
    /// A text.
    Text(String),
}

/// Why a request cannot be planned.
#[derive(Debug, thiserror::Error)]
pub enum PlanError {
    /// A member of the request is out of its bound.
    #[error("{field} is {value}, must be {bound}")]
    Invalid {
        /// Stable name of the problem.
        code: &'static str,
        /// Path of the member in the request.
        field: String,
        /// Its value.
        value: FieldValue,
        /// What it must be.
        bound: String,
    },
    /// The camera's numbers.
    #[error(transparent)]
    Camera(#[from] CameraError),
    /// The band or the number of views.
    #[error(transparent)]
    Views(#[from] ViewsError),
    /// The order; the request's check leaves no way to it.
    #[error(transparent)]
    Order(#[from] OrderError),
    /// The robot's description or its start.
    #[error(transparent)]
    Robot(#[from] RobotError),
    /// The motion as a whole.
    #[error(transparent)]
    Motion(#[from] MotionError),
    /// The prediction.
    #[error(transparent)]
    Predict(#[from] PredictError),
    /// Photos were given to a service without a working model.
    #[error("no prediction is possible: {cause}")]
    NoPredictor {
        /// Why not.
        cause: String,
    },
}

impl PlanError {
    /// A number out of its bound.
    pub fn number(
        code: &'static str,
        field: impl Into<String>,
        value: f64,
        bound: impl Into<String>,
    ) -> Self {
        Self::Invalid { code, field: field.into(), value: FieldValue::Number(value), bound: bound.into() }
    }

    /// A member that is missing.
    pub fn missing(field: impl Into<String>, bound: impl Into<String>) -> Self {
        Self::Invalid {
            code: "missing_member",
            field: field.into(),
            value: FieldValue::Missing,
            bound: bound.into(),
        }
    }
}

impl std::fmt::Display for FieldValue {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Missing => f.write_str("missing"),
            Self::Number(number) => write!(f, "{number}"),
            Self::Numbers(numbers) => write!(f, "{numbers:?}"),
            Self::Text(text) => write!(f, "{text:?}"),
        }
    }
}

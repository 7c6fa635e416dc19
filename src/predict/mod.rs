//! PRVNet: how many views an object needs, from one to five photos of it (paper, section on PRVNet).
//!
//! [`crop`] turns a photo into the network's input, [`Predictor`] runs the network in ONNX Runtime. The network comes
//! out of `models/training`; [`ModelInfo`] is what its file says about it. The same photos give the same number,
//! whatever runs beside. With the number come the interval that holds 80 % of the labels, and how unlike the objects
//! trained on the photos are.

mod crop;
mod error;
mod interval;
mod model_info;
mod pixels;
mod predictor;
mod runtime;
mod session_pool;
mod shipped;

#[cfg(test)]
mod crop_tests;
#[cfg(test)]
mod golden_tests;
#[cfg(test)]
mod predictor_tests;

pub use crop::{CROP_HALF_SIZE_M, crop};
pub use error::PredictError;
pub use interval::IntervalOffsets;
pub use model_info::ModelInfo;
pub use predictor::{MAX_IMAGES, PhotoInput, Prediction, Predictor};
pub use runtime::DYLIB_VARIABLE;
pub use shipped::{SHIPPED_MODEL, model_bytes};

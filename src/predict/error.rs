//! What can go wrong in a prediction.

use std::path::PathBuf;

use crate::imaging::CameraError;

/// Why there is no prediction.
#[derive(Debug, thiserror::Error)]
pub enum PredictError {
    /// ONNX Runtime's library could not be loaded.
    #[error("ONNX Runtime is not available: {reason}")]
    Runtime {
        /// What was tried and what it said.
        reason: String,
    },
    /// There are no model bytes: none shipped, none given.
    #[error("there is no prediction model: this build ships none, give one with --model FILE (PRV_MODEL)")]
    NoModel,
    /// The model file given cannot be read.
    #[error("the prediction model {path} cannot be read: {source}")]
    ModelFile {
        /// The file.
        path: PathBuf,
        /// Why not.
        source: std::io::Error,
    },
    /// The model is not one this code can use.
    #[error("the prediction model cannot be used: {field} is {value}, must be {bound}")]
    Model {
        /// Which part of the model.
        field: String,
        /// What it is.
        value: String,
        /// What it must be.
        bound: String,
    },
    /// ONNX Runtime refused the model or failed to run it.
    #[error("the prediction model failed to {action}: {reason}")]
    Session {
        /// "load" or "run".
        action: &'static str,
        /// ONNX Runtime's words.
        reason: String,
    },
    /// Too few or too many images.
    #[error("{count} images, must be 1 to {max}")]
    ImageCount {
        /// How many were given.
        count: usize,
        /// The most that are taken.
        max: usize,
    },
    /// An image is not of the size its camera says.
    #[error(
        "image {index} has {width}x{height} pixels, its camera {camera_width}x{camera_height}: must be equal"
    )]
    ImageSize {
        /// Which image, from 0.
        index: usize,
        /// The image's width, pixels.
        width: u32,
        /// The image's height, pixels.
        height: u32,
        /// The camera's width, pixels.
        camera_width: u32,
        /// The camera's height, pixels.
        camera_height: u32,
    },
    /// A camera's numbers are out of range.
    #[error("image {index}: {source}")]
    Camera {
        /// Which image, from 0.
        index: usize,
        /// Which number.
        source: CameraError,
    },
    /// The object's centre lies where the camera cannot see it.
    #[error("image {index}: the object's centre in the camera frame has {field} {value} m, must be {bound}")]
    Center {
        /// Which image, from 0.
        index: usize,
        /// "z", "x/z" or "distance".
        field: &'static str,
        /// The value given, metres (or a ratio for "x/z").
        value: f64,
        /// The bound in words.
        bound: &'static str,
    },
}

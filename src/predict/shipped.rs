//! Which model file is used: the one that comes with the executable, or the user's.

use std::borrow::Cow;
use std::path::Path;

use super::PredictError;

/// The bytes of `models/prvnet.onnx` at build time; empty if there was no such file.
pub static SHIPPED_MODEL: &[u8] = include!(concat!(env!("OUT_DIR"), "/shipped_model.rs"));

/// The bytes of the model at `path`, or of the shipped one.
///
/// # Errors
/// [`PredictError::NoModel`] without a path in a build that ships none,
/// [`PredictError::ModelFile`] for a file that cannot be read.
pub fn model_bytes(path: Option<&Path>) -> Result<Cow<'static, [u8]>, PredictError> {
    match path {
        Some(path) => std::fs::read(path)
            .map(Cow::Owned)
            .map_err(|source| PredictError::ModelFile { path: path.to_path_buf(), source }),
        None if SHIPPED_MODEL.is_empty() => Err(PredictError::NoModel),
        None => Ok(Cow::Borrowed(SHIPPED_MODEL)),
    }
}

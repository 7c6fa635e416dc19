//! The model that comes with the executable.

/// The bytes of `models/prvnet.onnx` at build time; empty if there was no such file.
pub static SHIPPED_MODEL: &[u8] = include!(concat!(env!("OUT_DIR"), "/shipped_model.rs"));

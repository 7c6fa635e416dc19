//! Cameras and images: pinhole with distortion, decoding, quality figures.

mod camera;
mod posed_image;

pub use camera::{Camera, CameraError, Distortion};
pub use posed_image::PosedImage;

//! Cameras and images: pinhole with distortion, decoding, quality figures.

mod camera;
mod composite;
mod decode;
mod posed_image;
mod psnr;
mod ssim;
pub mod transforms;

pub use camera::{Camera, CameraError, Distortion};
pub use composite::composite;
pub use decode::{DEFAULT_MAX_PIXELS, DecodeError, decode_image};
pub use posed_image::PosedImage;
pub use psnr::psnr;
pub use ssim::ssim;

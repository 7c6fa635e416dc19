//! An image together with where it was taken.

use image::RgbaImage;

use super::Camera;
use crate::geometry::Pose;

/// An image, the camera that took it and the camera's pose.
#[derive(Clone, Debug)]
pub struct PosedImage {
    /// sRGB, straight (not premultiplied) alpha; alpha 255 everywhere for a photo without a mask.
    pub image: RgbaImage,
    /// Intrinsics; `camera.width` x `camera.height` is the image's size.
    pub camera: Camera,
    /// The camera's pose in the world frame, OpenCV axes.
    pub world_from_camera: Pose,
}

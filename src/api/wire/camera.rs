//! Cameras.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// Pinhole intrinsics in pixels with OpenCV's five-parameter distortion. Pixel centres lie at
/// half-integers.
#[derive(Clone, Copy, Debug, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
#[schema(as = Camera, example = json!({"width": 1280, "height": 720, "fx": 915.607, "fy": 913.327, "cx": 647.145, "cy": 372.515, "distortion": [0.0, 0.0, 0.0, 0.0, 0.0]}))]
pub struct CameraJson {
    /// Image width in pixels, 1 to 16384.
    #[serde(deserialize_with = "super::whole::whole")]
    pub width: u32,
    /// Image height in pixels, 1 to 16384.
    #[serde(deserialize_with = "super::whole::whole")]
    pub height: u32,
    /// Focal length along x in pixels.
    pub fx: f64,
    /// Focal length along y in pixels.
    pub fy: f64,
    /// Principal point x in pixels.
    pub cx: f64,
    /// Principal point y in pixels.
    pub cy: f64,
    /// k1, k2, p1, p2, k3; none when left out.
    #[serde(default)]
    pub distortion: [f64; 5],
}

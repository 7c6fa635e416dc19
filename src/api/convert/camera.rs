//! Cameras.

use crate::api::problem::Problem;
use crate::api::wire::CameraJson;
use crate::imaging::{Camera, Distortion};

/// The camera, its numbers checked.
///
/// # Errors
/// 422 naming the number.
pub fn camera(json: &CameraJson) -> Result<Camera, Problem> {
    let [k1, k2, p1, p2, k3] = json.distortion;
    let camera = Camera {
        width: json.width,
        height: json.height,
        fx: json.fx,
        fy: json.fy,
        cx: json.cx,
        cy: json.cy,
        distortion: Distortion { k1, k2, p1, p2, k3 },
    };
    camera.check()?;
    Ok(camera)
}

/// The camera's JSON.
pub fn camera_json(camera: &Camera) -> CameraJson {
    let d = camera.distortion;
    CameraJson {
        width: camera.width,
        height: camera.height,
        fx: camera.fx,
        fy: camera.fy,
        cx: camera.cx,
        cy: camera.cy,
        distortion: [d.k1, d.k2, d.p1, d.p2, d.k3],
    }
}

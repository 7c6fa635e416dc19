//! Between our camera and the file's fields.

use super::file::Intrinsics;
use crate::imaging::{Camera, Distortion};

/// Camera models that OPENCV's five coefficients cover.
const MODELS: [&str; 6] = ["OPENCV", "PINHOLE", "SIMPLE_PINHOLE", "PERSPECTIVE", "SIMPLE_RADIAL", "RADIAL"];

/// Every field of a pinhole camera with distortion.
pub(super) fn fields_of(camera: &Camera) -> Intrinsics {
    let angle = |size: u32, focal: f64| 2.0 * (f64::from(size) / (2.0 * focal)).atan();
    let d = &camera.distortion;
    Intrinsics {
        camera_model: Some("OPENCV".to_owned()),
        camera_angle_x: Some(angle(camera.width, camera.fx)),
        camera_angle_y: Some(angle(camera.height, camera.fy)),
        fl_x: Some(camera.fx),
        fl_y: Some(camera.fy),
        cx: Some(camera.cx),
        cy: Some(camera.cy),
        w: Some(f64::from(camera.width)),
        h: Some(f64::from(camera.height)),
        k1: Some(d.k1),
        k2: Some(d.k2),
        k3: Some(d.k3),
        p1: Some(d.p1),
        p2: Some(d.p2),
    }
}

/// The camera of an image of `width` x `height` pixels: a frame's own fields before
/// the file's. On error the field's name and what is wrong.
pub(super) fn camera_of(
    frame: &Intrinsics,
    file: &Intrinsics,
    (width, height): (u32, u32),
) -> Result<Camera, (&'static str, String)> {
    if let Some(model) = frame.camera_model.as_ref().or(file.camera_model.as_ref())
        && !MODELS.contains(&model.as_str())
    {
        return Err(("camera_model", format!("is {model}, must be one of {}", MODELS.join(", "))));
    }
    for (field, stated, size) in
        [("w", frame.w.or(file.w), f64::from(width)), ("h", frame.h.or(file.h), f64::from(height))]
    {
        if stated.is_some_and(|stated| stated != size) {
            return Err((field, format!("is {}, the image has {size} pixels", stated.unwrap_or_default())));
        }
    }
    let from_angle = |angle: Option<f64>, size: u32| angle.map(|a| f64::from(size) / (2.0 * (a / 2.0).tan()));
    let fx = frame
        .fl_x
        .or_else(|| from_angle(frame.camera_angle_x, width))
        .or(file.fl_x)
        .or_else(|| from_angle(file.camera_angle_x, width))
        .ok_or(("fl_x", "is missing, and so is camera_angle_x".to_owned()))?;
    let fy = frame
        .fl_y
        .or_else(|| from_angle(frame.camera_angle_y, height))
        // A frame that has its own x but no y has square pixels.
        .or(frame.fl_x.or_else(|| from_angle(frame.camera_angle_x, width)))
        .or(file.fl_y)
        .or_else(|| from_angle(file.camera_angle_y, height))
        .unwrap_or(fx);
    let pick = |own: Option<f64>, shared: Option<f64>| own.or(shared).unwrap_or(0.0);
    let camera = Camera {
        width,
        height,
        fx,
        fy,
        cx: frame.cx.or(file.cx).unwrap_or(f64::from(width) / 2.0),
        cy: frame.cy.or(file.cy).unwrap_or(f64::from(height) / 2.0),
        distortion: Distortion {
            k1: pick(frame.k1, file.k1),
            k2: pick(frame.k2, file.k2),
            p1: pick(frame.p1, file.p1),
            p2: pick(frame.p2, file.p2),
            k3: pick(frame.k3, file.k3),
        },
    };
    camera.check().map_err(|error| ("intrinsics", format!("cannot be used: {error}")))?;
    Ok(camera)
}

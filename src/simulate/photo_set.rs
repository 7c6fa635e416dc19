//! What a run leaves on disk beside its photos.

use std::path::{Path, PathBuf};

use super::SimulateError;
use crate::files::replace_unsynced;
use crate::geometry::{Point, Pose};
use crate::imaging::Camera;
use crate::imaging::transforms::{SceneCube, TransformsFrame, transforms_text};

/// The scene's cube over the object's sphere: a NeRF needs some room around a surface.
const ROOM: f64 = 1.1;

/// The text of a `transforms.json` for `photos` (path relative to it, `base_from_camera`) of one camera
/// and an object in the sphere about `center_in_base`, metres.
///
/// # Errors
/// [`SimulateError::Write`] for numbers that are not finite.
pub fn photo_set_text(
    camera: &Camera,
    photos: &[(PathBuf, Pose)],
    center_in_base: &Point,
    object_radius_m: f64,
) -> Result<String, SimulateError> {
    let frame = |(file, pose): &(PathBuf, Pose)| TransformsFrame {
        file_path: file.clone(),
        camera: *camera,
        world_from_camera: *pose,
    };
    let frames: Vec<TransformsFrame> = photos.iter().map(frame).collect();
    let cube = SceneCube { center: *center_in_base, half_extent_m: ROOM * object_radius_m };
    transforms_text(&frames, &cube).map_err(|error| SimulateError::Write {
        path: "transforms.json".to_owned(),
        reason: error.to_string(),
    })
}

/// Writes the `transforms.json` of [`photo_set_text`] into `directory`.
///
/// # Errors
/// [`SimulateError::Write`].
pub fn write_photo_set(
    directory: &Path,
    camera: &Camera,
    photos: &[(PathBuf, Pose)],
    center_in_base: &Point,
    object_radius_m: f64,
) -> Result<(), SimulateError> {
    let text = photo_set_text(camera, photos, center_in_base, object_radius_m)?;
    let path = directory.join("transforms.json");
    replace_unsynced(&path, text.as_bytes())
        .map_err(|error| SimulateError::Write { path: path.display().to_string(), reason: error.to_string() })
}

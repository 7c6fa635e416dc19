//! What a run leaves on disk beside its photos.

use std::path::{Path, PathBuf};

use super::SimulateError;
use crate::geometry::{Point, Pose};
use crate::imaging::Camera;
use crate::imaging::transforms::{SceneCube, TransformsFrame, write_transforms};

/// The scene's cube over the object's sphere: a NeRF needs some room around a surface.
const ROOM: f64 = 1.1;

/// Writes `transforms.json` into `directory` for `photos` (path relative to it, `base_from_camera`)
/// of one camera and an object in the sphere about `center_in_base`.
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
    let frame = |(file, pose): &(PathBuf, Pose)| TransformsFrame {
        file_path: file.clone(),
        camera: *camera,
        world_from_camera: *pose,
    };
    let frames: Vec<TransformsFrame> = photos.iter().map(frame).collect();
    let cube = SceneCube { center: *center_in_base, half_extent_m: ROOM * object_radius_m };
    write_transforms(directory, &frames, &cube).map_err(|error| SimulateError::Write {
        path: directory.join("transforms.json").display().to_string(),
        reason: error.to_string(),
    })
}

//! Writes `transforms.json`.

use std::fs;
use std::path::{Path, PathBuf};

use super::axes::matrix_of;
use super::file::{Frame, Intrinsics, Transforms};
use super::intrinsics::fields_of;
use super::{SceneCube, TransformsError};
use crate::files::replace_unsynced;
use crate::geometry::Pose;
use crate::imaging::{Camera, PosedImage};

/// An image on disk with its camera and pose.
#[derive(Clone, Debug)]
pub struct TransformsFrame {
    /// Path of the image relative to the folder of `transforms.json`.
    pub file_path: PathBuf,
    /// Intrinsics.
    pub camera: Camera,
    /// The camera's pose, OpenCV axes.
    pub world_from_camera: Pose,
}

/// The text of a `transforms.json`. Intrinsics stand at the top if all frames share them, else with each
/// frame. instant-ngp takes `cube` as its bounding box; nerfstudio ignores it.
///
/// # Errors
/// Those of serialising: a number that is not finite.
pub fn transforms_text(frames: &[TransformsFrame], cube: &SceneCube) -> Result<String, serde_json::Error> {
    let shared = frames.first().filter(|first| frames.iter().all(|f| f.camera == first.camera));
    let scale = 0.5 / cube.half_extent_m;
    let content = Transforms {
        intrinsics: shared.map(|f| fields_of(&f.camera)).unwrap_or_default(),
        aabb_scale: Some(1.0),
        scale: Some(scale),
        offset: Some(std::array::from_fn(|axis| 0.5 - scale * cube.center[axis])),
        frames: frames
            .iter()
            .map(|f| Frame {
                file_path: slashed(&f.file_path),
                intrinsics: if shared.is_some() { Intrinsics::default() } else { fields_of(&f.camera) },
                transform_matrix: matrix_of(&f.world_from_camera),
            })
            .collect(),
    };
    serde_json::to_string_pretty(&content).map(|text| text + "\n")
}

/// Writes `dir/transforms.json` (see [`transforms_text`]), replacing it at once.
///
/// # Errors
/// [`TransformsError::Write`] if the file cannot be written.
pub fn write_transforms(
    dir: &Path,
    frames: &[TransformsFrame],
    cube: &SceneCube,
) -> Result<(), TransformsError> {
    let path = dir.join("transforms.json");
    let text = transforms_text(frames, cube)
        .map_err(|source| TransformsError::Json { path: path.clone(), source })?;
    replace_unsynced(&path, text.as_bytes()).map_err(|source| TransformsError::Write { path, source })
}

/// Writes every image as `dir/images/0000.png` and so on, then `dir/transforms.json`.
///
/// # Errors
/// If a folder or file cannot be written.
pub fn write_image_set(dir: &Path, images: &[PosedImage], cube: &SceneCube) -> Result<(), TransformsError> {
    let folder = dir.join("images");
    fs::create_dir_all(&folder).map_err(|source| TransformsError::Write { path: folder.clone(), source })?;
    let mut frames = Vec::with_capacity(images.len());
    for (i, posed) in images.iter().enumerate() {
        let file_path = Path::new("images").join(format!("{i:04}.png"));
        let path = dir.join(&file_path);
        posed.image.save(&path).map_err(|source| TransformsError::Encode { path, source })?;
        let (camera, world_from_camera) = (posed.camera, posed.world_from_camera);
        frames.push(TransformsFrame { file_path, camera, world_from_camera });
    }
    write_transforms(dir, &frames, cube)
}

/// The path with forward slashes, as every reader of the file expects.
fn slashed(path: &Path) -> String {
    let parts: Vec<_> = path.components().map(|c| c.as_os_str().to_string_lossy()).collect();
    parts.join("/")
}

//! Reads folders with `transforms.json`, ours, instant-ngp's, nerfstudio's or
//! synthetic NeRF's (`transforms_train.json`, `transforms_test.json`).

use std::fs;
use std::path::{Path, PathBuf};

use super::axes::pose_of;
use super::file::{Frame, Intrinsics, Transforms};
use super::intrinsics::camera_of;
use super::split::hold_out;
use super::{SceneCube, TransformsError};
use crate::geometry::Point;
use crate::imaging::{DEFAULT_MAX_PIXELS, PosedImage, decode_image};

/// Every eighth frame is held out of a folder without test frames of its own.
pub const DEFAULT_TEST_EVERY: usize = 8;
/// instant-ngp's `scale` and `offset` where a file has none.
const NGP_SCALE: f64 = 0.33;
const NGP_OFFSET: [f64; 3] = [0.5; 3];

/// The images of a folder.
#[derive(Clone, Debug)]
pub struct ImageSet {
    /// Frames to train on.
    pub train: Vec<PosedImage>,
    /// Frames to test on; may be empty.
    pub test: Vec<PosedImage>,
    /// The cube from `scale`, `offset` and `aabb_scale`; instant-ngp's default, half an
    /// extent of 1.515 about the origin, where the file does not say.
    pub cube: SceneCube,
}

/// Reads `dir/transforms_train.json` and `transforms_test.json` (or, without that,
/// `transforms_val.json`), or `dir/transforms.json` (`dir` may also be that file).
/// Where there is no file of test frames every `test_every`-th frame, beginning with
/// the first, is held out; 0 or 1 holds none out.
///
/// Intrinsics come from a frame's own fields, else from the file's; `camera_angle_x`
/// serves where `fl_x` is missing, the image's middle where `cx` and `cy` are. A
/// `file_path` without extension may be a PNG or a JPEG.
///
/// # Errors
/// [`TransformsError`] names the file and the field.
pub fn read_transforms(dir: &Path, test_every: usize) -> Result<ImageSet, TransformsError> {
    if dir.is_file() {
        let (frames, cube) = read_file(dir)?;
        let (train, test) = hold_out(frames, test_every);
        return Ok(ImageSet { train, test, cube });
    }
    let train_file = dir.join("transforms_train.json");
    if !train_file.is_file() {
        let whole = dir.join("transforms.json");
        if !whole.is_file() {
            return Err(TransformsError::Missing { dir: dir.to_owned() });
        }
        return read_transforms(&whole, test_every);
    }
    let (train, cube) = read_file(&train_file)?;
    let test_files = ["transforms_test.json", "transforms_val.json"].map(|name| dir.join(name));
    match test_files.iter().find(|file| file.is_file()) {
        Some(file) => Ok(ImageSet { train, test: read_file(file)?.0, cube }),
        None => {
            let (train, test) = hold_out(train, test_every);
            Ok(ImageSet { train, test, cube })
        }
    }
}

fn read_file(path: &Path) -> Result<(Vec<PosedImage>, SceneCube), TransformsError> {
    let text = fs::read(path).map_err(|source| TransformsError::Read { path: path.to_owned(), source })?;
    let content: Transforms = serde_json::from_slice(&text)
        .map_err(|source| TransformsError::Json { path: path.to_owned(), source })?;
    let field =
        |field: String, problem: String| TransformsError::Field { path: path.to_owned(), field, problem };
    if content.frames.is_empty() {
        return Err(field("frames".to_owned(), "is empty, must have at least 1 frame".to_owned()));
    }
    let cube = cube_of(&content).map_err(|(name, problem)| field(name.to_owned(), problem))?;
    let folder = path.parent().unwrap_or(Path::new("."));
    let frames = content.frames.iter().enumerate().map(|(i, frame)| {
        read_frame(folder, frame, &content.intrinsics, |name, problem| {
            field(format!("frames[{i}].{name}"), problem)
        })
    });
    Ok((frames.collect::<Result<_, _>>()?, cube))
}

fn read_frame(
    folder: &Path,
    frame: &Frame,
    shared: &Intrinsics,
    field: impl Fn(&str, String) -> TransformsError,
) -> Result<PosedImage, TransformsError> {
    let world_from_camera =
        pose_of(&frame.transform_matrix).map_err(|problem| field("transform_matrix", problem))?;
    let path = image_file(folder, &frame.file_path)
        .ok_or_else(|| field("file_path", format!("is {}, no such image", frame.file_path)))?;
    let bytes = fs::read(&path).map_err(|source| TransformsError::Read { path: path.clone(), source })?;
    let image =
        decode_image(&bytes, DEFAULT_MAX_PIXELS).map_err(|source| TransformsError::Image { path, source })?;
    let camera = camera_of(&frame.intrinsics, shared, image.dimensions())
        .map_err(|(name, problem)| field(name, problem))?;
    Ok(PosedImage { image, camera, world_from_camera })
}

fn image_file(folder: &Path, file_path: &str) -> Option<PathBuf> {
    let endings = ["", ".png", ".jpg", ".jpeg", ".PNG", ".JPG"];
    endings.iter().map(|ending| folder.join(format!("{file_path}{ending}"))).find(|path| path.is_file())
}

fn cube_of(content: &Transforms) -> Result<SceneCube, (&'static str, String)> {
    let scale = content.scale.unwrap_or(NGP_SCALE);
    let offset = content.offset.unwrap_or(NGP_OFFSET);
    let boxes = content.aabb_scale.unwrap_or(1.0);
    if !(1e-6..1e6).contains(&scale) {
        return Err(("scale", format!("is {scale}, must be 1e-6 to 1e6")));
    }
    if !(1e-3..=1e3).contains(&boxes) {
        return Err(("aabb_scale", format!("is {boxes}, must be 0.001 to 1000")));
    }
    if let Some(bad) = offset.iter().find(|o| !o.is_finite() || o.abs() >= 1e6) {
        return Err(("offset", format!("has {bad}, must be finite and less than 1e6 in size")));
    }
    let center = Point::from(offset.map(|o| (0.5 - o) / scale));
    Ok(SceneCube { center, half_extent_m: 0.5 * boxes / scale })
}

//! A run's `transforms.json`, out of its record alone.

use std::path::PathBuf;

use crate::api::convert;
use crate::api::problem::Problem;
use crate::api::store::ExecutionRecord;
use crate::geometry::{Point, Pose};
use crate::simulate::photo_set_text;

/// The photo's file, relative to the run's directory.
pub fn photo_file(view: u32) -> PathBuf {
    PathBuf::from(format!("images/{view:03}.png"))
}

/// The text for the photos taken so far; `None` before the first, and for records of a version that did
/// not keep the object's place.
///
/// # Errors
/// 500 for a record that does not hold what this service wrote.
pub fn transforms(record: &ExecutionRecord) -> Result<Option<String>, Problem> {
    let Some(object) = record.object.filter(|_| !record.image_poses.is_empty()) else { return Ok(None) };
    let broken = |problem: Problem| Problem::internal(format!("a run's record: {}", problem.detail));
    let camera = convert::camera(&record.camera).map_err(broken)?;
    let mut photos: Vec<(PathBuf, Pose)> = Vec::with_capacity(record.image_poses.len());
    for (view, pose) in record.execution.images.iter().zip(&record.image_poses) {
        photos.push((photo_file(*view), convert::pose("image_poses", pose).map_err(broken)?));
    }
    Ok(Some(photo_set_text(&camera, &photos, &Point::from(object.center), object.radius)?))
}

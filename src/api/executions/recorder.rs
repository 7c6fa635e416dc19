//! Puts what happens in a run into its record and its directory.

use image::{DynamicImage, ImageFormat};
use serde_json::json;

use super::{Entry, photo_file};
use crate::api::convert::pose_json;
use crate::api::store::ExecutionStore;
use crate::files::replace_unsynced;
use crate::imaging::composite;
use crate::simulate::{Observer, Photo, SimulateError};

/// Watches a run for its entry.
pub(super) struct Recorder<'a> {
    pub(super) id: String,
    pub(super) entry: &'a Entry,
    pub(super) store: &'a ExecutionStore,
    pub(super) background: Option<[u8; 3]>,
}

impl Observer for Recorder<'_> {
    fn moved(&mut self, time_s: f64, joints_rad: Option<&[f64]>) {
        self.entry.touch(|execution| {
            execution.progress.time_s = time_s;
            if let (Some(joints), Some(angles)) = (&mut execution.joints, joints_rad) {
                joints.positions = angles.to_vec();
            }
        });
    }

    fn took(&mut self, photo: Photo<'_>) -> Result<(), SimulateError> {
        let view = photo.view as u32;
        let path = self.store.path(&self.id).join(photo_file(view));
        let fail = |reason: String| SimulateError::Write { path: path.display().to_string(), reason };
        let image: DynamicImage = match self.background {
            None => photo.image.clone().into(),
            Some(background) => composite(photo.image, background).into(),
        };
        let mut bytes = std::io::Cursor::new(Vec::new());
        image.write_to(&mut bytes, ImageFormat::Png).map_err(|error| fail(error.to_string()))?;
        replace_unsynced(&path, bytes.get_ref()).map_err(|error| fail(error.to_string()))?;
        let stored = self.entry.update(self.store, |record| {
            record.execution.images.push(view);
            record.image_poses.push(pose_json(&photo.base_from_camera));
            let progress = &mut record.execution.progress;
            progress.views_done += 1;
            let url = format!("/v1/executions/{}/images/{view}", self.id);
            record.events.push((
                "view".to_owned(),
                json!({"view": view, "image": url, "views_done": progress.views_done,
                       "views_total": progress.views_total, "time_s": photo.time_s}),
            ));
        });
        stored.map_err(|error| fail(error.to_string()))
    }

    fn cancelled(&self) -> bool {
        self.entry.is_to_stop()
    }
}

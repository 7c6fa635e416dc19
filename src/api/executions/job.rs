//! What a run needs, and the run.

use super::Entry;
use super::recorder::Recorder;
use crate::api::store::ExecutionStore;
use crate::api::wire::ExecutionStateJson;
use crate::geometry::Point;
use crate::imaging::Camera;
use crate::render::Mesh;
use crate::simulate::{Carrier, End, RenderedObject, Run, SimulateError, execute, write_photo_set};

/// A run, ready to go.
pub struct Job {
    /// What carries the camera.
    pub carrier: Carrier,
    /// The object in its place.
    pub mesh: Mesh,
    /// The simulated camera.
    pub camera: Camera,
    /// Opaque background; `None` keeps alpha.
    pub background: Option<[u8; 3]>,
    /// Centre of the object's sphere, which transforms.json centres.
    pub center_in_base: Point,
    /// Its radius, metres.
    pub object_radius_m: f64,
    /// Simulated seconds a second.
    pub speed_factor: f64,
}

impl Job {
    /// Runs on the calling thread to the end; the entry tells how it went.
    pub(super) fn run(self, entry: &Entry, store: &ExecutionStore) {
        if let Some(state) = entry.stopped() {
            entry.advance(store, state, None);
            return;
        }
        if !entry.advance(store, ExecutionStateJson::Running, None) {
            return;
        }
        let (state, error) = match self.carry_out(entry, store) {
            Ok(End::Done) => (ExecutionStateJson::Done, None),
            Ok(End::Cancelled) => (entry.stopped().unwrap_or(ExecutionStateJson::Cancelled), None),
            Err(error) => (ExecutionStateJson::Failed, Some(error.to_string())),
        };
        entry.advance(store, state, error);
    }

    fn carry_out(&self, entry: &Entry, store: &ExecutionStore) -> Result<End, SimulateError> {
        let id = entry.execution().id;
        let object = RenderedObject::new(&self.mesh, self.camera);
        let background = self.background;
        let directory = store.path(&id);
        let mut recorder = Recorder { id, entry, store, background, photos: Vec::new() };
        let run = Run { carrier: &self.carrier, camera: &object, speed_factor: self.speed_factor };
        let end = execute(&run, &mut recorder)?;
        if !recorder.photos.is_empty() {
            write_photo_set(
                &directory,
                &self.camera,
                &recorder.photos,
                &self.center_in_base,
                self.object_radius_m,
            )?;
        }
        Ok(end)
    }
}

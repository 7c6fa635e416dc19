//! What a run needs, and the run.

use super::recorder::Recorder;
use super::{Entry, transforms};
use crate::api::store::ExecutionStore;
use crate::api::wire::ExecutionStateJson;
use crate::files::replace_unsynced;
use crate::imaging::Camera;
use crate::render::Mesh;
use crate::simulate::{Carrier, End, RenderedObject, Run, SimulateError, execute};

/// Why a run is interrupted that the end of the service stops.
const STOPPED: &str =
    "the service was stopped while the arm moved; photos taken so far stay, a new run starts over";

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
    /// Simulated seconds a second.
    pub speed_factor: f64,
}

impl Job {
    /// Runs on the calling thread to the end; the entry tells how it went.
    pub(super) fn run(self, entry: &Entry, store: &ExecutionStore) {
        if !entry.start_moving(store) {
            return;
        }
        // A run that has moved is not taken up again.
        store.forget_request(&entry.execution().id);
        let (state, error) = match self.carry_out(entry, store) {
            Ok(End::Done) => (ExecutionStateJson::Done, None),
            Ok(End::Cancelled) if entry.is_cancelled() => (ExecutionStateJson::Cancelled, None),
            Ok(End::Cancelled) => (ExecutionStateJson::Interrupted, Some(STOPPED.to_owned())),
            Err(error) => (ExecutionStateJson::Failed, Some(error.to_string())),
        };
        entry.advance(store, state, error);
    }

    fn carry_out(&self, entry: &Entry, store: &ExecutionStore) -> Result<End, SimulateError> {
        let id = entry.execution().id;
        let object = RenderedObject::new(&self.mesh, self.camera);
        let path = store.transforms(&id);
        let mut recorder = Recorder { id, entry, store, background: self.background };
        let run = Run { carrier: &self.carrier, camera: &object, speed_factor: self.speed_factor };
        let end = execute(&run, &mut recorder)?;
        let fail = |reason: String| SimulateError::Write { path: path.display().to_string(), reason };
        if let Some(text) = transforms(&entry.record()).map_err(|problem| fail(problem.detail.clone()))? {
            replace_unsynced(&path, text.as_bytes()).map_err(|error| fail(error.to_string()))?;
        }
        Ok(end)
    }
}

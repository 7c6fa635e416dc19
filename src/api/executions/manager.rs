//! All runs.

use std::collections::BTreeMap;
use std::io;
use std::sync::{Arc, PoisonError, RwLock};
use std::time::Duration;

use axum::http::StatusCode;
use serde_json::json;
use tokio::sync::Semaphore;
use tokio::sync::mpsc::{UnboundedSender, unbounded_channel};

use super::Entry;
use super::prepare::Sources;
use super::queue::{Waiting, hand_out_arms};
use crate::api::problem::Problem;
use crate::api::store::{ExecutionRecord, ExecutionStore};
use crate::api::wire::{CreateExecution, ExecutionStateJson};

/// Runs that may wait for an arm.
const LONGEST_QUEUE: usize = 64;
/// Why a run is interrupted whose arm moved when the process ended.
const ENDED: &str = "the service ended while the arm moved; photos taken so far stay, a new run starts over";
/// Why a run is interrupted that waited, and of which the request was not stored.
const NOT_STORED: &str =
    "it waited when the service ended, and its request was not stored; a new run starts over";

/// All runs; cheap to clone.
#[derive(Clone)]
pub struct Executions {
    store: ExecutionStore,
    sources: Sources,
    entries: Arc<RwLock<BTreeMap<String, Arc<Entry>>>>,
    queue: UnboundedSender<Arc<Entry>>,
    arms: Arc<Semaphore>,
    places: Arc<Semaphore>,
}

impl Executions {
    /// Reads the stored runs, within the runtime. Those that waited for an arm wait again, in the order they
    /// were made; those whose arm moved are marked interrupted.
    ///
    /// # Errors
    /// Those of the file system.
    pub fn open(store: ExecutionStore, sources: Sources, arms: usize) -> io::Result<Self> {
        let arms = arms.max(1);
        let (queue, waiting) = unbounded_channel();
        let executions = Self {
            sources: sources.clone(),
            entries: Arc::new(RwLock::new(BTreeMap::new())),
            queue,
            arms: Arc::new(Semaphore::new(arms)),
            places: Arc::new(Semaphore::new(arms + LONGEST_QUEUE)),
            store: store.clone(),
        };
        // Sorted by id, which is the order they were made.
        for record in store.load_all()? {
            executions.take_up(record);
        }
        tokio::spawn(hand_out_arms(waiting, executions.arms.clone(), store, sources));
        Ok(executions)
    }

    /// Takes up a run of an earlier life of the service.
    fn take_up(&self, record: ExecutionRecord) {
        let (id, state) = (record.execution.id.clone(), record.execution.state);
        let waits = state == ExecutionStateJson::Queued && self.store.has_request(&id);
        let waiting =
            waits.then(|| Waiting { job: None, place: self.places.clone().try_acquire_owned().ok() });
        let entry = Arc::new(Entry::new(record, waiting));
        if waits {
            self.enqueue(entry.clone());
        } else {
            let why = if state == ExecutionStateJson::Queued { NOT_STORED } else { ENDED };
            if entry.advance(&self.store, ExecutionStateJson::Interrupted, Some(why.to_owned())) {
                self.store.forget_request(&id);
            }
        }
        self.entries.write().unwrap_or_else(PoisonError::into_inner).insert(id, entry);
    }

    fn enqueue(&self, entry: Arc<Entry>) {
        // Nobody hands out arms any more where the service is stopping: the run waits for its next life.
        let _ = self.queue.send(entry);
    }

    /// The run with this id.
    pub fn get(&self, id: &str) -> Option<Arc<Entry>> {
        self.entries.read().unwrap_or_else(PoisonError::into_inner).get(id).cloned()
    }

    /// All ids, sorted.
    pub fn ids(&self) -> Vec<String> {
        self.entries.read().unwrap_or_else(PoisonError::into_inner).keys().cloned().collect()
    }

    /// Ids of the runs that wait for an arm to follow this plan, sorted.
    pub fn waiting_for_plan(&self, plan_id: &str) -> Vec<String> {
        let entries = self.entries.read().unwrap_or_else(PoisonError::into_inner);
        entries.iter().filter(|(_, entry)| entry.waits_for_plan(plan_id)).map(|(id, _)| id.clone()).collect()
    }

    /// The store.
    pub fn store(&self) -> &ExecutionStore {
        &self.store
    }

    /// Checks and queues a run. Reads and writes files: for threads that may block.
    ///
    /// # Errors
    /// Those of [`Sources::prepare`]; 503 when too many wait; storage problems.
    pub fn start(&self, json: &CreateExecution) -> Result<Arc<Entry>, Problem> {
        let (mut record, job) = self.sources.prepare(json, &self.store.scratch())?;
        let place = self.places.clone().try_acquire_owned().map_err(|_| {
            Problem::unavailable("overloaded", format!("{LONGEST_QUEUE} executions are waiting"), Some(10))
        })?;
        let id = self.store.create()?;
        record.execution.id = id.clone();
        record.events.push(("state".to_owned(), json!({"state": "queued", "error": null})));
        // The request first: a run that is found waiting can be taken up.
        self.store.save_request(&id, json)?;
        self.store.save(&record)?;
        let waiting = Waiting { job: Some(Box::new(job)), place: Some(place) };
        let entry = Arc::new(Entry::new(record, Some(waiting)));
        self.entries.write().unwrap_or_else(PoisonError::into_inner).insert(id, entry.clone());
        self.enqueue(entry.clone());
        Ok(entry)
    }

    /// Asks a run to stop; one that waits ends at once. Writes files: for threads that may block.
    ///
    /// # Errors
    /// 409 when it is over; storage problems.
    pub fn cancel(&self, entry: &Entry) -> Result<(), Problem> {
        if !entry.cancel(&self.store) {
            return Err(conflict("execution_over", entry, "queued or running"));
        }
        let execution = entry.execution();
        if execution.state == ExecutionStateJson::Cancelled {
            self.store.forget_request(&execution.id);
        }
        Ok(())
    }

    /// Deletes a run that is over, and its files; false where there is none. Writes files: for threads that
    /// may block.
    ///
    /// # Errors
    /// 409 when it is not over; storage problems.
    pub fn delete(&self, id: &str) -> Result<bool, Problem> {
        let remains = {
            let mut entries = self.entries.write().unwrap_or_else(PoisonError::into_inner);
            let Some(entry) = entries.get(id) else { return Ok(false) };
            if !entry.is_over() {
                return Err(conflict(
                    "execution_running",
                    entry,
                    "that of a run that is over; cancel it first",
                ));
            }
            let remains = self.store.take_away(id)?;
            entries.remove(id);
            remains
        };
        // Many photos take a while: others need not wait for it.
        std::fs::remove_dir_all(remains)?;
        Ok(true)
    }

    /// Stops every run and waits until they have, at most `patience`. Those that wait for an arm stay
    /// queued, for the next life of the service.
    pub async fn shut_down(&self, patience: Duration) {
        self.arms.close();
        let entries: Vec<Arc<Entry>> =
            self.entries.read().unwrap_or_else(PoisonError::into_inner).values().cloned().collect();
        let deadline = tokio::time::Instant::now() + patience;
        for entry in &entries {
            entry.stop();
        }
        for entry in entries {
            let mut changes = entry.changes();
            let stands = async {
                while entry.is_moving() {
                    if changes.changed().await.is_err() {
                        break;
                    }
                }
            };
            // What does not stop in time is found interrupted at the next start.
            let _ = tokio::time::timeout_at(deadline, stands).await;
        }
    }
}

/// 409: the run's state forbids it.
fn conflict(code: &str, entry: &Entry, bound: &str) -> Problem {
    let state = serde_json::to_value(entry.execution().state).unwrap_or_default();
    Problem::field(code, "state", state, bound).with_status(StatusCode::CONFLICT)
}

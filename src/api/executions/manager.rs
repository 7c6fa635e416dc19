//! All runs.

use std::collections::BTreeMap;
use std::io;
use std::sync::{Arc, PoisonError, RwLock};

use tokio::sync::Semaphore;

use super::entry::{Entry, is_over};
use super::job::Job;
use crate::api::problem::Problem;
use crate::api::store::{ExecutionRecord, ExecutionStore};
use crate::api::wire::ExecutionStateJson;

/// Runs that may wait for an arm.
const LONGEST_QUEUE: usize = 64;

/// All runs; cheap to clone.
#[derive(Clone)]
pub struct Executions {
    store: ExecutionStore,
    entries: Arc<RwLock<BTreeMap<String, Arc<Entry>>>>,
    arms: Arc<Semaphore>,
    places: Arc<Semaphore>,
}

impl Executions {
    /// Reads the stored runs; those that were under way are marked interrupted.
    ///
    /// # Errors
    /// Those of the file system.
    pub fn open(store: ExecutionStore, arms: usize) -> io::Result<Self> {
        let mut entries = BTreeMap::new();
        for record in store.load_all()? {
            let id = record.execution.id.clone();
            let entry = Entry::new(record);
            entry.advance(&store, ExecutionStateJson::Interrupted, None);
            entries.insert(id, Arc::new(entry));
        }
        let arms = arms.max(1);
        Ok(Self {
            store,
            entries: Arc::new(RwLock::new(entries)),
            arms: Arc::new(Semaphore::new(arms)),
            places: Arc::new(Semaphore::new(arms + LONGEST_QUEUE)),
        })
    }

    /// The run with this id.
    pub fn get(&self, id: &str) -> Option<Arc<Entry>> {
        self.entries.read().unwrap_or_else(PoisonError::into_inner).get(id).cloned()
    }

    /// All ids, sorted.
    pub fn ids(&self) -> Vec<String> {
        self.entries.read().unwrap_or_else(PoisonError::into_inner).keys().cloned().collect()
    }

    /// The store.
    pub fn store(&self) -> &ExecutionStore {
        &self.store
    }

    /// Queues a run. `record` gets its id here. Writes files: for threads that may block, within the
    /// runtime.
    ///
    /// # Errors
    /// 503 when too many wait; storage problems.
    pub fn start(&self, mut record: ExecutionRecord, job: Job) -> Result<Arc<Entry>, Problem> {
        let place = self.places.clone().try_acquire_owned().map_err(|_| {
            Problem::unavailable("overloaded", format!("{LONGEST_QUEUE} executions are waiting"), Some(10))
        })?;
        let id = self.store.create()?;
        record.execution.id = id.clone();
        record.events.push(("state".to_owned(), serde_json::json!({"state": "queued", "error": null})));
        self.store.save(&record)?;
        let entry = Arc::new(Entry::new(record));
        self.entries.write().unwrap_or_else(PoisonError::into_inner).insert(id, entry.clone());

        let (arms, store, running) = (self.arms.clone(), self.store.clone(), entry.clone());
        let kept = store.clone();
        tokio::spawn(async move {
            let _place = place;
            let Ok(arm) = arms.acquire_owned().await else { return };
            let for_run = running.clone();
            let ended = tokio::task::spawn_blocking(move || {
                let _arm = arm;
                job.run(&for_run, &store);
            })
            .await;
            if let Err(error) = ended {
                tracing::error!(%error, "a run broke off");
                let text = format!("the run broke off: {error}");
                running.advance(&kept, ExecutionStateJson::Failed, Some(text));
            }
        });
        Ok(entry)
    }

    /// Asks a run to stop; one that waits ends at once. Writes files: for threads that may block.
    ///
    /// # Errors
    /// 409 when it is over; storage problems.
    pub fn cancel(&self, entry: &Entry) -> Result<(), Problem> {
        let execution = entry.execution();
        if is_over(execution.state) {
            let state = serde_json::to_value(execution.state).unwrap_or_default();
            return Err(Problem::field("execution_over", "state", state, "queued or running")
                .with_status(axum::http::StatusCode::CONFLICT));
        }
        entry.cancel();
        if execution.state == ExecutionStateJson::Queued {
            entry.advance(&self.store, ExecutionStateJson::Cancelled, None);
        }
        Ok(())
    }

    /// Stops every run and waits until they have, at most `patience`.
    pub async fn shut_down(&self, patience: std::time::Duration) {
        let entries: Vec<Arc<Entry>> =
            self.entries.read().unwrap_or_else(PoisonError::into_inner).values().cloned().collect();
        let deadline = tokio::time::Instant::now() + patience;
        for entry in &entries {
            entry.stop();
        }
        for entry in entries {
            let mut changes = entry.changes();
            let over = async {
                while !is_over(entry.execution().state) {
                    if changes.changed().await.is_err() {
                        break;
                    }
                }
            };
            // What does not stop in time is found interrupted at the next start.
            let _ = tokio::time::timeout_at(deadline, over).await;
        }
    }
}

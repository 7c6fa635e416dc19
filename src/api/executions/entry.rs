//! One run: its record, and who waits for its changes.

use std::io;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

use serde_json::{Value, json};
use tokio::sync::watch;

use crate::api::store::{ExecutionRecord, ExecutionStore};
use crate::api::wire::{ExecutionJson, ExecutionStateJson};

/// A run.
pub struct Entry {
    record: Mutex<ExecutionRecord>,
    /// Held while a change goes to the store, so that changes come one after the other.
    writing: Mutex<()>,
    changes: watch::Sender<u64>,
    cancelled: AtomicBool,
    stopping: AtomicBool,
}

/// Whether a run is over.
pub fn is_over(state: ExecutionStateJson) -> bool {
    !matches!(state, ExecutionStateJson::Queued | ExecutionStateJson::Running)
}

impl Entry {
    pub(super) fn new(record: ExecutionRecord) -> Self {
        Self {
            record: Mutex::new(record),
            writing: Mutex::new(()),
            changes: watch::Sender::new(0),
            cancelled: AtomicBool::new(false),
            stopping: AtomicBool::new(false),
        }
    }

    /// The run now.
    pub fn execution(&self) -> ExecutionJson {
        self.lock().execution.clone()
    }

    /// The whole record now.
    pub fn record(&self) -> ExecutionRecord {
        self.lock().clone()
    }

    /// The event with this index, and whether the run is over.
    pub fn event(&self, index: usize) -> (Option<(String, Value)>, bool) {
        let record = self.lock();
        (record.events.get(index).cloned(), is_over(record.execution.state))
    }

    /// Tells of changes; the value counts them.
    pub fn changes(&self) -> watch::Receiver<u64> {
        self.changes.subscribe()
    }

    /// Changes the record, in the store first: what a client has seen is not lost.
    ///
    /// # Errors
    /// Those of the store; the record is as it was.
    pub(super) fn update(
        &self,
        store: &ExecutionStore,
        change: impl FnOnce(&mut ExecutionRecord),
    ) -> io::Result<()> {
        let _writing = self.writing.lock().unwrap_or_else(PoisonError::into_inner);
        let mut record = self.record();
        change(&mut record);
        store.save(&record)?;
        *self.lock() = record;
        self.notify();
        Ok(())
    }

    /// Changes what need not be stored: progress between photos.
    pub(super) fn touch(&self, change: impl FnOnce(&mut ExecutionJson)) {
        change(&mut self.lock().execution);
        self.notify();
    }

    /// Goes to `state` unless the run is over; false if it is. A store that fails is logged: the run
    /// is found interrupted after a restart.
    pub(super) fn advance(
        &self,
        store: &ExecutionStore,
        state: ExecutionStateJson,
        error: Option<String>,
    ) -> bool {
        let _writing = self.writing.lock().unwrap_or_else(PoisonError::into_inner);
        let mut record = self.record();
        if is_over(record.execution.state) {
            return false;
        }
        record.execution.state = state;
        record.execution.error.clone_from(&error);
        record.events.push(("state".to_owned(), json!({"state": state, "error": error})));
        if let Err(error) = store.save(&record) {
            tracing::error!(%error, id = %record.execution.id, "a run's record cannot be stored");
        }
        *self.lock() = record;
        self.notify();
        true
    }

    /// Asks the run to stop.
    pub(super) fn cancel(&self) {
        self.cancelled.store(true, Ordering::Relaxed);
    }

    /// Asks the run to stop because the service does.
    pub(super) fn stop(&self) {
        self.stopping.store(true, Ordering::Relaxed);
    }

    /// The state that a stopped run ends in; `None` while it may go on.
    pub(super) fn stopped(&self) -> Option<ExecutionStateJson> {
        if self.cancelled.load(Ordering::Relaxed) {
            Some(ExecutionStateJson::Cancelled)
        } else if self.stopping.load(Ordering::Relaxed) {
            Some(ExecutionStateJson::Interrupted)
        } else {
            None
        }
    }

    fn notify(&self) {
        self.changes.send_modify(|count| *count = count.wrapping_add(1));
    }

    /// A panic elsewhere leaves a record that is still whole: every change is one assignment or push.
    fn lock(&self) -> MutexGuard<'_, ExecutionRecord> {
        self.record.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

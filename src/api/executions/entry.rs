//! One run: its record, and who waits for its changes.

use std::io;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

use serde_json::{Value, json};
use tokio::sync::watch;

use super::queue::Waiting;
use crate::api::store::{ExecutionRecord, ExecutionStore};
use crate::api::wire::{ExecutionJson, ExecutionStateJson};

/// A run.
pub struct Entry {
    record: Mutex<ExecutionRecord>,
    /// What it holds until its turn comes or it is cancelled.
    waiting: Mutex<Option<Waiting>>,
    /// Held while a change goes to the store, so that changes come one after the other.
    writing: Mutex<()>,
    changes: watch::Sender<u64>,
    cancelled: AtomicBool,
    stopping: AtomicBool,
}

fn is_over(state: ExecutionStateJson) -> bool {
    !matches!(state, ExecutionStateJson::Queued | ExecutionStateJson::Running)
}

impl Entry {
    pub(super) fn new(record: ExecutionRecord, waiting: Option<Waiting>) -> Self {
        Self {
            record: Mutex::new(record),
            waiting: Mutex::new(waiting),
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

    /// The event with this index, and whether no more will come: the run is over, or it waits for the
    /// next life of the service.
    pub fn event(&self, index: usize) -> (Option<(String, Value)>, bool) {
        let record = self.lock();
        let state = record.execution.state;
        let waits_on = state == ExecutionStateJson::Queued && self.stopping.load(Ordering::Relaxed);
        (record.events.get(index).cloned(), is_over(state) || waits_on)
    }

    /// Whether the run is over.
    pub fn is_over(&self) -> bool {
        is_over(self.lock().execution.state)
    }

    /// Whether the arm moves.
    pub(super) fn is_moving(&self) -> bool {
        self.lock().execution.state == ExecutionStateJson::Running
    }

    /// Whether it waits for an arm to follow this plan.
    pub(super) fn waits_for_plan(&self, plan_id: &str) -> bool {
        let record = self.lock();
        record.execution.state == ExecutionStateJson::Queued && record.execution.plan_id == plan_id
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
        let _writing = self.writing();
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
    /// is found as it was after a restart.
    pub(super) fn advance(
        &self,
        store: &ExecutionStore,
        state: ExecutionStateJson,
        error: Option<String>,
    ) -> bool {
        let _writing = self.writing();
        let goes_on = !self.is_over();
        if goes_on {
            self.go(store, state, error);
        }
        goes_on
    }

    /// From `queued` to `running`; false where it may not: it was cancelled, or the service ends.
    pub(super) fn start_moving(&self, store: &ExecutionStore) -> bool {
        let _writing = self.writing();
        let starts = self.may_start();
        if starts {
            self.go(store, ExecutionStateJson::Running, None);
        }
        starts
    }

    /// Whether it waits and nothing keeps it from moving.
    pub(super) fn may_start(&self) -> bool {
        self.execution().state == ExecutionStateJson::Queued && !self.is_to_stop()
    }

    /// Asks the run to stop; one that waits ends at once. False when it is over.
    pub(super) fn cancel(&self, store: &ExecutionStore) -> bool {
        let _writing = self.writing();
        let goes_on = !self.is_over();
        if self.execution().state == ExecutionStateJson::Queued {
            self.go(store, ExecutionStateJson::Cancelled, None);
            // Others may wait in its place.
            drop(self.take_waiting());
        } else if goes_on {
            self.cancelled.store(true, Ordering::Relaxed);
        }
        goes_on
    }

    /// What it has held while it waited; `None` for a run that is over, or whose turn has come before.
    pub(super) fn take_waiting(&self) -> Option<Waiting> {
        self.waiting.lock().unwrap_or_else(PoisonError::into_inner).take()
    }

    /// Asks the run to stop because the service does; one that waits never starts in this life of it.
    pub(super) fn stop(&self) {
        let _writing = self.writing();
        self.stopping.store(true, Ordering::Relaxed);
        self.notify();
    }

    /// Whether a client has asked it to stop.
    pub(super) fn is_cancelled(&self) -> bool {
        self.cancelled.load(Ordering::Relaxed)
    }

    /// Whether anybody has.
    pub(super) fn is_to_stop(&self) -> bool {
        self.is_cancelled() || self.stopping.load(Ordering::Relaxed)
    }

    /// Goes to `state`. For those who hold `writing`.
    fn go(&self, store: &ExecutionStore, state: ExecutionStateJson, error: Option<String>) {
        let mut record = self.record();
        record.execution.state = state;
        record.execution.error.clone_from(&error);
        record.events.push(("state".to_owned(), json!({"state": state, "error": error})));
        if let Err(error) = store.save(&record) {
            tracing::error!(%error, id = %record.execution.id, "a run's record cannot be stored");
        }
        *self.lock() = record;
        self.notify();
    }

    fn writing(&self) -> MutexGuard<'_, ()> {
        self.writing.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn notify(&self) {
        self.changes.send_modify(|count| *count = count.wrapping_add(1));
    }

    /// A panic elsewhere leaves a record that is still whole: every change is one assignment or push.
    fn lock(&self) -> MutexGuard<'_, ExecutionRecord> {
        self.record.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

//! Runs that wait for an arm: one after the other, in the order they came.

use std::sync::Arc;

use tokio::sync::mpsc::UnboundedReceiver;
use tokio::sync::{OwnedSemaphorePermit, Semaphore};

use super::prepare::Sources;
use super::{Entry, Job};
use crate::api::problem::Problem;
use crate::api::store::ExecutionStore;
use crate::api::wire::ExecutionStateJson;

/// What a run holds while it waits.
pub(super) struct Waiting {
    /// `None` for a run of an earlier life of the service: made from what is stored when its turn comes.
    pub(super) job: Option<Box<Job>>,
    /// Its place among the runs that are taken on; one that was taken on before has it anyway.
    pub(super) place: Option<OwnedSemaphorePermit>,
}

/// Gives each of `waiting` an arm in turn; ends when `arms` are closed.
pub(super) async fn hand_out_arms(
    mut waiting: UnboundedReceiver<Arc<Entry>>,
    arms: Arc<Semaphore>,
    store: ExecutionStore,
    sources: Sources,
) {
    while let Some(entry) = waiting.recv().await {
        let Ok(arm) = arms.clone().acquire_owned().await else { return };
        let (store, sources) = (store.clone(), sources.clone());
        tokio::spawn(async move {
            // Cancelled while it waited.
            let Some(Waiting { job, place }) = entry.take_waiting() else { return };
            let (running, kept) = (entry.clone(), store.clone());
            let ended = tokio::task::spawn_blocking(move || {
                let _held = (arm, place);
                run(&running, job, &store, &sources);
            });
            if let Err(error) = ended.await {
                tracing::error!(%error, "a run broke off");
                let text = format!("the run broke off: {error}");
                entry.advance(&kept, ExecutionStateJson::Failed, Some(text));
            }
        });
    }
}

fn run(entry: &Entry, job: Option<Box<Job>>, store: &ExecutionStore, sources: &Sources) {
    let id = entry.execution().id;
    // Cancelled just now, or the service is ending.
    if !entry.may_start() {
        return;
    }
    let job = match job {
        Some(job) => Ok(job),
        None => stored_job(&id, store, sources),
    };
    match job {
        Ok(job) => job.run(entry, store),
        Err(problem) => {
            let text =
                format!("it waited when the service ended, and cannot be taken up: {}", problem.detail);
            entry.advance(store, ExecutionStateJson::Interrupted, Some(text));
        }
    }
    if entry.is_over() {
        store.forget_request(&id);
    }
}

/// The job of a run that an earlier life of the service has taken on.
fn stored_job(id: &str, store: &ExecutionStore, sources: &Sources) -> Result<Box<Job>, Problem> {
    let gone = || Problem::internal("its request is not stored");
    let request = store.request(id)?.ok_or_else(gone)?;
    sources.prepare(&request, &store.scratch()).map(|(_, job)| Box::new(job))
}

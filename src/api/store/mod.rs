//! What outlives the process: plans and executions as files below the data directory.
//!
//! ```text
//! plans/<id>.json            the answer, byte for byte
//! plans/<id>.request.json    the canonical request without its images
//! executions/<id>/record.json, images/<view>.png, transforms.json
//! ```
//! Every file is written beside its place and renamed, so that a reader or a crash sees the whole
//! file or none. A plan that was answered and a run that is over are synced to the disk; a run under
//! way is not, since a power cut ends it anyway.

mod atomic_file;
pub(super) mod data_lock;
mod execution_store;
mod plan_store;

pub use atomic_file::{create_once, replace, replace_unsynced, sync_files};
pub use execution_store::{ExecutionRecord, ExecutionStore};
pub use plan_store::PlanStore;

/// True when `id` can be a file's name here: letters, digits and `-`, 1 to 64 of them.
fn is_id(id: &str) -> bool {
    (1..=64).contains(&id.len()) && id.bytes().all(|b| b.is_ascii_alphanumeric() || b == b'-')
}

//! What outlives the process: plans and executions as files below the data directory.
//!
//! ```text
//! plans/<id>.json            the answer, byte for byte
//! plans/<id>.request.json    the canonical request without its images
//! executions/<id>/record.json, images/<view>.png, transforms.json, while it waits request.json
//! ```
//! Every file is whole or absent ([`crate::files`]). A plan that was answered and a run that is over are
//! synced to the disk; a run under way is not, since a power cut ends it anyway.

pub(super) mod data_lock;
mod execution_store;
mod plan_store;

pub use execution_store::{ExecutionRecord, ExecutionStore};
pub use plan_store::PlanStore;

/// True when `id` can be a file's name here: letters, digits and `-`, 1 to 64 of them.
fn is_id(id: &str) -> bool {
    (1..=64).contains(&id.len()) && id.bytes().all(|b| b.is_ascii_alphanumeric() || b == b'-')
}

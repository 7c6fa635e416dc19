//! Runs of the simulated arm: queue, state machine, events, storage.
//!
//! ```text
//! queued -> running -> done | failed
//!    \         \-> cancelled (by request) | interrupted (the service ended)
//!     \-> cancelled | interrupted (it waited when the service ended, and what it needs is gone)
//! ```
//! A run that waits when the service ends waits on in its next life.

mod entry;
mod job;
mod manager;
mod object;
mod prepare;
mod queue;
mod recorder;
mod transforms;

pub use entry::Entry;
pub use job::Job;
pub use manager::Executions;
pub use object::load_object;
pub use prepare::Sources;
pub use transforms::{photo_file, transforms};

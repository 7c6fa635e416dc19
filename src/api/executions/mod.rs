//! Runs of the simulated arm: queue, state machine, events, storage.
//!
//! ```text
//! queued -> running -> done | failed
//!    \         \-> cancelled (by request) | interrupted (the service ended)
//!     \-> cancelled | interrupted
//! ```

mod entry;
mod job;
mod manager;
mod object;
mod prepare;
mod recorder;

pub use entry::Entry;
pub use job::Job;
pub use manager::Executions;
pub use object::load_object;
pub use prepare::prepare;

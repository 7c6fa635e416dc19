//! What the service is told at its start.

use std::net::SocketAddr;
use std::path::PathBuf;
use std::time::Duration;

/// The service's settings.
#[derive(Clone, Debug)]
pub struct ServiceConfig {
    /// Where to listen.
    pub address: SocketAddr,
    /// Where plans and executions are kept.
    pub data_dir: PathBuf,
    /// The directory below which executions may name object files.
    pub objects_dir: Option<PathBuf>,
    /// The prediction model; the shipped one when `None`.
    pub model: Option<PathBuf>,
    /// Heavy requests computed at a time.
    pub workers: usize,
    /// Heavy requests that may wait for a worker.
    pub queue: usize,
    /// Simulated arms that move at a time.
    pub arms: usize,
    /// Longest time for a request that is no stream.
    pub request_timeout: Duration,
    /// Longest time for what is under way when the service stops.
    pub shutdown_timeout: Duration,
}

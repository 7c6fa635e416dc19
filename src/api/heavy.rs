//! Heavy work: off the async threads, bounded, refused when too much of it waits.

use std::sync::Arc;

use tokio::sync::{OwnedSemaphorePermit, Semaphore};

use super::problem::Problem;

/// Seconds after which a refused client may try again.
const RETRY_AFTER_S: u32 = 2;

/// Places for heavy requests: some run, some wait, more are refused.
#[derive(Clone)]
pub struct HeavyWork {
    admitted: Arc<Semaphore>,
    running: Arc<Semaphore>,
}

/// A place among the admitted requests, given back on drop.
pub struct Admission(#[allow(dead_code)] OwnedSemaphorePermit);

impl HeavyWork {
    /// `workers` run at a time, `queue` more wait.
    pub fn new(workers: usize, queue: usize) -> Self {
        let workers = workers.max(1);
        Self {
            admitted: Arc::new(Semaphore::new(workers + queue)),
            running: Arc::new(Semaphore::new(workers)),
        }
    }

    /// A place, taken before the body is read: bodies of waiting requests are what fills memory.
    ///
    /// # Errors
    /// 503 `overloaded` with `Retry-After` when every place is taken.
    pub fn admit(&self) -> Result<Admission, Problem> {
        self.admitted.clone().try_acquire_owned().map(Admission).map_err(|_| {
            Problem::unavailable("overloaded", "too many requests are waiting", Some(RETRY_AFTER_S))
        })
    }

    /// Runs `work` on the blocking pool once a worker is free. The work goes on to its end when the
    /// client leaves, so that its result can be stored.
    ///
    /// # Errors
    /// Those of `work`; 500 when it panicked.
    pub async fn run<T: Send + 'static>(
        &self,
        admission: Admission,
        work: impl FnOnce() -> Result<T, Problem> + Send + 'static,
    ) -> Result<T, Problem> {
        let worker = self
            .running
            .clone()
            .acquire_owned()
            .await
            .map_err(|_| Problem::unavailable("stopping", "the service is stopping", None))?;
        tokio::task::spawn_blocking(move || {
            let _places = (worker, admission);
            work()
        })
        .await
        .map_err(|error| Problem::internal(format!("the computation broke off: {error}")))?
    }
}

//! Heavy work: off the async threads, bounded, refused when too much of it waits.

use std::sync::Arc;
use std::time::Duration;

use tokio::sync::{OwnedSemaphorePermit, Semaphore};

use super::problem::Problem;
use crate::motion::Stop;

/// Seconds after which a refused client may try again.
const RETRY_AFTER_S: u32 = 2;

/// Places for heavy requests: some run, some wait, more are refused.
#[derive(Clone)]
pub struct HeavyWork {
    admitted: Arc<Semaphore>,
    running: Arc<Semaphore>,
}

/// Asks to stop when it is dropped: with the future that waits for the work, done or given up.
struct Awaited(Stop);

impl Drop for Awaited {
    fn drop(&mut self) {
        self.0.ask();
    }
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

    /// Runs `work` as [`HeavyWork::run`] does and asks it to stop when nobody waits for it any more:
    /// the client has left or the request's time is over.
    ///
    /// # Errors
    /// Those of [`HeavyWork::run`].
    pub async fn run_while_awaited<T: Send + 'static>(
        &self,
        admission: Admission,
        work: impl FnOnce(&Stop) -> Result<T, Problem> + Send + 'static,
    ) -> Result<T, Problem> {
        let awaited = Awaited(Stop::default());
        let stop = awaited.0.clone();
        self.run(admission, move || work(&stop)).await
    }

    /// Runs `work` as [`HeavyWork::run`] does and asks it to stop `limit` from now. It goes on when
    /// the client leaves before, so that its result can be stored.
    ///
    /// # Errors
    /// Those of [`HeavyWork::run`].
    pub async fn run_within<T: Send + 'static>(
        &self,
        admission: Admission,
        limit: Duration,
        work: impl FnOnce(&Stop) -> Result<T, Problem> + Send + 'static,
    ) -> Result<T, Problem> {
        let stop = Stop::default();
        let late = stop.clone();
        let clock = tokio::spawn(async move {
            tokio::time::sleep(limit).await;
            late.ask();
        });
        let timed = move || {
            let result = work(&stop);
            clock.abort();
            result
        };
        self.run(admission, timed).await
    }

    /// Runs `work` on the blocking pool once a worker is free. The work goes on to its end when the
    /// client leaves.
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

#[cfg(test)]
mod tests {
    use super::*;

    /// Runs until it is asked to stop, and tells when it was.
    fn endless(told: tokio::sync::oneshot::Sender<()>) -> impl FnOnce(&Stop) -> Result<(), Problem> {
        move |stop| {
            while !stop.is_asked() {
                std::thread::sleep(Duration::from_millis(1));
            }
            told.send(()).ok();
            Ok(())
        }
    }

    #[tokio::test]
    async fn work_that_nobody_awaits_is_asked_to_stop_and_its_place_is_free_again() {
        let heavy = HeavyWork::new(1, 0);
        let (told, heard) = tokio::sync::oneshot::channel();
        let waiting = heavy.run_while_awaited(heavy.admit().unwrap(), endless(told));
        assert!(tokio::time::timeout(Duration::from_millis(50), waiting).await.is_err());
        heard.await.unwrap();
        let next = async {
            loop {
                match heavy.admit() {
                    Ok(admission) => break admission,
                    Err(_) => tokio::time::sleep(Duration::from_millis(1)).await,
                }
            }
        };
        assert_eq!(heavy.run_while_awaited(next.await, |_| Ok(7)).await.unwrap(), 7);
    }

    #[tokio::test]
    async fn work_to_be_stored_goes_on_without_its_client_until_its_time_is_over() {
        let heavy = HeavyWork::new(1, 0);
        let (told, mut heard) = tokio::sync::oneshot::channel();
        let limit = Duration::from_millis(300);
        let waiting = heavy.run_within(heavy.admit().unwrap(), limit, endless(told));
        assert!(tokio::time::timeout(Duration::from_millis(20), waiting).await.is_err());
        assert!(heard.try_recv().is_err(), "the client has left, the work goes on");
        heard.await.unwrap();
    }
}

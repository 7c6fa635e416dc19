//! Threads that share a list of work.

use std::sync::atomic::{AtomicUsize, Ordering};

/// How many threads a flag asks for: 0 stands for one a core.
pub(super) fn threads(asked: usize) -> usize {
    match asked {
        0 => std::thread::available_parallelism().map_or(1, usize::from),
        asked => asked,
    }
}

/// Calls `each` for every piece of `work`, `jobs` at a time, in about their order. A thread whose call fails takes no
/// further work, the others go on.
///
/// # Errors
/// The first failure, once all threads have ended.
pub(super) fn side_by_side<T: Sync>(
    jobs: usize,
    work: &[T],
    each: impl Fn(&T) -> Result<(), String> + Sync,
) -> Result<(), String> {
    let next = AtomicUsize::new(0);
    let worker = || -> Result<(), String> {
        while let Some(piece) = work.get(next.fetch_add(1, Ordering::Relaxed)) {
            each(piece)?;
        }
        Ok(())
    };
    let outcomes: Vec<Result<(), String>> = std::thread::scope(|scope| {
        let workers: Vec<_> = (0..jobs.max(1)).map(|_| scope.spawn(worker)).collect();
        workers
            .into_iter()
            .map(|handle| handle.join().unwrap_or_else(|_| Err("a worker panicked".into())))
            .collect()
    });
    outcomes.into_iter().collect()
}

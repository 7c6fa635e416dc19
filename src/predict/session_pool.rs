//! Several sessions of one model, since a session runs one prediction at a time.

use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};

use ort::session::Session;
use ort::session::builder::GraphOptimizationLevel;

use super::PredictError;
use super::runtime::environment;

/// Sessions that wait to be used.
pub(super) struct SessionPool {
    idle: Mutex<Vec<Session>>,
    returned: Condvar,
}

impl SessionPool {
    /// `pool` sessions of `model`, each with `threads` threads of its own (at least one of both).
    pub(super) fn load(model: &[u8], threads: usize, pool: usize) -> Result<Self, PredictError> {
        let sessions: Result<Vec<_>, _> = (0..pool.max(1)).map(|_| session(model, threads.max(1))).collect();
        Ok(Self { idle: Mutex::new(sessions?), returned: Condvar::new() })
    }

    /// Waits for an idle session, hands it to `work` and takes it back.
    pub(super) fn with<T>(&self, work: impl FnOnce(&mut Session) -> T) -> T {
        let mut idle = self.lock();
        let session = loop {
            match idle.pop() {
                Some(session) => break session,
                None => idle = self.returned.wait(idle).unwrap_or_else(PoisonError::into_inner),
            }
        };
        drop(idle);
        let mut lent = Lent { pool: self, session: Some(session) };
        match lent.session.as_mut() {
            Some(session) => work(session),
            None => unreachable!("a lent session is there until it is dropped"),
        }
    }

    fn lock(&self) -> MutexGuard<'_, Vec<Session>> {
        // A list of idle sessions is whole whatever happened to a thread that held it.
        self.idle.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Gives the session back even when the work panics.
struct Lent<'a> {
    pool: &'a SessionPool,
    session: Option<Session>,
}

impl Drop for Lent<'_> {
    fn drop(&mut self) {
        if let Some(session) = self.session.take() {
            self.pool.lock().push(session);
            self.pool.returned.notify_one();
        }
    }
}

fn session(model: &[u8], threads: usize) -> Result<Session, PredictError> {
    let environment = environment()?;
    let build = || -> ort::Result<Session> {
        Session::builder(environment)?
            .with_optimization_level(GraphOptimizationLevel::All)?
            .with_intra_threads(threads)?
            .with_inter_threads(1)?
            .with_deterministic_compute(true)?
            // Threads that spin between predictions would take the cores of whoever plans.
            .with_intra_op_spinning(false)?
            .commit_from_memory(model)
    };
    build().map_err(|error| PredictError::Session { action: "load", reason: error.to_string() })
}

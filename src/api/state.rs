//! What every handler shares.

use std::fs::File;
use std::io;
use std::sync::Arc;

use super::config::ServiceConfig;
use super::executions::{Executions, Sources};
use super::heavy::HeavyWork;
use super::planner::Planner;
use super::store::{ExecutionStore, PlanStore, data_lock};

/// The service's parts; cheap to clone.
#[derive(Clone)]
pub struct AppState {
    /// Computes plans and predictions.
    pub planner: Arc<Planner>,
    /// Places for heavy requests.
    pub heavy: HeavyWork,
    /// Stored plans.
    pub plans: PlanStore,
    /// Runs.
    pub executions: Executions,
    /// Settings.
    pub config: Arc<ServiceConfig>,
    /// Keeps other services out of the data directory.
    _data_lock: Arc<File>,
}

impl AppState {
    /// Opens the stores and loads the model, within the runtime; says what is missing.
    ///
    /// # Errors
    /// A data directory that cannot be used, or that another service uses; an objects directory that is none.
    pub fn open(config: ServiceConfig) -> io::Result<Self> {
        if let Some(directory) = config.objects_dir.as_ref().filter(|path| !path.is_dir()) {
            let text = format!("the objects directory {} is no directory", directory.display());
            return Err(io::Error::new(io::ErrorKind::NotADirectory, text));
        }
        let data_lock = data_lock::lock(&config.data_dir)?;
        let plans = PlanStore::open(&config.data_dir)?;
        let sources = Sources { plans: plans.clone(), objects_dir: config.objects_dir.clone() };
        let executions = Executions::open(ExecutionStore::open(&config.data_dir)?, sources, config.arms)?;
        let threads = std::thread::available_parallelism().map_or(1, |n| n.get());
        let planner = Planner::load(config.model.as_deref(), threads, config.workers.max(1));
        match planner.missing() {
            Some(cause) => tracing::error!(%cause, "predictions are not available; give view_count instead"),
            None => tracing::info!(model = planner.model_hash(), "the prediction model is ready"),
        }
        Ok(Self {
            planner: Arc::new(planner),
            heavy: HeavyWork::new(config.workers, config.queue),
            plans,
            executions,
            config: Arc::new(config),
            _data_lock: Arc::new(data_lock),
        })
    }
}

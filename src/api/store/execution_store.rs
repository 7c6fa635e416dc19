//! Stored executions.

use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};

use serde::{Deserialize, Serialize};

use super::is_id;
use crate::api::wire::{
    CameraJson, CreateExecution, ExecutionJson, ExecutionStateJson, PoseJson, SphereJson,
};
use crate::files::{replace, replace_unsynced, sync_files};

/// Begins the names of directories for passing files.
const SCRATCH: &str = ".scratch-";
/// Begins the names of deleted runs whose files are still being removed.
const DELETED: &str = ".deleted-";
/// The file with the number of the last run, written when runs are deleted.
const LAST: &str = ".last";

/// All that is known about a run.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct ExecutionRecord {
    /// What `GET /v1/executions/{id}` answers.
    pub execution: ExecutionJson,
    /// The camera of its images.
    pub camera: CameraJson,
    /// The object's sphere in the base frame, metres; records of version 0.4.0 and before may lack it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub object: Option<SphereJson>,
    /// `base_from_camera` of each image, in the order of `execution.images`.
    pub image_poses: Vec<PoseJson>,
    /// Events so far: name and data; the index is the event's id.
    pub events: Vec<(String, serde_json::Value)>,
}

/// Executions as directories.
#[derive(Clone, Debug)]
pub struct ExecutionStore {
    directory: PathBuf,
}

impl ExecutionStore {
    /// Opens (and creates) the directory `executions` below `data`. What a killed service was about to
    /// remove goes.
    ///
    /// # Errors
    /// Those of the file system.
    pub fn open(data: &Path) -> io::Result<Self> {
        let directory = data.join("executions");
        fs::create_dir_all(&directory)?;
        for entry in fs::read_dir(&directory)? {
            let entry = entry?;
            let name = entry.file_name().to_string_lossy().into_owned();
            if name.starts_with(SCRATCH) || name.starts_with(DELETED) {
                fs::remove_dir_all(entry.path())?;
            }
        }
        Ok(Self { directory })
    }

    /// Takes a new id: runs are numbered, and a number is never used again.
    ///
    /// # Errors
    /// Those of the file system.
    pub fn create(&self) -> io::Result<String> {
        let mut number = self.last_number()?;
        loop {
            number += 1;
            let id = format!("run-{number:06}");
            match fs::create_dir(self.path(&id)) {
                Ok(()) => {
                    fs::create_dir_all(self.images(&id))?;
                    return Ok(id);
                }
                Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
                Err(error) => return Err(error),
            }
        }
    }

    /// Moves a run's files out of the way, at once; whoever calls removes the directory that is returned.
    ///
    /// # Errors
    /// Those of the file system.
    pub fn take_away(&self, id: &str) -> io::Result<PathBuf> {
        replace(&self.directory.join(LAST), self.last_number()?.to_string().as_bytes())?;
        let remains = self.directory.join(format!("{DELETED}{id}"));
        fs::rename(self.path(id), &remains)?;
        File::open(&self.directory)?.sync_all()?;
        Ok(remains)
    }

    /// Keeps what a run was asked for, while it waits: it is synced with the record.
    ///
    /// # Errors
    /// Those of the file system.
    pub fn save_request(&self, id: &str, request: &CreateExecution) -> io::Result<()> {
        let bytes = serde_json::to_vec(request).map_err(io::Error::other)?;
        replace_unsynced(&self.request_path(id), &bytes)
    }

    /// Whether the request of a run is kept.
    pub fn has_request(&self, id: &str) -> bool {
        self.request_path(id).is_file()
    }

    /// The request of a run, if it is kept.
    ///
    /// # Errors
    /// Those of the file system; a file that is no request.
    pub fn request(&self, id: &str) -> io::Result<Option<CreateExecution>> {
        match fs::read(self.request_path(id)) {
            Ok(bytes) => serde_json::from_slice(&bytes).map(Some).map_err(io::Error::other),
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
            Err(error) => Err(error),
        }
    }

    /// Removes the request of a run that no longer waits; it may hold a whole mesh.
    pub fn forget_request(&self, id: &str) {
        match fs::remove_file(self.request_path(id)) {
            Err(error) if error.kind() != io::ErrorKind::NotFound => {
                tracing::warn!(%id, %error, "a run's request cannot be removed");
            }
            _ => {}
        }
    }

    /// Writes the record; syncs it with all the run's files unless the run is under way.
    ///
    /// # Errors
    /// Those of the file system.
    pub fn save(&self, record: &ExecutionRecord) -> io::Result<()> {
        let bytes = serde_json::to_vec(record).map_err(io::Error::other)?;
        let id = &record.execution.id;
        let path = self.path(id).join("record.json");
        if record.execution.state == ExecutionStateJson::Running {
            return replace_unsynced(&path, &bytes);
        }
        sync_files(&self.images(id))?;
        sync_files(&self.path(id))?;
        replace(&path, &bytes)
    }

    /// Every record that can be read, sorted by id; a run without one is left alone.
    ///
    /// # Errors
    /// Those of the file system.
    pub fn load_all(&self) -> io::Result<Vec<ExecutionRecord>> {
        let mut records = Vec::new();
        for id in self.ids()? {
            match fs::read(self.path(&id).join("record.json")).map(|bytes| serde_json::from_slice(&bytes)) {
                Ok(Ok(record)) => records.push(record),
                Ok(Err(error)) => tracing::warn!(%id, %error, "an execution's record cannot be read"),
                Err(error) => tracing::warn!(%id, %error, "an execution has no record"),
            }
        }
        Ok(records)
    }

    /// The run's directory.
    pub fn path(&self, id: &str) -> PathBuf {
        self.directory.join(id)
    }

    /// The directory of its images.
    pub fn images(&self, id: &str) -> PathBuf {
        self.path(id).join("images")
    }

    /// Its `transforms.json`, once the run has ended.
    pub fn transforms(&self, id: &str) -> PathBuf {
        self.path(id).join("transforms.json")
    }

    fn request_path(&self, id: &str) -> PathBuf {
        self.path(id).join("request.json")
    }

    /// A directory name that nobody else uses, for passing files.
    pub fn scratch(&self) -> PathBuf {
        static COUNTER: AtomicU64 = AtomicU64::new(0);
        let number = COUNTER.fetch_add(1, Ordering::Relaxed);
        self.directory.join(format!("{SCRATCH}{}-{number}", std::process::id()))
    }

    /// The number of the last run, deleted ones included.
    fn last_number(&self) -> io::Result<u64> {
        let kept = match fs::read_to_string(self.directory.join(LAST)) {
            Ok(text) => text.trim().parse().unwrap_or(0),
            Err(error) if error.kind() == io::ErrorKind::NotFound => 0,
            Err(error) => return Err(error),
        };
        let ids = self.ids()?;
        let numbers = ids.iter().filter_map(|id| id.strip_prefix("run-")?.parse::<u64>().ok());
        Ok(numbers.fold(kept, u64::max))
    }

    fn ids(&self) -> io::Result<Vec<String>> {
        let mut ids = Vec::new();
        for entry in fs::read_dir(&self.directory)? {
            let name = entry?.file_name().to_string_lossy().into_owned();
            if is_id(&name) {
                ids.push(name);
            }
        }
        ids.sort();
        Ok(ids)
    }
}

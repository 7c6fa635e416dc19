//! Stored plans.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Arc, PoisonError, RwLock};

use super::is_id;
use crate::files::{create_once, remove, replace};

/// Plans as files.
#[derive(Clone, Debug)]
pub struct PlanStore {
    directory: PathBuf,
    /// Keeps a plan's two files together: deleting one must not meet storing it again.
    deleting: Arc<RwLock<()>>,
}

impl PlanStore {
    /// Opens (and creates) the directory `plans` below `data`.
    ///
    /// # Errors
    /// Those of the file system.
    pub fn open(data: &Path) -> io::Result<Self> {
        let directory = data.join("plans");
        fs::create_dir_all(&directory)?;
        Ok(Self { directory, deleting: Arc::default() })
    }

    /// Stores an answer and its request unless the id is known; returns the stored answer and
    /// whether it is new.
    ///
    /// # Errors
    /// Those of the file system.
    pub fn put(&self, id: &str, answer: Vec<u8>, request: &[u8]) -> io::Result<(Vec<u8>, bool)> {
        let _kept = self.deleting.read().unwrap_or_else(PoisonError::into_inner);
        // The request first: a plan that can be read can be executed.
        replace(&self.directory.join(format!("{id}.request.json")), request)?;
        create_once(&self.directory.join(format!("{id}.json")), answer)
    }

    /// Deletes a plan; false where there is none.
    ///
    /// # Errors
    /// Those of the file system.
    pub fn delete(&self, id: &str) -> io::Result<bool> {
        if !is_id(id) {
            return Ok(false);
        }
        let _alone = self.deleting.write().unwrap_or_else(PoisonError::into_inner);
        let found = remove(&self.directory.join(format!("{id}.json")))?;
        remove(&self.directory.join(format!("{id}.request.json")))?;
        Ok(found)
    }

    /// The answer with this id.
    ///
    /// # Errors
    /// Those of the file system.
    pub fn answer(&self, id: &str) -> io::Result<Option<Vec<u8>>> {
        self.read(id, "json")
    }

    /// The request of the plan with this id.
    ///
    /// # Errors
    /// Those of the file system.
    pub fn request(&self, id: &str) -> io::Result<Option<Vec<u8>>> {
        self.read(id, "request.json")
    }

    /// Ids of all plans, sorted.
    ///
    /// # Errors
    /// Those of the file system.
    pub fn ids(&self) -> io::Result<Vec<String>> {
        let mut ids = Vec::new();
        for entry in fs::read_dir(&self.directory)? {
            let name = entry?.file_name().to_string_lossy().into_owned();
            if let Some(id) = name.strip_suffix(".json").filter(|id| is_id(id)) {
                ids.push(id.to_owned());
            }
        }
        ids.sort();
        Ok(ids)
    }

    fn read(&self, id: &str, extension: &str) -> io::Result<Option<Vec<u8>>> {
        if !is_id(id) {
            return Ok(None);
        }
        match fs::read(self.directory.join(format!("{id}.{extension}"))) {
            Ok(bytes) => Ok(Some(bytes)),
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
            Err(error) => Err(error),
        }
    }
}

//! Zip archives: Sweet Home 3D's furniture libraries (.sh3f).

use std::fs::File;
use std::io::BufReader;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use zip::ZipArchive;
use zip::result::ZipError;

use super::{MeshError, read_bounded};

/// An open archive.
pub struct Archive {
    path: PathBuf,
    names: Vec<String>,
    zip: Mutex<ZipArchive<BufReader<File>>>,
}

impl Archive {
    /// Opens an archive and reads its list of entries.
    ///
    /// # Errors
    /// [`MeshError::Unreadable`] or [`MeshError::Archive`].
    pub fn open(path: &Path) -> Result<Archive, MeshError> {
        let file =
            File::open(path).map_err(|source| MeshError::Unreadable { path: path.to_owned(), source })?;
        let zip = ZipArchive::new(BufReader::new(file))
            .map_err(|e| MeshError::Archive { path: path.to_owned(), reason: e.to_string() })?;
        let mut names: Vec<String> = zip.file_names().map(str::to_owned).collect();
        names.sort();
        Ok(Archive { path: path.to_owned(), names, zip: Mutex::new(zip) })
    }

    /// The archive's file.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// All entries, sorted.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// Unpacks an entry into memory.
    ///
    /// # Errors
    /// [`MeshError::NoEntry`], [`MeshError::TooLarge`] or [`MeshError::Archive`].
    pub fn read(&self, entry: &str) -> Result<Vec<u8>, MeshError> {
        let broken = |reason: String| MeshError::Archive { path: self.path.clone(), reason };
        let mut zip = self.zip.lock().unwrap_or_else(PoisonError::into_inner);
        let file = zip.by_name(entry).map_err(|e| match e {
            ZipError::FileNotFound => MeshError::NoEntry { path: self.path.clone(), entry: entry.to_owned() },
            other => broken(other.to_string()),
        })?;
        read_bounded(file, entry).map_err(|e| broken(e.to_string()))?
    }
}

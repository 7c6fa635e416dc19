//! One service a data directory.

use std::fs::{File, OpenOptions, TryLockError};
use std::io;
use std::path::Path;

/// Takes the directory (made if it is not there) for this service, until the file is dropped or the process ends.
///
/// A second service would mark the first one's runs as interrupted.
///
/// # Errors
/// `AddrInUse` when another service has it; those of the file system. A file system without locks is used without one.
pub fn lock(data_dir: &Path) -> io::Result<File> {
    std::fs::create_dir_all(data_dir)?;
    let path = data_dir.join("service.lock");
    let file = OpenOptions::new().write(true).create(true).truncate(false).open(&path)?;
    match file.try_lock() {
        Ok(()) => {}
        Err(TryLockError::WouldBlock) => {
            let text = format!("another service uses {} ({} is locked)", data_dir.display(), path.display());
            return Err(io::Error::new(io::ErrorKind::AddrInUse, text));
        }
        Err(TryLockError::Error(error)) => {
            tracing::warn!(%error, "no lock on the data directory: see that no other service uses it");
        }
    }
    Ok(file)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_directory_has_one_service_until_that_ends() {
        let dir = tempfile::tempdir().unwrap();
        let data = dir.path().join("new");
        let first = lock(&data).unwrap();
        let refused = lock(&data).unwrap_err();
        assert_eq!(refused.kind(), io::ErrorKind::AddrInUse);
        assert!(refused.to_string().contains("another service"), "{refused}");
        drop(first);
        assert!(lock(&data).is_ok());
    }
}

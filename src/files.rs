//! Files that are whole or absent: written beside their place and renamed, so that a reader or a crash sees the
//! old file, the new one or none, never a part.

use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};

static COUNTER: AtomicU64 = AtomicU64::new(0);

/// A file beside its place; gone on drop unless it was moved there.
struct Beside {
    path: PathBuf,
    file: File,
}

impl Beside {
    fn write(place: &Path, bytes: &[u8]) -> io::Result<Self> {
        let name = place.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default();
        let number = COUNTER.fetch_add(1, Ordering::Relaxed);
        let path = place.with_file_name(format!(".{name}.{}.{number}", std::process::id()));
        let mut beside = Self { file: File::create(&path)?, path };
        beside.file.write_all(bytes)?;
        Ok(beside)
    }
}

impl Drop for Beside {
    fn drop(&mut self) {
        // After a rename there is nothing of this name.
        let _ = fs::remove_file(&self.path);
    }
}

/// A rename is durable once its directory is synced.
fn sync_directory(path: &Path) -> io::Result<()> {
    match path.parent() {
        // A bare name stands in the working directory.
        Some(directory) if directory.as_os_str().is_empty() => File::open(".")?.sync_all(),
        Some(directory) => File::open(directory)?.sync_all(),
        None => Ok(()),
    }
}

/// Puts `bytes` at `path`, whatever was there, safe from a power cut on return.
///
/// # Errors
/// Those of the file system.
pub fn replace(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let beside = Beside::write(path, bytes)?;
    beside.file.sync_all()?;
    fs::rename(&beside.path, path)?;
    sync_directory(path)
}

/// As [`replace`], safe from the end of the process only: a sync takes up to a second on a busy disk.
///
/// # Errors
/// Those of the file system.
pub fn replace_unsynced(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let beside = Beside::write(path, bytes)?;
    fs::rename(&beside.path, path)
}

/// Removes the file at `path`, safe from a power cut on return; false where there is none.
///
/// # Errors
/// Those of the file system.
pub fn remove(path: &Path) -> io::Result<bool> {
    match fs::remove_file(path) {
        Ok(()) => sync_directory(path).map(|()| true),
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(false),
        Err(error) => Err(error),
    }
}

/// Makes every file of `directory` safe from a power cut.
///
/// # Errors
/// Those of the file system.
pub fn sync_files(directory: &Path) -> io::Result<()> {
    for entry in fs::read_dir(directory)? {
        let path = entry?.path();
        if path.is_file() {
            File::open(path)?.sync_all()?;
        }
    }
    File::open(directory)?.sync_all()
}

/// Puts `bytes` at `path` unless a file is there; returns what is there afterwards and whether it
/// is new. Of several writers at a time, one wins and all return its bytes.
///
/// # Errors
/// Those of the file system.
pub fn create_once(path: &Path, bytes: Vec<u8>) -> io::Result<(Vec<u8>, bool)> {
    let beside = Beside::write(path, &bytes)?;
    beside.file.sync_all()?;
    match fs::hard_link(&beside.path, path) {
        Ok(()) => {
            sync_directory(path)?;
            Ok((bytes, true))
        }
        Err(error) if error.kind() == io::ErrorKind::AlreadyExists => Ok((fs::read(path)?, false)),
        Err(error) => Err(error),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_writer_wins_and_every_writer_sees_its_bytes() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("a.json");
        let seen: Vec<Vec<u8>> = std::thread::scope(|scope| {
            let threads: Vec<_> = (0..8u8)
                .map(|i| {
                    let path = &path;
                    scope.spawn(move || create_once(path, vec![i; 1000]).unwrap().0)
                })
                .collect();
            threads.into_iter().map(|t| t.join().unwrap()).collect()
        });
        assert!(seen.iter().all(|bytes| *bytes == seen[0]));
        assert_eq!(fs::read_dir(directory.path()).unwrap().count(), 1);
    }

    #[test]
    fn what_cannot_be_put_in_its_place_leaves_nothing_beside_it() {
        let directory = tempfile::tempdir().unwrap();
        let place = directory.path().join("taken");
        fs::create_dir(&place).unwrap();
        assert!(replace(&place, b"x").is_err());
        assert!(replace_unsynced(&place, b"x").is_err());
        assert_eq!(fs::read_dir(directory.path()).unwrap().count(), 1);
        replace(&directory.path().join("free"), b"x").unwrap();
        assert_eq!(fs::read_dir(directory.path()).unwrap().count(), 2);
    }
}

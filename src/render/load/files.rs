//! Files that lie beside a model, in a folder or in an archive.

use std::path::{Component, Path, PathBuf};

use super::archive::Archive;
use super::read_file;

/// Where a model's material files, textures and buffers come from.
pub(crate) trait Files {
    /// The bytes of a file named in the model, or why there are none.
    fn read(&self, name: &str) -> Result<Vec<u8>, String>;
    /// True when [`Self::read`] would find the file.
    fn has(&self, name: &str) -> bool;
}

/// Turns a name as models have them (backslashes, `./`, drive letters) into path parts;
/// nothing that leads out of the model's folder survives.
fn parts(name: &str) -> Vec<String> {
    let name = name.trim().replace('\\', "/");
    Path::new(&name)
        .components()
        .filter_map(|c| match c {
            Component::Normal(part) => part.to_str().map(str::to_owned),
            _ => None,
        })
        .collect()
}

/// A folder on disk.
pub(crate) struct Folder {
    path: PathBuf,
}

impl Folder {
    /// The folder that `file` lies in.
    pub(crate) fn beside(file: &Path) -> Self {
        Self { path: file.parent().unwrap_or(Path::new("")).to_owned() }
    }

    /// The file of that name, or of its last part, whatever the case of its letters.
    fn find(&self, name: &str) -> Option<PathBuf> {
        let parts = parts(name);
        let whole: PathBuf = parts.iter().collect();
        let last = parts.last()?;
        let here = if self.path.as_os_str().is_empty() { Path::new(".") } else { &self.path };
        [here.join(whole), here.join(last)].into_iter().find(|p| p.is_file()).or_else(|| {
            let mut same: Vec<PathBuf> = std::fs::read_dir(here)
                .ok()?
                .filter_map(|e| e.ok().map(|e| e.path()))
                .filter(|p| p.file_name().is_some_and(|f| f.eq_ignore_ascii_case(last.as_str())))
                .collect();
            same.sort();
            same.into_iter().find(|p| p.is_file())
        })
    }
}

impl Files for Folder {
    fn read(&self, name: &str) -> Result<Vec<u8>, String> {
        let path = self.find(name).ok_or("no such file")?;
        read_file(&path).map_err(|e| e.to_string())
    }

    fn has(&self, name: &str) -> bool {
        self.find(name).is_some()
    }
}

/// A folder within an archive.
pub(crate) struct ArchiveFolder<'a> {
    archive: &'a Archive,
    folder: String,
}

impl Archive {
    /// The folder that `entry` lies in.
    pub(crate) fn beside(&self, entry: &str) -> ArchiveFolder<'_> {
        let folder = entry.rsplit_once('/').map_or(String::new(), |(folder, _)| format!("{folder}/"));
        ArchiveFolder { archive: self, folder }
    }
}

impl ArchiveFolder<'_> {
    fn find(&self, name: &str) -> Option<&str> {
        let parts = parts(name);
        let whole = format!("{}{}", self.folder, parts.join("/"));
        let last = format!("{}{}", self.folder, parts.last()?);
        let same = |wanted: &str| self.archive.names().iter().find(|n| n.as_str() == wanted);
        let alike = || self.archive.names().iter().find(|n| n.eq_ignore_ascii_case(&last));
        same(&whole).or_else(|| same(&last)).or_else(alike).map(String::as_str)
    }
}

impl Files for ArchiveFolder<'_> {
    fn read(&self, name: &str) -> Result<Vec<u8>, String> {
        let entry = self.find(name).ok_or("no such entry")?;
        self.archive.read(entry).map_err(|e| e.to_string())
    }

    fn has(&self, name: &str) -> bool {
        self.find(name).is_some()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_texture_is_found_by_its_last_part_and_never_outside_the_folder() {
        let outer = tempfile::tempdir().unwrap();
        let inner = outer.path().join("model");
        std::fs::create_dir(&inner).unwrap();
        std::fs::write(outer.path().join("secret.png"), b"x").unwrap();
        std::fs::write(inner.join("Wood.PNG"), b"y").unwrap();
        let folder = Folder::beside(&inner.join("model.obj"));
        for name in ["Wood.PNG", "C:\\textures\\wood.png", "/home/someone/wood.png", "./maps/WOOD.png"] {
            assert_eq!(folder.read(name).as_deref(), Ok(&b"y"[..]), "{name}");
        }
        assert!(!folder.has("../secret.png"));
    }
}

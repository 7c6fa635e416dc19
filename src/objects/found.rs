//! Objects on disk: which there are and which are worth labelling.

use std::path::{Path, PathBuf};

use rayon::prelude::*;

use super::entry::{ObjectEntry, Source};
use super::selection::file;
use crate::render::load::archive::Archive;
use crate::render::load::furniture::{self, FurnitureItem};
use crate::render::load::{Folder, ObjSummary, extension, read_file, scan_obj};
use crate::render::{Mesh, MeshError};

/// The fewest triangles of a usable object.
const MIN_TRIANGLES: usize = 100;
/// The fewest colours of a usable object without texture.
const MIN_COLOURS: usize = 3;
/// The furniture category for people.
const PEOPLE: &str = "Characters";

/// Why an object is not used for labels.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Unusable {
    /// A person: not an object a robot would scan, and the libraries have the same few again and again.
    #[error("is a person")]
    Person,
    /// Doors, windows and staircases belong to a building.
    #[error("is a door, a window or a staircase")]
    PartOfABuilding,
    /// Too simple.
    #[error("has {triangles} triangles, at least {MIN_TRIANGLES} are needed")]
    FewTriangles {
        /// Triangles it has.
        triangles: usize,
    },
    /// Nothing on its surface that a NeRF could learn.
    #[error("has no texture and {colours} colours, a texture or {MIN_COLOURS} colours are needed")]
    Plain {
        /// Colours it has.
        colours: usize,
    },
    /// It cannot be read.
    #[error("cannot be read: {0}")]
    Unreadable(String),
}

/// The usable objects below a folder, or in one file, sorted by key: .obj, .gltf and .glb files and the
/// models of .sh3f libraries that have at least 100 triangles and a texture or three colours and are
/// neither people nor doors, windows or staircases.
///
/// # Errors
/// [`MeshError`] when the folder or a library cannot be read; a model that cannot is left out.
pub fn find_objects(dir: impl AsRef<Path>) -> Result<Vec<ObjectEntry>, MeshError> {
    let looked = look_at_objects(dir)?;
    Ok(looked.into_iter().filter_map(|(entry, verdict)| verdict.is_ok().then_some(entry)).collect())
}

/// An object, and why it cannot be used if it cannot.
pub type LookedAt = (ObjectEntry, Result<(), Unusable>);

/// All objects below a folder, or in one file, with the reason for each that is not usable; sorted by key.
///
/// # Errors
/// As [`find_objects`].
pub fn look_at_objects(dir: impl AsRef<Path>) -> Result<Vec<LookedAt>, MeshError> {
    let dir = dir.as_ref();
    let mut files = Vec::new();
    walk(dir, &mut files)?;
    files.sort();
    let mut found = Vec::new();
    for path in files {
        if extension(&path) == "sh3f" {
            found.extend(in_library(&path)?);
        } else {
            found.push(plain_file(dir, path));
        }
    }
    found.sort_by(|(a, _), (b, _)| a.key.cmp(&b.key).then_with(|| a.address().cmp(&b.address())));
    Ok(found)
}

fn walk(path: &Path, files: &mut Vec<PathBuf>) -> Result<(), MeshError> {
    let unreadable = |source| MeshError::Unreadable { path: path.to_owned(), source };
    if path.metadata().map_err(unreadable)?.is_file() {
        if ["obj", "gltf", "glb", "sh3f"].contains(&extension(path).as_str()) {
            files.push(path.to_owned());
        }
        return Ok(());
    }
    for entry in std::fs::read_dir(path).map_err(unreadable)? {
        let entry = entry.map_err(unreadable)?;
        // A link to a folder could lead in a circle; links to files are followed.
        let linked = entry.file_type().map_err(unreadable)?.is_symlink();
        if !linked || entry.path().is_file() {
            walk(&entry.path(), files)?;
        }
    }
    Ok(())
}

fn plain_file(dir: &Path, path: PathBuf) -> (ObjectEntry, Result<(), Unusable>) {
    let below = path.strip_prefix(dir).ok().filter(|p| !p.as_os_str().is_empty()).unwrap_or(&path);
    let mut entry = file(&path.to_string_lossy());
    entry.key = below.to_string_lossy().replace('\\', "/");
    let verdict = if extension(&path) == "obj" {
        let folder = Folder::beside(&path);
        read_file(&path).map(|bytes| scan_obj(&bytes, &folder))
    } else {
        Mesh::load(&path).map(|mesh| ObjSummary {
            triangles: mesh.triangles.len(),
            textured: usize::from(mesh.has_texture()),
            colours: mesh.plain_colours(),
        })
    };
    let verdict = verdict.map_err(|e| Unusable::Unreadable(e.to_string())).and_then(judge);
    (entry, verdict)
}

fn in_library(path: &Path) -> Result<Vec<LookedAt>, MeshError> {
    let archive = Archive::open(path)?;
    let items = furniture::catalogue(&archive)?;
    // Each thread opens the library for itself: an open one serves a single reader at a time.
    let look = |reader: &mut Result<Archive, MeshError>, item: &FurnitureItem| {
        let verdict = match reader {
            _ if item.category == PEOPLE => Err(Unusable::Person),
            _ if item.opening => Err(Unusable::PartOfABuilding),
            Err(e) => Err(Unusable::Unreadable(e.to_string())),
            Ok(archive) => archive
                .read(&item.model)
                .map_err(|e| Unusable::Unreadable(e.to_string()))
                .and_then(|bytes| judge(scan_obj(&bytes, &archive.beside(&item.model)))),
        };
        (entry_of(path, item), verdict)
    };
    Ok(items.par_iter().map_init(|| Archive::open(path), look).collect())
}

fn entry_of(library: &Path, item: &FurnitureItem) -> ObjectEntry {
    let stem = library.file_stem().map_or_else(Default::default, |s| s.to_string_lossy().into_owned());
    let model = item.model.rsplit_once('.').map_or(item.model.as_str(), |(before, _)| before);
    ObjectEntry {
        key: format!("{stem}/{model}"),
        name: item.name.clone(),
        category: item.category.clone(),
        licence: item.licence.clone(),
        creator: item.creator.clone(),
        source: Source::Library { path: library.to_owned(), entry: item.model.clone() },
        texture: None,
    }
}

fn judge(summary: ObjSummary) -> Result<(), Unusable> {
    let ObjSummary { triangles, textured, colours } = summary;
    if triangles < MIN_TRIANGLES {
        Err(Unusable::FewTriangles { triangles })
    } else if textured == 0 && colours < MIN_COLOURS {
        Err(Unusable::Plain { colours })
    } else {
        Ok(())
    }
}

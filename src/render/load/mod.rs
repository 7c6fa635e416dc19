//! Loaders. Each returns a z-up [`Mesh`] in the file's own unit, problems that are not
//! fatal in [`Mesh::warnings`].

pub mod archive;
mod files;
pub mod furniture;
mod gltf;
mod obj;
mod obj_scan;
mod text;

use std::io::Read;
use std::path::{Path, PathBuf};

use super::Mesh;
use archive::Archive;
pub(crate) use files::Folder;
pub(crate) use obj_scan::{ObjSummary, scan_obj};

/// The most bytes of one file or archive entry.
pub const MAX_FILE_BYTES: u64 = 512 << 20;

/// Why a mesh cannot be loaded.
#[derive(Debug, thiserror::Error)]
pub enum MeshError {
    /// The file or folder cannot be read.
    #[error("cannot read {path}")]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// The file or archive entry is larger than allowed.
    #[error("{name} has more than {max_bytes} bytes")]
    TooLarge {
        /// File or entry.
        name: String,
        /// The bound, [`MAX_FILE_BYTES`].
        max_bytes: u64,
    },
    /// The name's ending is none we know.
    #[error("{path}: meshes end in .obj, .gltf, .glb or .sh3f#entry.obj")]
    UnknownFormat {
        /// The file.
        path: PathBuf,
    },
    /// The archive is broken.
    #[error("{path} is not a readable archive: {reason}")]
    Archive {
        /// The archive.
        path: PathBuf,
        /// Why.
        reason: String,
    },
    /// The archive has no such entry.
    #[error("{path} has no entry {entry}")]
    NoEntry {
        /// The archive.
        path: PathBuf,
        /// The entry asked for.
        entry: String,
    },
    /// The content is not what its name says.
    #[error("{name} cannot be understood: {reason}")]
    Broken {
        /// File or entry.
        name: String,
        /// Why.
        reason: String,
    },
    /// There is nothing to draw in it.
    #[error("{name} has no triangles")]
    NoTriangles {
        /// File or entry.
        name: String,
    },
}

impl Mesh {
    /// Loads OBJ (with its MTL and textures beside it), glTF (.gltf, .glb) or one model of a
    /// Sweet Home 3D library, written `library.sh3f#folder/model.obj`.
    ///
    /// The result is z up: OBJ and glTF files are taken to be y up with the front towards
    /// +z, so a file's (x, y, z) becomes (x, -z, y). A library's model is turned and stretched
    /// as its catalogue says, and is in metres; other files keep their unit.
    ///
    /// # Errors
    /// [`MeshError`]; a missing texture or material file is a warning in the mesh instead.
    pub fn load(path: impl AsRef<Path>) -> Result<Mesh, MeshError> {
        let path = path.as_ref();
        if let Some((library, entry)) = path.to_str().and_then(split_address) {
            return Self::load_entry(library, entry);
        }
        let folder = Folder::beside(path);
        let name = path.display().to_string();
        let mesh = match extension(path).as_str() {
            "obj" => obj::load(&name, &read_file(path)?, &folder)?,
            "gltf" | "glb" => gltf::load(&name, &read_file(path)?, &folder)?,
            _ => return Err(MeshError::UnknownFormat { path: path.to_owned() }),
        };
        finish(mesh, name)
    }

    /// Loads a model of a Sweet Home 3D library: [`Self::load`] with the two parts apart.
    ///
    /// # Errors
    /// [`MeshError`].
    pub fn load_entry(library: impl AsRef<Path>, entry: &str) -> Result<Mesh, MeshError> {
        let library = library.as_ref();
        let archive = Archive::open(library)?;
        let bytes = archive.read(entry)?;
        let name = format!("{}#{entry}", library.display());
        let mut mesh = obj::load_y_up(&name, &bytes, &archive.beside(entry))?;
        if let Ok(catalogue) = furniture::catalogue(&archive)
            && let Some(item) = catalogue.iter().find(|item| item.model == entry)
        {
            item.place(&mut mesh);
        }
        mesh.turn_y_up_to_z_up();
        finish(mesh, name)
    }
}

fn finish(mut mesh: Mesh, name: String) -> Result<Mesh, MeshError> {
    mesh.repair();
    if mesh.triangles.is_empty() { Err(MeshError::NoTriangles { name }) } else { Ok(mesh) }
}

/// Parts of `library.sh3f#entry`.
pub(crate) fn split_address(address: &str) -> Option<(&str, &str)> {
    let (library, entry) = address.rsplit_once('#')?;
    library.to_ascii_lowercase().ends_with(".sh3f").then_some((library, entry))
}

/// A name's ending in small letters.
pub(crate) fn extension(path: &Path) -> String {
    path.extension().and_then(|e| e.to_str()).unwrap_or_default().to_ascii_lowercase()
}

/// Reads a file of at most [`MAX_FILE_BYTES`].
pub(crate) fn read_file(path: &Path) -> Result<Vec<u8>, MeshError> {
    let unreadable = |source| MeshError::Unreadable { path: path.to_owned(), source };
    let file = std::fs::File::open(path).map_err(unreadable)?;
    read_bounded(file, &path.display().to_string()).unwrap_or_else(|e| Err(unreadable(e)))
}

/// Reads to the end, or to the bound.
fn read_bounded(from: impl Read, name: &str) -> std::io::Result<Result<Vec<u8>, MeshError>> {
    let mut bytes = Vec::new();
    from.take(MAX_FILE_BYTES + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > MAX_FILE_BYTES {
        return Ok(Err(MeshError::TooLarge { name: name.to_owned(), max_bytes: MAX_FILE_BYTES }));
    }
    Ok(Ok(bytes))
}

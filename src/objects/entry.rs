//! An object that can be loaded.

use std::path::PathBuf;

use super::families::{Family, made_object};
use super::key::{MADE, variant_key};
use super::retexture::retextured;
use crate::render::{Mesh, MeshError};

/// The licence of made objects, for label files.
pub const MADE_LICENCE: &str = "the project's own";

/// Where an object comes from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Source {
    /// A file of its own.
    File(PathBuf),
    /// A model of a furniture library.
    Library {
        /// The library.
        path: PathBuf,
        /// The model's file in it.
        entry: String,
    },
    /// Our own code.
    Made {
        /// What kind of thing.
        family: Family,
        /// Which of them.
        seed: u64,
    },
}

/// An object that can be loaded.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ObjectEntry {
    /// Unique among all objects; see the room's description.
    pub key: String,
    /// Name for people.
    pub name: String,
    /// The library's category or the family; empty for plain files.
    pub category: String,
    /// The library's licence, or [`MADE_LICENCE`]; empty for plain files.
    pub licence: String,
    /// Who made it; empty if unknown.
    pub creator: String,
    /// Where it comes from.
    pub source: Source,
    /// Number of the textures that it has instead of its own.
    pub texture: Option<u64>,
}

impl ObjectEntry {
    /// The made object of a family and seed.
    pub fn made(family: Family, seed: u64) -> Self {
        Self {
            key: format!("{MADE}{}/{seed}", family.name()),
            name: format!("{} {seed}", family.name()),
            category: family.name().to_owned(),
            licence: MADE_LICENCE.to_owned(),
            creator: String::new(),
            source: Source::Made { family, seed },
            texture: None,
        }
    }

    /// The same object in the textures of a number; `self` must be an original.
    pub fn variant(&self, texture: u64) -> Self {
        Self { key: variant_key(&self.key, texture), texture: Some(texture), ..self.clone() }
    }

    /// Loads or makes the mesh, z up.
    ///
    /// # Errors
    /// [`MeshError`] of objects on disk.
    pub fn load(&self) -> Result<Mesh, MeshError> {
        let mesh = match &self.source {
            Source::File(path) => Mesh::load(path)?,
            Source::Library { path, entry } => Mesh::load_entry(path, entry)?,
            Source::Made { family, seed } => made_object(*family, *seed),
        };
        Ok(match self.texture {
            Some(number) => retextured(&mesh, &self.key, number),
            None => mesh,
        })
    }

    /// How the command line names the object.
    pub fn address(&self) -> String {
        let original = match &self.source {
            Source::File(path) => path.display().to_string(),
            Source::Library { path, entry } => format!("{}#{entry}", path.display()),
            Source::Made { .. } => return self.key.clone(),
        };
        self.texture.map_or_else(|| original.clone(), |number| variant_key(&original, number))
    }
}

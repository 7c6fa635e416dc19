//! What can be wrong with an object's name.

use crate::render::MeshError;

/// Why an object is not there.
#[derive(Debug, thiserror::Error)]
pub enum ObjectError {
    /// `made:` and something that is no family.
    #[error("{key:?}: no family of made objects is called {family:?}; there are {known}")]
    Family {
        /// As given.
        key: String,
        /// The part that names the family.
        family: String,
        /// All there are.
        known: String,
    },
    /// `sample:` and something that is no sample.
    #[error("{key:?} is no sample object; there are {known}")]
    Sample {
        /// As given.
        key: String,
        /// All there are.
        known: String,
    },
    /// A number or a range of numbers that is none.
    #[error("{key:?}: {text:?} must be a whole number or a range such as 0..20 of at most {max} numbers", max = ObjectError::MAX_RANGE)]
    Range {
        /// As given.
        key: String,
        /// The part that is wrong.
        text: String,
    },
    /// One object was asked for and the text stands for several or none.
    #[error("{key:?} stands for {count} objects, must be one")]
    NotOne {
        /// As given.
        key: String,
        /// How many it stands for.
        count: usize,
    },
    /// A list of objects cannot be read.
    #[error("{path}: {source}")]
    List {
        /// The file.
        path: String,
        /// What the file system said.
        source: std::io::Error,
    },
    /// A folder or a model cannot be read.
    #[error(transparent)]
    Mesh(#[from] MeshError),
}

impl ObjectError {
    /// The most objects of one range.
    pub const MAX_RANGE: u64 = 1_000_000;
}

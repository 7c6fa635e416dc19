//! Why a folder of posed images cannot be read or written.

use std::path::PathBuf;

use crate::imaging::DecodeError;

/// Why a folder of posed images cannot be read or written. Each names the file.
#[derive(Debug, thiserror::Error)]
pub enum TransformsError {
    /// The folder has neither file.
    #[error("{} has no transforms.json and no transforms_train.json", dir.display())]
    Missing {
        /// The folder.
        dir: PathBuf,
    },
    /// A file cannot be read.
    #[error("{} cannot be read", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// What the system says.
        #[source]
        source: std::io::Error,
    },
    /// A file cannot be written.
    #[error("{} cannot be written", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// What the system says.
        #[source]
        source: std::io::Error,
    },
    /// An image cannot be encoded.
    #[error("{} cannot be encoded", path.display())]
    Encode {
        /// The file.
        path: PathBuf,
        /// What the encoder says.
        #[source]
        source: image::ImageError,
    },
    /// A file is not JSON, or a field has another type.
    #[error("{} is not a transforms file", path.display())]
    Json {
        /// The file.
        path: PathBuf,
        /// What is wrong, with line and column.
        #[source]
        source: serde_json::Error,
    },
    /// A field is missing or out of bounds.
    #[error("{}: {field} {problem}", path.display())]
    Field {
        /// The file.
        path: PathBuf,
        /// The field, as in `frames[3].transform_matrix`.
        field: String,
        /// What it is and what it must be.
        problem: String,
    },
    /// An image that a frame names cannot be decoded.
    #[error("{}", path.display())]
    Image {
        /// The image.
        path: PathBuf,
        /// What is wrong with it.
        #[source]
        source: DecodeError,
    },
}

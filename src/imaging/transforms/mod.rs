//! `transforms.json`: posed images on disk, as instant-ngp and nerfstudio read them.
//!
//! A pose is camera-to-world with OpenGL axes (x right, y up, z backward): OpenCV's
//! axes times diag(1, -1, -1). The cube that holds the object travels as
//! instant-ngp's `scale`, `offset` and `aabb_scale`: the unit cube is
//! `scale * world + offset`, so `offset = 0.5 - scale * centre`.

mod axes;
mod error;
mod file;
mod intrinsics;
mod read;
mod split;
#[cfg(test)]
mod tests;
mod write;

pub use error::TransformsError;
pub use read::{DEFAULT_TEST_EVERY, ImageSet, read_transforms};
pub use write::{TransformsFrame, transforms_text, write_image_set, write_transforms};

use crate::geometry::Point;

/// The axis-aligned cube that holds the object, world frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SceneCube {
    /// Centre, metres (or the unit of the file's poses).
    pub center: Point,
    /// Half the edge, in the same unit.
    pub half_extent_m: f64,
}

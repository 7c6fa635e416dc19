//! Meshes of links that a request attaches: points out of STL and OBJ files, and one
//! convex shape that holds them.

mod fit;
mod read;

pub(super) use fit::fit;
pub(super) use read::points;

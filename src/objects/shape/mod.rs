//! Building blocks of made objects: parts of a mesh, closed where the real thing is.

mod assembly;
mod ball;
mod blob;
mod box_projection;
mod curve;
mod ear_clip;
mod extrude;
mod lathe;
mod leaf;
mod loft;
mod march;
mod outline;
mod rounded_box;
mod sweep;

#[cfg(test)]
pub(super) use assembly::Part;
pub(super) use assembly::{Assembly, Built, WHOLE};
pub(super) use blob::{Blob, Lump};
pub(super) use box_projection::box_project;
pub(super) use curve::{path_through, rounded};
pub(super) use lathe::Section;
pub(super) use outline::{circle, gear, rounded_rectangle, star, superellipse};
pub(super) use rounded_box::{ATLAS, SAME_EACH};

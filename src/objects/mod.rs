//! Objects to render and to label: those on disk, those made by our own code, and variants of both in other
//! textures.
//!
//! An object has a key, unique among all: the path below its folder, `library/folder/model` in a furniture library,
//! `made:FAMILY/SEED` for a made one; `KEY~texture=N` is a variant. The key says all there is: the same one gives the
//! same bytes on every machine.

mod dice;
mod entry;
mod error;
mod exact;
mod families;
mod found;
mod frame;
mod key;
mod lookup;
mod paint;
mod retexture;
mod selection;
mod shape;
mod sheet;
#[cfg(test)]
mod tests;

pub use entry::{MADE_LICENCE, ObjectEntry, Source};
pub use error::ObjectError;
pub use families::{Family, families, made_object};
pub use found::{LookedAt, Unusable, find_objects, look_at_objects};
pub use key::original_key;
pub use lookup::ObjectLookup;
pub use selection::{load_object, object_at, select_objects};
pub use sheet::{SheetSettings, contact_sheet};

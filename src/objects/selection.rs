//! Objects by what a user writes.

use std::collections::HashSet;
use std::path::{Path, PathBuf};

use super::entry::{ObjectEntry, Source};
use super::error::ObjectError;
use super::families::{Family, families};
use super::found::{find_objects, look_at_objects};
use super::key::{MADE, range, split_variants, variant_key};
use super::retexture::retextured;
use crate::render::load::{extension, split_address};
use crate::render::{Mesh, sample_names, sample_object};

/// Before a sample object's name.
const SAMPLE: &str = "sample:";

/// The objects that texts stand for, without repetitions: a folder, a model file, `library.sh3f#entry`,
/// `made:FAMILY/SEED`, `made:FAMILY/0..100`, `made:*/0..10`, or a list of such, one a line, in a file ending in .txt;
/// each may end in `~texture=N` or `~texture=0..3` for variants. Folders give their usable objects alone.
///
/// # Errors
/// [`ObjectError`].
pub fn select_objects<T: AsRef<str>>(texts: &[T]) -> Result<Vec<ObjectEntry>, ObjectError> {
    let mut found = Vec::new();
    for text in texts {
        select(text.as_ref(), &mut found)?;
    }
    let mut known = HashSet::new();
    found.retain(|entry| known.insert(entry.key.clone()));
    Ok(found)
}

/// The one object at an address, without judging it: as [`ObjectEntry::address`] gives it, or a file's path.
///
/// # Errors
/// [`ObjectError`] when the text cannot be understood or stands for several.
pub fn object_at(address: &str) -> Result<ObjectEntry, ObjectError> {
    let (original, variants) = split_variants(address)?;
    let originals = if original.starts_with(MADE) { made(original)? } else { vec![file(original)] };
    match (&originals[..], variants) {
        ([entry], None) => Ok(entry.clone()),
        ([entry], Some(numbers)) if numbers.end - numbers.start == 1 => Ok(entry.variant(numbers.start)),
        (several, numbers) => {
            let variants = numbers.map_or(1, |n| n.end - n.start) as usize;
            Err(ObjectError::NotOne { key: address.to_owned(), count: several.len() * variants })
        }
    }
}

/// Loads what an address stands for: [`object_at`], or a sample object by `sample:NAME` or `sample:NAME:SEED`.
///
/// # Errors
/// [`ObjectError`].
pub fn load_object(address: &str) -> Result<Mesh, ObjectError> {
    let (original, variants) = split_variants(address)?;
    let Some(name) = original.strip_prefix(SAMPLE) else { return Ok(object_at(address)?.load()?) };
    let known = || sample_names().join(", ");
    let mesh =
        sample_object(name).ok_or_else(|| ObjectError::Sample { key: address.to_owned(), known: known() })?;
    match variants {
        None => Ok(mesh),
        Some(numbers) if numbers.end - numbers.start == 1 => {
            Ok(retextured(&mesh, &variant_key(original, numbers.start), numbers.start))
        }
        Some(numbers) => {
            let count = (numbers.end - numbers.start) as usize;
            Err(ObjectError::NotOne { key: address.to_owned(), count })
        }
    }
}

fn select(text: &str, found: &mut Vec<ObjectEntry>) -> Result<(), ObjectError> {
    let (original, variants) = split_variants(text)?;
    let mut originals = Vec::new();
    if original.starts_with(MADE) {
        originals = made(original)?;
    } else if extension(Path::new(original)) == "txt" {
        let lines = std::fs::read_to_string(original)
            .map_err(|source| ObjectError::List { path: original.to_owned(), source })?;
        for line in lines.lines().map(str::trim).filter(|line| !line.is_empty() && !line.starts_with('#')) {
            // A list in a list could go in a circle.
            match extension(Path::new(line)).as_str() {
                "txt" => return Err(ObjectError::NotOne { key: line.to_owned(), count: 0 }),
                _ => select(line, &mut originals)?,
            }
        }
    } else if let Some((library, model)) = split_address(original) {
        let in_library = look_at_objects(library)?.into_iter().map(|(entry, _)| entry);
        let is_it = |e: &ObjectEntry| matches!(&e.source, Source::Library { entry, .. } if entry == model);
        originals.extend(in_library.filter(is_it));
        if originals.is_empty() {
            return Err(ObjectError::NotOne { key: text.to_owned(), count: 0 });
        }
    } else {
        originals = find_objects(original)?;
    }
    match variants {
        None => found.extend(originals),
        Some(numbers) => {
            for number in numbers {
                found.extend(originals.iter().filter(|e| e.texture.is_none()).map(|e| e.variant(number)));
            }
        }
    }
    Ok(())
}

/// The objects of `made:FAMILY/NUMBERS`.
pub(super) fn made(key: &str) -> Result<Vec<ObjectEntry>, ObjectError> {
    let rest = key.strip_prefix(MADE).unwrap_or(key);
    let (name, numbers) = rest.split_once('/').unwrap_or((rest, ""));
    let chosen: Vec<Family> = families().filter(|family| name == "*" || family.name() == name).collect();
    if chosen.is_empty() {
        let known: Vec<&str> = families().map(|family| family.name()).collect();
        return Err(ObjectError::Family {
            key: key.to_owned(),
            family: name.to_owned(),
            known: known.join(", "),
        });
    }
    let numbers = range(key, numbers)?;
    let of_family = |family: &Family| {
        let family = *family;
        numbers.clone().map(move |seed| ObjectEntry::made(family, seed))
    };
    Ok(chosen.iter().flat_map(of_family).collect())
}

/// The object in a file, or the model in a library.
pub(super) fn file(address: &str) -> ObjectEntry {
    let source = match split_address(address) {
        Some((library, entry)) => Source::Library { path: PathBuf::from(library), entry: entry.to_owned() },
        None => Source::File(PathBuf::from(address)),
    };
    let inner = match &source {
        Source::Library { entry, .. } => entry.as_str(),
        _ => address,
    };
    let stem = Path::new(inner).file_stem();
    let name = stem.map_or(address.to_owned(), |s| s.to_string_lossy().into_owned());
    let (category, licence, creator) = Default::default();
    ObjectEntry { key: address.to_owned(), name, category, licence, creator, source, texture: None }
}

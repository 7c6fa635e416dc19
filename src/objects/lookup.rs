//! Objects by the keys that a label file holds.

use std::collections::HashMap;

use super::entry::ObjectEntry;
use super::error::ObjectError;
use super::key::{MADE, split_variants};
use super::selection::{made, select_objects};

/// Finds objects by their keys.
pub struct ObjectLookup {
    by_key: HashMap<String, ObjectEntry>,
}

impl ObjectLookup {
    /// Of the objects that `texts` stand for (see [`select_objects`]), of all made ones, and of variants of both.
    ///
    /// # Errors
    /// [`ObjectError`].
    pub fn new<T: AsRef<str>>(texts: &[T]) -> Result<Self, ObjectError> {
        let by_key = select_objects(texts)?.into_iter().map(|entry| (entry.key.clone(), entry)).collect();
        Ok(Self { by_key })
    }

    /// The object of a key; `None` when there is none.
    pub fn get(&self, key: &str) -> Option<ObjectEntry> {
        if let Some(entry) = self.by_key.get(key) {
            return Some(entry.clone());
        }
        let (original, variants) = split_variants(key).ok()?;
        let entry = match self.by_key.get(original) {
            Some(entry) => entry.clone(),
            None if original.starts_with(MADE) => made(original).ok().filter(|all| all.len() == 1)?.pop()?,
            None => return None,
        };
        match variants {
            None => Some(entry),
            Some(numbers) => (numbers.end - numbers.start == 1).then(|| entry.variant(numbers.start)),
        }
    }
}

//! Members that a JSON document gives twice. The parser of a type sees them only where it knows the members'
//! names; in maps, such as joint limits by name, the last would win in silence.

use std::collections::HashSet;
use std::fmt;

use serde::de::{DeserializeSeed, Deserializer, Error, MapAccess, SeqAccess, Visitor};

/// Longest part of a member's name that is told, characters.
const LONGEST_NAME: usize = 64;

/// The path of the first member that is given twice, such as `limits.elbow_joint`; `None` in documents
/// without one and in those that are no JSON up to there.
pub(super) fn given_twice(bytes: &[u8]) -> Option<String> {
    let mut place = Place::default();
    let mut reader = serde_json::Deserializer::from_slice(bytes);
    match Walk(&mut place).deserialize(&mut reader) {
        Err(_) if place.is_found => Some(place.path()),
        _ => None,
    }
}

/// Where the walk has stopped, innermost part first.
#[derive(Default)]
struct Place {
    is_found: bool,
    parts: Vec<Part>,
}

enum Part {
    Name(String),
    Index(usize),
}

impl Place {
    fn path(&self) -> String {
        let mut path = String::new();
        for part in self.parts.iter().rev() {
            match part {
                Part::Name(name) => {
                    path.push_str(if path.is_empty() { "" } else { "." });
                    path.extend(name.chars().take(LONGEST_NAME));
                }
                Part::Index(index) => path.push_str(&format!("[{index}]")),
            }
        }
        path
    }
}

struct Walk<'a>(&'a mut Place);

impl<'de> DeserializeSeed<'de> for Walk<'_> {
    type Value = ();

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<(), D::Error> {
        deserializer.deserialize_any(self)
    }
}

impl<'de> Visitor<'de> for Walk<'_> {
    type Value = ();

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a JSON value")
    }

    fn visit_bool<E: Error>(self, _: bool) -> Result<(), E> {
        Ok(())
    }

    fn visit_i64<E: Error>(self, _: i64) -> Result<(), E> {
        Ok(())
    }

    fn visit_u64<E: Error>(self, _: u64) -> Result<(), E> {
        Ok(())
    }

    fn visit_f64<E: Error>(self, _: f64) -> Result<(), E> {
        Ok(())
    }

    fn visit_str<E: Error>(self, _: &str) -> Result<(), E> {
        Ok(())
    }

    fn visit_unit<E: Error>(self) -> Result<(), E> {
        Ok(())
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut items: A) -> Result<(), A::Error> {
        for index in 0.. {
            match items.next_element_seed(Walk(&mut *self.0)) {
                Ok(Some(())) => {}
                Ok(None) => break,
                Err(error) => {
                    self.0.parts.push(Part::Index(index));
                    return Err(error);
                }
            }
        }
        Ok(())
    }

    fn visit_map<A: MapAccess<'de>>(self, mut members: A) -> Result<(), A::Error> {
        let mut names = HashSet::new();
        while let Some(name) = members.next_key::<String>()? {
            let is_new = names.insert(name.clone());
            let walked = match is_new {
                true => members.next_value_seed(Walk(&mut *self.0)),
                false => {
                    self.0.is_found = true;
                    Err(A::Error::custom("given twice"))
                }
            };
            if let Err(error) = walked {
                self.0.parts.push(Part::Name(name));
                return Err(error);
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_member_given_twice_is_found_at_any_depth_with_its_path() {
        for (text, path) in [
            (r#"{"a": 1, "a": 1}"#, Some("a")),
            (r#"{"limits": {"j": {"min": 1}, "k": {}, "j": {}}}"#, Some("limits.j")),
            (r#"{"a": [1, {"b": [[], {"c": 0, "c": 0}]}]}"#, Some("a[1].b[1].c")),
            (r#"[{"a": null}, {"a": true, "b": "a"}, -1.5]"#, None),
            (r#"{"a": {"b": 1}, "b": {"a": 1}}"#, None),
            (r#"{"a": NaN, "a": 1}"#, None),
            (r#"{"a": "#, None),
        ] {
            assert_eq!(given_twice(text.as_bytes()).as_deref(), path, "{text}");
        }
    }
}

//! Whole numbers, however they are spelt: 35 and 35.0 are one number in JSON.

use std::fmt;

use serde::de::{Deserializer, Error, Unexpected, Visitor};

/// What is expected, in the words of an error.
const EXPECTED: &str = "a whole number of at least 0";

/// A whole number.
pub fn whole<'de, D: Deserializer<'de>>(deserializer: D) -> Result<u32, D::Error> {
    deserializer.deserialize_any(Whole)
}

/// A whole number or none.
pub fn optional_whole<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<u32>, D::Error> {
    deserializer.deserialize_option(OptionalWhole)
}

struct Whole;

impl Visitor<'_> for Whole {
    type Value = u32;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(EXPECTED)
    }

    fn visit_u64<E: Error>(self, value: u64) -> Result<u32, E> {
        u32::try_from(value).map_err(|_| E::invalid_value(Unexpected::Unsigned(value), &self))
    }

    fn visit_i64<E: Error>(self, value: i64) -> Result<u32, E> {
        u32::try_from(value).map_err(|_| E::invalid_value(Unexpected::Signed(value), &self))
    }

    fn visit_f64<E: Error>(self, value: f64) -> Result<u32, E> {
        let is_whole = value.fract() == 0.0 && (0.0..=f64::from(u32::MAX)).contains(&value);
        if is_whole { Ok(value as u32) } else { Err(E::invalid_value(Unexpected::Float(value), &self)) }
    }
}

struct OptionalWhole;

impl<'de> Visitor<'de> for OptionalWhole {
    type Value = Option<u32>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(EXPECTED)
    }

    fn visit_none<E: Error>(self) -> Result<Self::Value, E> {
        Ok(None)
    }

    fn visit_unit<E: Error>(self) -> Result<Self::Value, E> {
        Ok(None)
    }

    fn visit_some<D: Deserializer<'de>>(self, deserializer: D) -> Result<Self::Value, D::Error> {
        whole(deserializer).map(Some)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<u32, serde_json::Error> {
        whole(&mut serde_json::Deserializer::from_str(text))
    }

    #[test]
    fn every_spelling_of_a_whole_number_is_one() {
        for text in ["35", "35.0", "3.5e1", "350e-1"] {
            assert_eq!(read(text).unwrap(), 35, "{text}");
        }
        assert_eq!(read("-0.0").unwrap(), 0);
        assert_eq!(optional_whole(&mut serde_json::Deserializer::from_str("null")).unwrap(), None);
    }

    #[test]
    fn what_is_no_whole_number_is_refused() {
        for text in ["3.5", "-1", "-1.0", "4294967296", "1e300", "\"3\"", "[3]", "true", "null"] {
            assert!(read(text).unwrap_err().to_string().contains(EXPECTED), "{text}");
        }
    }
}

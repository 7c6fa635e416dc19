//! Keys of objects and their variants.

use std::ops::Range;

use super::error::ObjectError;

/// Between an object's key and the number of its texture.
const VARIANT: &str = "~texture=";
/// Before a made object's family.
pub(super) const MADE: &str = "made:";

/// The key of the object that a key is a variant of: what comes before `~`. Whatever splits objects into those to
/// learn from and those to judge by must split by this.
pub fn original_key(key: &str) -> &str {
    key.split_once('~').map_or(key, |(original, _)| original)
}

/// The key of a variant.
pub(super) fn variant_key(original: &str, texture: u64) -> String {
    format!("{original}{VARIANT}{texture}")
}

/// An address without its variants, and their numbers.
pub(super) fn split_variants(text: &str) -> Result<(&str, Option<Range<u64>>), ObjectError> {
    match text.rsplit_once(VARIANT) {
        Some((original, numbers)) => Ok((original, Some(range(text, numbers)?))),
        None => Ok((text, None)),
    }
}

/// `7` or `0..20`.
pub(super) fn range(key: &str, text: &str) -> Result<Range<u64>, ObjectError> {
    let numbers = match text.split_once("..") {
        Some((from, to)) => from.parse().ok().zip(to.parse().ok()),
        None => text.parse().ok().and_then(|n: u64| Some((n, n.checked_add(1)?))),
    };
    match numbers {
        Some((from, to)) if from < to && to - from <= ObjectError::MAX_RANGE => Ok(from..to),
        _ => Err(ObjectError::Range { key: key.to_owned(), text: text.to_owned() }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_variant_belongs_to_its_original() {
        assert_eq!(original_key("made:mug/17~texture=3"), "made:mug/17");
        assert_eq!(original_key("Scopia/scopia/oven/oven"), "Scopia/scopia/oven/oven");
        assert_eq!(original_key(&variant_key("a/b", 12)), "a/b");
    }

    #[test]
    fn numbers_and_ranges_are_read_and_others_refused() {
        assert_eq!(range("", "7").unwrap(), 7..8);
        assert_eq!(range("", "3..20").unwrap(), 3..20);
        for bad in ["", "x", "5..5", "9..2", "-1", "0..99999999", "18446744073709551615", "1..2..3"] {
            assert!(range("made:mug/", bad).is_err(), "{bad}");
        }
        assert_eq!(split_variants("a~texture=2..4").unwrap(), ("a", Some(2..4)));
        assert!(split_variants("a~texture=").is_err());
    }
}

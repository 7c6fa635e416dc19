//! Bounds on URDF text before a parser that recurses sees it.

use crate::robot::RobotError;
use crate::robot::bounds::LONGEST_URDF_BYTES;

/// Deepest nesting of elements; URDF itself needs six.
const DEEPEST: usize = 32;

/// Refuses text that is too long or nested too deeply, and declarations that URDF has no use for.
pub(super) fn check_text(text: &str) -> Result<(), RobotError> {
    let refuse = |problem: String| Err(RobotError::Urdf(problem));
    if text.len() > LONGEST_URDF_BYTES {
        return refuse(format!("{} bytes long, at most {LONGEST_URDF_BYTES} are read", text.len()));
    }
    let mut depth = 0usize;
    let mut rest = text;
    while let Some(open) = rest.find('<') {
        rest = rest.get(open..).unwrap_or_default();
        let end = if rest.starts_with("<!--") {
            after(rest, 4, "-->")
        } else if rest.starts_with("<?") {
            after(rest, 2, "?>")
        } else if rest.starts_with("<!") {
            return refuse("document types and CDATA sections are not read".to_owned());
        } else {
            tag_end(rest)
        };
        let Some(end) = end else { return refuse("an element or comment is not closed".to_owned()) };
        if rest.starts_with("</") {
            depth = depth.saturating_sub(1);
        } else if !rest.starts_with("<!")
            && !rest.starts_with("<?")
            && !rest.get(..end).unwrap_or_default().ends_with("/>")
        {
            depth += 1;
            if depth > DEEPEST {
                return refuse(format!("elements nested deeper than {DEEPEST}"));
            }
        }
        rest = rest.get(end..).unwrap_or_default();
    }
    Ok(())
}

/// Index after `mark` in `text`, looked for from `from` on.
fn after(text: &str, from: usize, mark: &str) -> Option<usize> {
    text.get(from..)?.find(mark).map(|at| from + at + mark.len())
}

/// Index after the `>` that closes the tag at the start of `text`, quoted ones skipped.
fn tag_end(text: &str) -> Option<usize> {
    let mut quote = None;
    for (i, byte) in text.bytes().enumerate() {
        match (quote, byte) {
            (None, b'"' | b'\'') => quote = Some(byte),
            (Some(open), _) if open == byte => quote = None,
            (None, b'>') => return Some(i + 1),
            _ => {}
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn deep_nesting_and_long_text_are_refused_before_parsing() {
        assert!(check_text(&"<a>".repeat(100_000)).unwrap_err().to_string().contains("nested"));
        assert!(check_text(&"x".repeat(LONGEST_URDF_BYTES + 1)).unwrap_err().to_string().contains("at most"));
        assert!(check_text("<!DOCTYPE a [<!ENTITY b 'c'>]><a/>").is_err());
        assert!(check_text("<a b='>").is_err());
    }

    #[test]
    fn ordinary_text_passes() {
        let text =
            "<?xml version='1.0'?><!-- <a><a> --><robot name=\"a>b\"><link name='x'/><link></link></robot>";
        assert_eq!(check_text(text), Ok(()));
    }

    #[test]
    fn comments_cannot_hide_depth() {
        assert!(check_text(&"<a><!-- </a> -->".repeat(50)).is_err());
    }
}

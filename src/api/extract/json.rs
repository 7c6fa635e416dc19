//! JSON bodies, with errors that name the member, the value and what was expected.

use axum::extract::{FromRequest, Request};
use axum::http::StatusCode;
use serde::de::DeserializeOwned;
use serde_json::Value;
use serde_json::error::Category;

use super::BodyBytes;
use super::media::check_is_plain_json;
use super::member::wrong_member;
use super::twice::given_twice;
use crate::api::problem::Problem;

/// A byte order mark: what some editors write in front of a text.
struct Mark {
    bytes: &'static [u8],
    name: &'static str,
    bound: &'static str,
}

const MARKS: [Mark; 3] = [
    Mark {
        bytes: b"\xef\xbb\xbf",
        name: "a UTF-8 byte order mark (EF BB BF)",
        bound: "JSON without a byte order mark in front",
    },
    Mark { bytes: b"\xff\xfe", name: "a UTF-16 byte order mark (FF FE)", bound: "JSON in UTF-8" },
    Mark { bytes: b"\xfe\xff", name: "a UTF-16 byte order mark (FE FF)", bound: "JSON in UTF-8" },
];

/// A body of type `application/json` that parses as `T`.
pub struct JsonBody<T>(pub T);

impl<T: DeserializeOwned, S: Send + Sync> FromRequest<S> for JsonBody<T> {
    type Rejection = Problem;

    async fn from_request(request: Request, state: &S) -> Result<Self, Problem> {
        let readable = check_is_plain_json(request.headers());
        // The body is read before any refusal so that the client gets to see the answer.
        let BodyBytes(bytes) = BodyBytes::from_request(request, state).await?;
        readable?;
        parse_json(&bytes).map(Self)
    }
}

/// Parses `bytes`.
///
/// # Errors
/// A [`Problem`]: 400 `malformed_json` when it is no JSON (`NaN`, numbers beyond f64), 422
/// `invalid_member` when a member is missing, unknown, given twice or of the wrong type.
pub fn parse_json<T: DeserializeOwned>(bytes: &[u8]) -> Result<T, Problem> {
    // A list of values would be read as a request's members in order.
    if bytes.trim_ascii_start().first() == Some(&b'[') {
        let body = serde_json::from_slice::<Value>(bytes).unwrap_or(Value::Null);
        return Err(Problem::field("invalid_member", "body", body, "an object"));
    }
    if let Some(path) = given_twice(bytes) {
        return Err(Problem::field("invalid_member", path, "given more than once", "given once"));
    }
    let mut reader = serde_json::Deserializer::from_slice(bytes);
    let parsed: T = serde_path_to_error::deserialize(&mut reader)
        .map_err(|error| explain::<T>(bytes, error.path().to_string(), error.inner()))?;
    reader.end().map_err(|error| explain::<T>(bytes, ".".to_owned(), &error))?;
    Ok(parsed)
}

fn explain<T: DeserializeOwned>(bytes: &[u8], path: String, error: &serde_json::Error) -> Problem {
    let path = if matches!(path.as_str(), "." | "?") { "body".to_owned() } else { path };
    // Some wrong members are syntax errors to the reader of bytes, but not to that of values.
    match serde_json::from_slice::<Value>(bytes) {
        Ok(document) => wrong_member::<T>(&document).unwrap_or_else(|| malformed(bytes, path, error)),
        Err(_) => malformed(bytes, path, error),
    }
}

fn malformed(bytes: &[u8], path: String, error: &serde_json::Error) -> Problem {
    // What stands before the first line of JSON is no JSON, and cannot be seen.
    if let Some(mark) = MARKS.iter().find(|mark| bytes.starts_with(mark.bytes)) {
        let text = format!("{path}: no JSON at line 1, column 1: {}", mark.name);
        return Problem::new(StatusCode::BAD_REQUEST, "malformed_json", text).at(path, mark.name, mark.bound);
    }
    let message = error.to_string();
    let reason = message.rsplit_once(" at line ").map_or(message.as_str(), |(head, _)| head);
    let bound = match error.classify() {
        Category::Eof => "a whole JSON document: it ends too early",
        _ if reason.starts_with("number out of range") => "a number within the range of a 64-bit float",
        _ if reason.starts_with("trailing characters") => "one JSON document with nothing behind it",
        _ if reason.starts_with("trailing comma") => "JSON without a comma before a closing bracket",
        _ if reason.starts_with("key must be") => "JSON with the names of members in double quotes",
        _ if reason.starts_with("invalid unicode code point") => "JSON in UTF-8",
        _ => "valid JSON (which knows no NaN or Infinity)",
    };
    let (line, column) = (error.line(), error.column());
    let text = format!("{path}: no JSON at line {line}, column {column}: {reason}");
    let value = match error.classify() {
        Category::Eof => "the end".to_owned(),
        _ => token_at(bytes, line, column),
    };
    Problem::new(StatusCode::BAD_REQUEST, "malformed_json", text).at(path, value, bound)
}

/// The word around a position of the document, at most 40 bytes of it.
fn token_at(bytes: &[u8], line: usize, column: usize) -> String {
    let text = bytes.split(|b| *b == b'\n').nth(line.saturating_sub(1)).unwrap_or(&[]);
    let is_word = |b: &u8| b.is_ascii_alphanumeric() || matches!(b, b'+' | b'-' | b'.' | b'_');
    let at = column.saturating_sub(1).min(text.len());
    let (before, after) = text.split_at(at);
    let start = before.iter().rev().take_while(|b| is_word(b)).count().min(40);
    let end = after.iter().take_while(|b| is_word(b)).count().min(40);
    let word = text.get(at - start..at + end.max(1)).or_else(|| text.get(at - start..)).unwrap_or(&[]);
    String::from_utf8_lossy(word).into_owned()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::api::wire::PlanRequestJson;

    fn refusal(body: &str) -> Problem {
        parse_json::<PlanRequestJson>(body.as_bytes()).unwrap_err()
    }

    #[test]
    fn a_nan_is_named_with_its_member() {
        let problem = refusal(r#"{"view_count": 5, "object": {"center": [0.1, NaN, 0.2], "radius": 0.1}}"#);
        assert_eq!((problem.status, problem.code.as_str()), (400, "malformed_json"));
        assert_eq!(problem.field.as_deref(), Some("object.center[1]"));
        assert_eq!(problem.value, Some("NaN".into()));
    }

    #[test]
    fn a_number_beyond_f64_is_named_with_its_member() {
        let problem = refusal(r#"{"object": {"radius": 1e999, "center": [0, 0, 0]}}"#);
        assert_eq!(problem.status, 400);
        assert_eq!(problem.field.as_deref(), Some("object.radius"));
        assert_eq!(problem.value, Some("1e999".into()));
        assert!(problem.bound.as_deref().unwrap().contains("64-bit"));
    }

    #[test]
    fn a_text_instead_of_a_number_is_named_with_its_value() {
        let problem = refusal(r#"{"object": {"center": [0, 0, "high"], "radius": 0.1}}"#);
        assert_eq!((problem.status, problem.code.as_str()), (422, "invalid_member"));
        assert_eq!(problem.field.as_deref(), Some("object.center[2]"));
        assert_eq!(problem.value, Some("high".into()));
        assert_eq!(problem.bound.as_deref(), Some("a number"));
    }

    #[test]
    fn unknown_and_missing_members_are_named() {
        let unknown = refusal(r#"{"view_count": 5, "objekt": 3}"#);
        assert_eq!(unknown.field.as_deref(), Some("objekt"));
        assert_eq!(unknown.value, Some(3.into()));
        assert!(unknown.bound.as_deref().unwrap().contains("`object`"));
        let missing = refusal(r#"{"object": {"center": [0, 0, 0]}}"#);
        assert_eq!(missing.field.as_deref(), Some("object.radius"));
    }

    #[test]
    fn what_an_editor_wrote_in_front_is_named() {
        let refused = |bytes: &[u8]| parse_json::<PlanRequestJson>(bytes).unwrap_err();
        let marked = refused(b"\xef\xbb\xbf{\"view_count\": 5}");
        assert_eq!((marked.status, marked.code.as_str()), (400, "malformed_json"));
        assert_eq!(marked.bound.as_deref(), Some("JSON without a byte order mark in front"));
        assert!(
            marked.detail.contains("byte order mark") && !marked.detail.contains("NaN"),
            "{}",
            marked.detail
        );
        assert_eq!(refused(b"\xff\xfe{\0}\0").bound.as_deref(), Some("JSON in UTF-8"));
        assert_eq!(refused(b"{\"views\": \"\xe9\"}").bound.as_deref(), Some("JSON in UTF-8"));
    }

    #[test]
    fn a_cut_off_document_is_malformed() {
        assert_eq!(refusal(r#"{"view_count": 5"#).code, "malformed_json");
        assert_eq!(refusal("").code, "malformed_json");
        assert_eq!(refusal("{} {}").code, "malformed_json");
    }
}

//! What the headers say about a body: JSON in UTF-8, not packed.

use axum::http::{HeaderMap, HeaderName, StatusCode, header};

use crate::api::problem::Problem;

/// Checks `Content-Type` and `Content-Encoding` of a body that is to be JSON.
///
/// # Errors
/// 415 naming the header.
pub(super) fn check_is_plain_json(headers: &HeaderMap) -> Result<(), Problem> {
    let encoding = text(headers, header::CONTENT_ENCODING);
    if let Some(coding) = encoding.filter(|coding| !coding.trim().eq_ignore_ascii_case("identity")) {
        let bound = "left out or identity: bodies are not unpacked";
        return Err(refused("Content-Encoding", Some(coding), bound));
    }
    let given = text(headers, header::CONTENT_TYPE);
    let mut parts = given.as_deref().unwrap_or("").split(';').map(str::trim);
    let essence = parts.next().unwrap_or("").to_ascii_lowercase();
    let is_json =
        essence == "application/json" || (essence.starts_with("application/") && essence.ends_with("+json"));
    if !is_json {
        return Err(refused("Content-Type", given, "application/json"));
    }
    let charset = parts.find_map(|part| {
        let (name, value) = part.split_once('=')?;
        name.trim().eq_ignore_ascii_case("charset").then(|| value.trim().trim_matches('"'))
    });
    match charset {
        Some(name) if !["utf-8", "utf8"].contains(&name.to_ascii_lowercase().as_str()) => {
            Err(refused("Content-Type", given, "application/json in UTF-8, the one charset of JSON"))
        }
        _ => Ok(()),
    }
}

fn text(headers: &HeaderMap, name: HeaderName) -> Option<String> {
    headers.get(name).map(|value| String::from_utf8_lossy(value.as_bytes()).into_owned())
}

fn refused(header: &str, value: Option<String>, bound: &str) -> Problem {
    Problem::field("unsupported_media_type", header, value, bound)
        .with_status(StatusCode::UNSUPPORTED_MEDIA_TYPE)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn field(content_type: &str, encoding: Option<&str>) -> Option<String> {
        let mut headers = HeaderMap::new();
        headers.insert(header::CONTENT_TYPE, content_type.parse().unwrap());
        if let Some(coding) = encoding {
            headers.insert(header::CONTENT_ENCODING, coding.parse().unwrap());
        }
        check_is_plain_json(&headers).err().and_then(|problem| problem.field.clone())
    }

    #[test]
    fn json_in_utf_8_is_taken_however_that_is_spelt() {
        for content_type in [
            "application/json",
            "Application/JSON; charset=UTF-8",
            "application/json;charset=\"utf-8\"",
            "application/vnd.prv+json",
            "application/json; profile=x",
        ] {
            assert_eq!(field(content_type, None), None, "{content_type}");
        }
        assert_eq!(field("application/json", Some("identity")), None);
    }

    #[test]
    fn what_is_not_read_is_refused_by_its_header() {
        for content_type in ["text/plain", "application/json; charset=iso-8859-1", "json", ""] {
            assert_eq!(field(content_type, None).as_deref(), Some("Content-Type"), "{content_type}");
        }
        assert_eq!(field("application/json", Some("gzip")).as_deref(), Some("Content-Encoding"));
    }
}

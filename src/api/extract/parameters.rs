//! Path and query parameters.

use axum::extract::path::ErrorKind;
use axum::extract::rejection::PathRejection;
use axum::extract::{FromRequestParts, MatchedPath, Path, Query, Request};
use axum::http::request::Parts;
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};
use serde::de::DeserializeOwned;
use serde_json::Value;

use crate::api::problem::Problem;

/// A path parameter that parses as `T`.
pub struct PathParam<T>(pub T);

impl<T: DeserializeOwned + Send, S: Send + Sync> FromRequestParts<S> for PathParam<T> {
    type Rejection = Problem;

    async fn from_request_parts(parts: &mut Parts, state: &S) -> Result<Self, Problem> {
        Path::<T>::from_request_parts(parts, state).await.map(|Path(value)| Self(value)).map_err(|error| {
            let (name, value) = match &error {
                PathRejection::FailedToDeserializePathParams(error) => match error.kind() {
                    ErrorKind::ParseErrorAtKey { key, value, .. } => (key.clone(), value.clone()),
                    ErrorKind::ParseErrorAtIndex { index, value, .. } => {
                        (parameter_name(parts, *index), value.clone())
                    }
                    ErrorKind::ParseError { value, .. } => (parameter_name(parts, 0), value.clone()),
                    ErrorKind::InvalidUtf8InPathParam { key } => {
                        let bound = "percent-encoded UTF-8";
                        return Problem::field("invalid_path", key.clone(), Value::Null, bound);
                    }
                    _ => ("path".to_owned(), parts.uri.path().to_owned()),
                },
                _ => ("path".to_owned(), parts.uri.path().to_owned()),
            };
            Problem::field("invalid_path", name, value, "a whole number of at least 0")
        })
    }
}

/// The name of a path's parameter by its index, for parsers that do not know it.
fn parameter_name(parts: &Parts, index: usize) -> String {
    let template = parts.extensions.get::<MatchedPath>().map_or("", MatchedPath::as_str);
    let name = template.split('{').skip(1).nth(index).and_then(|rest| rest.split('}').next());
    name.unwrap_or("path").to_owned()
}

/// Query parameters that parse as `T`.
pub struct QueryParams<T>(pub T);

impl<T: DeserializeOwned + Send, S: Send + Sync> FromRequestParts<S> for QueryParams<T> {
    type Rejection = Problem;

    async fn from_request_parts(parts: &mut Parts, state: &S) -> Result<Self, Problem> {
        Query::<T>::from_request_parts(parts, state).await.map(|Query(value)| Self(value)).map_err(|error| {
            let query = parts.uri.query().unwrap_or("").to_owned();
            let text = error.body_text();
            let field = text.split("deserialize query string: ").nth(1).and_then(|t| t.split(':').next());
            let field = field.unwrap_or("query").to_owned();
            let value = query
                .split('&')
                .find_map(|pair| pair.strip_prefix(&format!("{field}=")))
                .unwrap_or(&query)
                .to_owned();
            let bound = match text.split_once("expected ") {
                Some((_, known)) if text.contains("unknown field") => {
                    format!("left out: the parameters here are {}", known.trim_start_matches("one of "))
                }
                _ => "a number".to_owned(),
            };
            Problem::field("invalid_query", field, value, bound)
        })
    }
}

/// In front of routes without query parameters: what would be ignored is refused.
pub async fn refuse_query(request: Request, next: Next) -> Response {
    let first = request.uri().query().and_then(|query| query.split('&').find(|pair| !pair.is_empty()));
    let Some(pair) = first else { return next.run(request).await };
    let (name, value) = pair.split_once('=').unwrap_or((pair, ""));
    Problem::field("invalid_query", name, value, "left out: there are no query parameters here")
        .into_response()
}

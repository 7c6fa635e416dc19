//! Path and query parameters.

use axum::extract::{FromRequestParts, Path, Query};
use axum::http::StatusCode;
use axum::http::request::Parts;
use serde::de::DeserializeOwned;

use crate::api::problem::Problem;

/// A path parameter that parses as `T`.
pub struct PathParam<T>(pub T);

impl<T: DeserializeOwned + Send, S: Send + Sync> FromRequestParts<S> for PathParam<T> {
    type Rejection = Problem;

    async fn from_request_parts(parts: &mut Parts, state: &S) -> Result<Self, Problem> {
        let path = parts.uri.path().to_owned();
        Path::<T>::from_request_parts(parts, state).await.map(|Path(value)| Self(value)).map_err(|error| {
            let value = path.rsplit('/').next().unwrap_or("").to_owned();
            Problem::new(StatusCode::UNPROCESSABLE_ENTITY, "invalid_path", error.body_text()).at(
                "path",
                value,
                "a whole number",
            )
        })
    }
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
                Some((_, known)) if text.contains("unknown field") => format!("left out: expected {known}"),
                _ => "a number".to_owned(),
            };
            Problem::new(StatusCode::UNPROCESSABLE_ENTITY, "invalid_query", text).at(field, value, bound)
        })
    }
}

//! Handlers, one file a group of routes.

pub mod checks;
pub mod events;
pub mod executions;
pub mod health;
pub mod images;
pub mod objects;
pub mod plans;
pub mod predictions;
pub mod reachability;
mod refusals;
pub mod robots;
mod run;
pub mod view_spaces;

use axum::http::{HeaderValue, header};
use axum::response::{IntoResponse, Response};

use super::problem::Problem;

/// A stored or computed JSON document, as it is.
pub fn json_bytes(bytes: impl Into<axum::body::Body>) -> Response {
    let mut response = bytes.into().into_response();
    response.headers_mut().insert(header::CONTENT_TYPE, HeaderValue::from_static("application/json"));
    response
}

/// Does what may block (files) off the async threads.
///
/// # Errors
/// Those of `work`; 500 when it panicked.
async fn off_thread<T: Send + 'static>(
    work: impl FnOnce() -> Result<T, Problem> + Send + 'static,
) -> Result<T, Problem> {
    tokio::task::spawn_blocking(work).await.map_err(|error| Problem::internal(error.to_string()))?
}

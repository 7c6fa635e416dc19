//! The request body, bounded.

use std::time::Duration;

use axum::body::Bytes;
use axum::extract::{FromRequest, Request};
use axum::http::{StatusCode, header};
use tokio_stream::StreamExt;

use crate::api::problem::Problem;

/// Largest body in bytes.
pub const MAX_BODY_BYTES: usize = 32 << 20;
/// What is read and thrown away after a body turned out too large: a client that is cut off in the
/// middle of sending would see a broken connection instead of the answer.
const DRAINED_BYTES: usize = 64 << 20;
/// Longest time spent on that.
const DRAIN_TIME: Duration = Duration::from_secs(5);

/// The whole body of at most [`MAX_BODY_BYTES`].
pub struct BodyBytes(pub Bytes);

impl<S: Send + Sync> FromRequest<S> for BodyBytes {
    type Rejection = Problem;

    async fn from_request(request: Request, _state: &S) -> Result<Self, Problem> {
        let told = request
            .headers()
            .get(header::CONTENT_LENGTH)
            .and_then(|length| length.to_str().ok()?.parse().ok());
        let mut stream = request.into_body().into_data_stream();
        let mut bytes = Vec::new();
        while let Some(chunk) = stream.next().await {
            let chunk = chunk.map_err(|error| {
                Problem::new(
                    StatusCode::BAD_REQUEST,
                    "body_unreadable",
                    format!("the body broke off: {error}"),
                )
            })?;
            if bytes.len() + chunk.len() > MAX_BODY_BYTES {
                let seen = bytes.len() + chunk.len();
                drop(bytes);
                // The rest of a body may be too much to be counted.
                return Err(too_large(told.unwrap_or(0).max(seen + drain(stream).await)));
            }
            bytes.extend_from_slice(&chunk);
        }
        Ok(Self(bytes.into()))
    }
}

async fn drain(mut stream: axum::body::BodyDataStream) -> usize {
    let mut drained = 0;
    let reading = async {
        while let Some(Ok(chunk)) = stream.next().await {
            drained += chunk.len();
            if drained > DRAINED_BYTES {
                break;
            }
        }
    };
    // Running out of time only means that the client may see a closed connection.
    let _ = tokio::time::timeout(DRAIN_TIME, reading).await;
    drained
}

fn too_large(seen: usize) -> Problem {
    let text = format!("the body has {seen} bytes, must have at most {MAX_BODY_BYTES} bytes");
    Problem::new(StatusCode::PAYLOAD_TOO_LARGE, "body_too_large", text).at(
        "body",
        seen,
        format!("at most {MAX_BODY_BYTES} bytes"),
    )
}

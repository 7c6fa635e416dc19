//! Photos and poses of a run.

use axum::Json;
use axum::extract::State;
use axum::http::{HeaderValue, StatusCode, header};
use axum::response::{IntoResponse, Response};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde::Deserialize;
use utoipa::IntoParams;

use super::json_bytes;
use super::refusals::RunRefusals;
use super::run::{FoundRun, RunId};
use crate::api::executions::{photo_file, transforms as transforms_of};
use crate::api::extract::PathParam;
use crate::api::problem::{Problem, ProblemJson};
use crate::api::state::AppState;
use crate::api::wire::ExecutionImages;

/// Bound of the photos that are sent in one JSON document: what `POST /v1/plans` takes.
const MOST_IMAGES: usize = crate::plan::MAX_PHOTOS;

/// Which photo of a run.
#[derive(Clone, Copy, Debug, Deserialize, IntoParams)]
#[into_params(parameter_in = Path)]
pub struct ViewId {
    /// The view's id
    pub view: u32,
}

/// The photos of a run as base64 with their poses and camera: merged into a request, they are ready
/// for `POST /v1/plans`. At most five.
#[utoipa::path(
    get, path = "/v1/executions/{id}/images", tag = "executions", params(RunId),
    responses(
        (status = 200, description = "Photos in the order taken", body = ExecutionImages),
        RunRefusals,
        (status = 422, description = "More than five photos: fetch them one by one", body = ProblemJson, content_type = "application/problem+json"),
    )
)]
pub async fn list(
    State(app): State<AppState>,
    FoundRun { id, entry }: FoundRun,
) -> Result<Json<ExecutionImages>, Problem> {
    let record = entry.record();
    let count = record.execution.images.len();
    if count > MOST_IMAGES {
        let bound = format!("at most {MOST_IMAGES}; fetch /v1/executions/{id}/images/{{view}} one by one");
        return Err(Problem::field("image_count", "images", count, bound));
    }
    let mut images = Vec::with_capacity(count);
    for view in &record.execution.images {
        images.push(STANDARD.encode(read(&app, &id, *view).await?));
    }
    Ok(Json(ExecutionImages { images, image_poses: record.image_poses, camera: record.camera }))
}

/// The photo of one view, PNG.
#[utoipa::path(
    get, path = "/v1/executions/{id}/images/{view}", tag = "executions",
    params(RunId, ViewId),
    responses(
        (status = 200, description = "PNG", content_type = "image/png"),
        RunRefusals,
    )
)]
pub async fn get(
    State(app): State<AppState>,
    FoundRun { id, entry }: FoundRun,
    PathParam(ViewId { view }): PathParam<ViewId>,
) -> Result<Response, Problem> {
    let taken = entry.execution().images;
    if !taken.contains(&view) {
        let bound = format!("one of the views taken so far, {taken:?}");
        return Err(Problem::not_found("unknown_image", "view", &view.to_string(), bound));
    }
    let mut response = read(&app, &id, view).await?.into_response();
    response.headers_mut().insert(header::CONTENT_TYPE, HeaderValue::from_static("image/png"));
    Ok(response)
}

/// Cameras and poses of all photos taken so far as instant-ngp and nerfstudio read them.
#[utoipa::path(
    get, path = "/v1/executions/{id}/transforms.json", tag = "executions", params(RunId),
    responses(
        (status = 200, description = "transforms.json; file paths are relative to the run's directory", content_type = "application/json"),
        RunRefusals,
    )
)]
pub async fn transforms(
    State(app): State<AppState>,
    FoundRun { id, entry }: FoundRun,
) -> Result<Response, Problem> {
    match tokio::fs::read(app.executions.store().transforms(&id)).await {
        Ok(bytes) => return Ok(json_bytes(bytes)),
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => {}
        Err(error) => return Err(error.into()),
    }
    // A run under way, or one that was killed: its record knows every photo.
    let record = entry.record();
    match transforms_of(&record)? {
        Some(text) => Ok(json_bytes(text)),
        None => {
            let state = serde_json::to_value(record.execution.state).unwrap_or_default();
            Err(Problem::field("no_transforms", "state", state, "that of a run that has taken a photo")
                .with_status(StatusCode::NOT_FOUND))
        }
    }
}

async fn read(app: &AppState, id: &str, view: u32) -> Result<Vec<u8>, Problem> {
    match tokio::fs::read(app.executions.store().path(id).join(photo_file(view))).await {
        Ok(bytes) => Ok(bytes),
        // Deleted meanwhile.
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => {
            let bound = "a view whose photo is still there";
            Err(Problem::not_found("unknown_image", "view", &view.to_string(), bound))
        }
        Err(error) => Err(error.into()),
    }
}

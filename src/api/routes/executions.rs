//! `/v1/executions`: start, look, cancel, delete.

use axum::Json;
use axum::extract::{FromRequest, Request, State};
use axum::http::{HeaderValue, StatusCode, header};
use axum::response::{IntoResponse, Response};

use super::off_thread;
use super::refusals::{BodyRefusals, RunRefusals};
use super::run::{FoundRun, RunId, unknown};
use crate::api::extract::JsonBody;
use crate::api::problem::{Problem, ProblemJson};
use crate::api::state::AppState;
use crate::api::wire::{CreateExecution, ExecutionJson, ExecutionList};

/// Start a run of the simulated arm through a stored plan.
///
/// The arm follows the plan's trajectory, rests at each view and takes a photo from where its
/// joints put the camera. A plan without robot is flown by a free camera, with a warning.
#[utoipa::path(
    post, path = "/v1/executions", tag = "executions", request_body = CreateExecution,
    responses(
        (status = 202, description = "Queued", body = ExecutionJson),
        BodyRefusals,
        (status = 404, description = "No such plan", body = ProblemJson, content_type = "application/problem+json"),
    )
)]
pub async fn create(State(app): State<AppState>, request: Request) -> Result<Response, Problem> {
    let admission = app.heavy.admit()?;
    let JsonBody(json) = JsonBody::<CreateExecution>::from_request(request, &app).await?;
    let executions = app.executions.clone();
    let execution = app.heavy.run(admission, move || Ok(executions.start(&json)?.execution())).await?;
    let location = HeaderValue::from_str(&format!("/v1/executions/{}", execution.id));
    let mut response = (StatusCode::ACCEPTED, Json(execution)).into_response();
    if let Ok(location) = location {
        response.headers_mut().insert(header::LOCATION, location);
    }
    Ok(response)
}

/// Runs, also those of earlier lives of the service.
#[utoipa::path(get, path = "/v1/executions", tag = "executions", responses((status = 200, description = "Ids", body = ExecutionList)))]
pub async fn list(State(app): State<AppState>) -> Json<ExecutionList> {
    Json(ExecutionList { executions: app.executions.ids() })
}

/// State and progress of a run.
#[utoipa::path(
    get, path = "/v1/executions/{id}", tag = "executions", params(RunId),
    responses(
        (status = 200, description = "The run", body = ExecutionJson),
        RunRefusals,
    )
)]
pub async fn get(run: FoundRun) -> Json<ExecutionJson> {
    Json(run.entry.execution())
}

/// Stop a run: the arm stands still where it is, photos taken so far stay.
#[utoipa::path(
    post, path = "/v1/executions/{id}/cancel", tag = "executions", params(RunId),
    responses(
        (status = 202, description = "Asked to stop", body = ExecutionJson),
        RunRefusals,
        (status = 409, description = "It is over", body = ProblemJson, content_type = "application/problem+json"),
    )
)]
pub async fn cancel(
    State(app): State<AppState>,
    run: FoundRun,
) -> Result<(StatusCode, Json<ExecutionJson>), Problem> {
    let cancel = move || app.executions.cancel(&run.entry).map(|()| run.entry.execution());
    let execution = off_thread(cancel).await?;
    Ok((StatusCode::ACCEPTED, Json(execution)))
}

/// Delete a run that is over, with its photos.
#[utoipa::path(
    delete, path = "/v1/executions/{id}", tag = "executions", params(RunId),
    responses(
        (status = 204, description = "Gone"),
        RunRefusals,
        (status = 409, description = "It is not over: cancel it first", body = ProblemJson, content_type = "application/problem+json"),
    )
)]
pub async fn delete(State(app): State<AppState>, run: FoundRun) -> Result<StatusCode, Problem> {
    let FoundRun { id, .. } = run;
    let work = move || match app.executions.delete(&id)? {
        true => Ok(StatusCode::NO_CONTENT),
        false => Err(unknown(&id)),
    };
    off_thread(work).await
}

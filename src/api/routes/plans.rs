//! `/v1/plans`.

use axum::Json;
use axum::extract::{FromRequest, Request, State};
use axum::http::{HeaderValue, StatusCode, header};
use axum::response::Response;

use super::refusals::BodyRefusals;
use super::{json_bytes, off_thread};
use crate::api::extract::{JsonBody, PathParam};
use crate::api::planner::ResolvedRequest;
use crate::api::problem::{Problem, ProblemJson};
use crate::api::state::AppState;
use crate::api::wire::{PlanAnswer, PlanList, PlanRequestJson};
use crate::motion::Stop;

/// Plan views, order and motion.
///
/// The same request gives the same plan: it is computed once and stored under a hash of what the
/// request means, the service's version and the model. Defaults that are spelt out, 1 for 1.0 or the
/// order of members make no other request. 201 for a new plan, 200 for a stored one.
#[utoipa::path(
    post, path = "/v1/plans", tag = "plans", request_body = PlanRequestJson,
    responses(
        (status = 201, description = "Computed and stored", body = PlanAnswer),
        (status = 200, description = "Stored before; the same bytes", body = PlanAnswer),
        BodyRefusals,
    )
)]
pub async fn create(State(app): State<AppState>, request: Request) -> Result<Response, Problem> {
    let admission = app.heavy.admit()?;
    let JsonBody(json) = JsonBody::<PlanRequestJson>::from_request(request, &app).await?;
    let (planner, plans) = (app.planner.clone(), app.plans.clone());
    let work = move |stop: &Stop| -> Result<(String, Vec<u8>, bool), Problem> {
        let request = ResolvedRequest::from(json);
        let id = planner.plan_id(&request)?;
        if let Some(stored) = plans.answer(&id)? {
            return Ok((id, stored, false));
        }
        let answer = planner.plan_until(&request, stop)?;
        let encode = |e: serde_json::Error| Problem::internal(e.to_string());
        let bytes = serde_json::to_vec(&answer).map_err(encode)?;
        let cell = serde_json::to_vec(&request.without_images()).map_err(encode)?;
        let (stored, new) = plans.put(&id, bytes, &cell)?;
        Ok((id, stored, new))
    };
    let (id, bytes, new) = app.heavy.run_within(admission, app.config.request_timeout, work).await?;
    let mut response = json_bytes(bytes);
    if new {
        *response.status_mut() = StatusCode::CREATED;
    }
    if let Ok(location) = HeaderValue::from_str(&format!("/v1/plans/{id}")) {
        response.headers_mut().insert(header::LOCATION, location);
    }
    Ok(response)
}

/// Stored plans.
#[utoipa::path(get, path = "/v1/plans", tag = "plans", responses((status = 200, description = "Ids", body = PlanList)))]
pub async fn list(State(app): State<AppState>) -> Result<Json<PlanList>, Problem> {
    off_thread(move || Ok(Json(PlanList { plans: app.plans.ids()? }))).await
}

/// A stored plan, byte for byte as it was answered.
#[utoipa::path(
    get, path = "/v1/plans/{id}", tag = "plans", params(("id" = String, Path, description = "The plan's id")),
    responses(
        (status = 200, description = "The plan", body = PlanAnswer),
        (status = 404, description = "No such plan", body = ProblemJson, content_type = "application/problem+json"),
    )
)]
pub async fn get(State(app): State<AppState>, PathParam(id): PathParam<String>) -> Result<Response, Problem> {
    let (plans, wanted) = (app.plans, id.clone());
    match off_thread(move || Ok(plans.answer(&wanted)?)).await? {
        Some(bytes) => Ok(json_bytes(bytes)),
        None => Err(unknown(&id)),
    }
}

/// The request of a stored plan in its canonical form, without its photos.
#[utoipa::path(
    get, path = "/v1/plans/{id}/request", tag = "plans", params(("id" = String, Path, description = "The plan's id")),
    responses(
        (status = 200, description = "The request", body = PlanRequestJson),
        (status = 404, description = "No such plan", body = ProblemJson, content_type = "application/problem+json"),
    )
)]
pub async fn request(
    State(app): State<AppState>,
    PathParam(id): PathParam<String>,
) -> Result<Response, Problem> {
    let (plans, wanted) = (app.plans, id.clone());
    match off_thread(move || Ok(plans.request(&wanted)?)).await? {
        Some(bytes) => Ok(json_bytes(bytes)),
        None => Err(unknown(&id)),
    }
}

/// Delete a stored plan.
///
/// Runs that have followed it keep their photos and poses; one that still waits for an arm needs the plan.
#[utoipa::path(
    delete, path = "/v1/plans/{id}", tag = "plans", params(("id" = String, Path, description = "The plan's id")),
    responses(
        (status = 204, description = "Gone"),
        (status = 404, description = "No such plan", body = ProblemJson, content_type = "application/problem+json"),
        (status = 409, description = "Runs wait for an arm to follow it; bound names them", body = ProblemJson, content_type = "application/problem+json"),
    )
)]
pub async fn delete(
    State(app): State<AppState>,
    PathParam(id): PathParam<String>,
) -> Result<StatusCode, Problem> {
    let work = move || {
        let waiting = app.executions.waiting_for_plan(&id);
        if !waiting.is_empty() {
            let bound = format!("a plan that no run waits for: cancel {} first", waiting.join(", "));
            return Err(Problem::field("plan_in_use", "id", id, bound).with_status(StatusCode::CONFLICT));
        }
        if app.plans.delete(&id)? { Ok(StatusCode::NO_CONTENT) } else { Err(unknown(&id)) }
    };
    off_thread(work).await
}

fn unknown(id: &str) -> Problem {
    Problem::not_found("unknown_plan", "id", id, "the id of a stored plan")
}

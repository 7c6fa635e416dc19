//! `/livez` and `/readyz`.

use axum::Json;
use axum::extract::State;
use serde::Serialize;
use utoipa::ToSchema;

use super::off_thread;
use crate::api::problem::{Problem, ProblemJson};
use crate::api::state::AppState;
use crate::files::replace;

/// What works.
#[derive(Clone, Debug, Serialize, ToSchema)]
pub struct Health {
    /// `ok`.
    pub status: &'static str,
    /// The service's version.
    pub version: &'static str,
    /// SHA-256 of the prediction model, `none` without one.
    pub model: String,
}

/// The process answers.
#[utoipa::path(get, path = "/livez", tag = "health", responses((status = 200, description = "Alive", body = Health)))]
pub async fn live(State(app): State<AppState>) -> Json<Health> {
    Json(health(&app))
}

/// Every request can be served: the data directory can be written and the prediction model is
/// loaded.
#[utoipa::path(
    get, path = "/readyz", tag = "health",
    responses(
        (status = 200, description = "Ready", body = Health),
        (status = 503, description = "Something is missing; detail names every cause", body = ProblemJson, content_type = "application/problem+json"),
    )
)]
pub async fn ready(State(app): State<AppState>) -> Result<Json<Health>, Problem> {
    let mut causes = Vec::new();
    if let Some(cause) = app.planner.missing() {
        causes.push(format!("predictions: {cause}"));
    }
    let probe = app.config.data_dir.join(".ready");
    if let Err(error) = off_thread(move || Ok(replace(&probe, b"")?)).await.map_err(|p| p.detail.clone()) {
        causes.push(error);
    }
    if causes.is_empty() {
        return Ok(Json(health(&app)));
    }
    Err(Problem::unavailable("not_ready", causes.join("; "), None))
}

fn health(app: &AppState) -> Health {
    Health { status: "ok", version: env!("CARGO_PKG_VERSION"), model: app.planner.model_hash().to_owned() }
}

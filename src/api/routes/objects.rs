//! `/v1/objects`.

use axum::Json;

use crate::api::wire::ObjectSummary;
use crate::render::sample_names;

/// Sample objects for the simulator.
#[utoipa::path(get, path = "/v1/objects", tag = "executions", responses((status = 200, description = "Names", body = [ObjectSummary])))]
pub async fn list() -> Json<Vec<ObjectSummary>> {
    Json(sample_names().iter().map(|name| ObjectSummary { sample: (*name).to_owned() }).collect())
}

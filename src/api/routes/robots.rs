//! `/v1/robots`.

use axum::Json;

use crate::api::convert;
use crate::api::extract::PathParam;
use crate::api::problem::{Problem, ProblemJson};
use crate::api::wire::{RobotDetails, RobotSummary};
use crate::robot::RobotModel;

/// The robots known by name.
#[utoipa::path(get, path = "/v1/robots", tag = "robots", responses((status = 200, description = "Names", body = [RobotSummary])))]
pub async fn list() -> Json<Vec<RobotSummary>> {
    Json(convert::robot_summaries())
}

/// One robot's numbers and their sources.
#[utoipa::path(
    get, path = "/v1/robots/{model}", tag = "robots", params(("model" = String, Path, description = "A name of the list")),
    responses(
        (status = 200, description = "Joints, limits, sources", body = RobotDetails),
        (status = 404, description = "No such robot", body = ProblemJson, content_type = "application/problem+json"),
    )
)]
pub async fn get(PathParam(model): PathParam<String>) -> Result<Json<RobotDetails>, Problem> {
    let found = RobotModel::named(&model).map_err(|_| {
        let known = RobotModel::names().join(", ");
        Problem::not_found("unknown_robot", "model", &model, format!("one of {known}"))
    })?;
    Ok(Json(convert::robot_details(&found)))
}

//! `/v1/reachability`.

use axum::Json;
use axum::extract::{FromRequest, Request, State};
use serde::Deserialize;
use utoipa::IntoParams;

use super::refusals::BodyRefusals;
use crate::api::extract::{JsonBody, QueryParams};
use crate::api::planner::reachability_of;
use crate::api::problem::Problem;
use crate::api::state::AppState;
use crate::api::wire::{PlanRequestJson, ReachabilityAnswer};
use crate::motion::Stop;

/// Resolution of the grid.
#[derive(Clone, Copy, Debug, Deserialize, IntoParams)]
#[serde(deny_unknown_fields)]
#[into_params(parameter_in = Query)]
pub struct ReachabilityQuery {
    /// Rows of the grid, 1 to 90; 17 when left out (6 for arms of numeric kinematics).
    pub elevations: Option<u32>,
    /// Columns of the grid, 1 to 360; 36 when left out (12 for arms of numeric kinematics). A grid has
    /// at most 16,200 cells, 648 for arms of numeric kinematics.
    pub azimuths: Option<u32>,
}

/// Which part of the band of views the arm can reach.
///
/// The body is that of `POST /v1/plans`, with `robot` and `object`; what it says about the number
/// of views, their order, the motion's time and views out of reach does not matter.
#[utoipa::path(
    post, path = "/v1/reachability", tag = "views", request_body = PlanRequestJson, params(ReachabilityQuery),
    responses(
        (status = 200, description = "The band in rows and columns, and better places for the object", body = ReachabilityAnswer),
        BodyRefusals,
    )
)]
pub async fn create(
    State(app): State<AppState>,
    QueryParams(query): QueryParams<ReachabilityQuery>,
    request: Request,
) -> Result<Json<ReachabilityAnswer>, Problem> {
    let admission = app.heavy.admit()?;
    let JsonBody(json) = JsonBody::<PlanRequestJson>::from_request(request, &app).await?;
    let work = move |stop: &Stop| {
        let [rows, columns] = [query.elevations, query.azimuths].map(|count| count.map(|n| n as usize));
        reachability_of(&json, rows, columns, stop)
    };
    app.heavy.run_while_awaited(admission, work).await.map(Json)
}

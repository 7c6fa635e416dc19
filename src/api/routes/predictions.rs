//! `/v1/predictions`.

use axum::Json;
use axum::extract::{FromRequest, Request, State};

use super::refusals::BodyRefusals;
use crate::api::extract::JsonBody;
use crate::api::problem::Problem;
use crate::api::state::AppState;
use crate::api::wire::{PredictionAnswer, PredictionRequest};

/// Predict the number of views that an object's reconstruction needs, from one to five photos.
#[utoipa::path(
    post, path = "/v1/predictions", tag = "plans", request_body = PredictionRequest,
    responses(
        (status = 200, description = "The number, and the poses from which the photos are expected", body = PredictionAnswer),
        BodyRefusals,
    )
)]
pub async fn create(
    State(app): State<AppState>,
    request: Request,
) -> Result<Json<PredictionAnswer>, Problem> {
    let admission = app.heavy.admit()?;
    let JsonBody(json) = JsonBody::<PredictionRequest>::from_request(request, &app).await?;
    let planner = app.planner.clone();
    app.heavy.run(admission, move || planner.predict(&json)).await.map(Json)
}

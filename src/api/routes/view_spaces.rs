//! `/v1/view-spaces/{n}`.

use axum::Json;
use axum::extract::State;
use serde::Deserialize;
use utoipa::IntoParams;

use crate::api::convert;
use crate::api::extract::{PathParam, QueryParams};
use crate::api::problem::{Problem, ProblemJson};
use crate::api::state::AppState;
use crate::api::wire::{ViewSpaceAnswer, ViewSpaceJson, ViewSpaceView};
use crate::geometry::{Point, azimuth_elevation_from_direction};
use crate::views::{ViewSpace, ViewsError, best_known_rad, tammes};

/// The shell and band of the set.
#[derive(Clone, Copy, Debug, Deserialize, IntoParams)]
#[serde(deny_unknown_fields)]
#[into_params(parameter_in = Query)]
pub struct ViewSpaceQuery {
    /// Lowest elevation in degrees; 5 when left out.
    pub min_elevation_deg: Option<f64>,
    /// Highest elevation in degrees; 90 when left out.
    pub max_elevation_deg: Option<f64>,
    /// Distance from the object's centre in metres; 0.3 when left out.
    pub radius: Option<f64>,
}

/// The set of `n` well separated views (a pole-fixed Tammes packing of the band).
#[utoipa::path(
    get, path = "/v1/view-spaces/{n}", tag = "views",
    params(("n" = u32, Path, description = "Number of views, 1 to 200"), ViewSpaceQuery),
    responses(
        (status = 200, description = "Directions and poses for an object at the origin", body = ViewSpaceAnswer),
        (status = 422, description = "A parameter is refused", body = ProblemJson, content_type = "application/problem+json"),
    )
)]
pub async fn get(
    State(app): State<AppState>,
    PathParam(n): PathParam<u32>,
    QueryParams(query): QueryParams<ViewSpaceQuery>,
) -> Result<Json<ViewSpaceAnswer>, Problem> {
    let default = ViewSpaceJson::default();
    let json = ViewSpaceJson {
        radius: query.radius.unwrap_or(default.radius),
        min_elevation_deg: query.min_elevation_deg.unwrap_or(default.min_elevation_deg),
        max_elevation_deg: query.max_elevation_deg.unwrap_or(default.max_elevation_deg),
    };
    let admission = app.heavy.admit()?;
    // Bands without a table are computed, for up to seconds.
    app.heavy.run(admission, move || view_space(n, json)).await.map(Json)
}

fn view_space(n: u32, json: ViewSpaceJson) -> Result<ViewSpaceAnswer, Problem> {
    // Here the members are parameters.
    let named = |problem: Problem| problem.rename(|field| field.trim_start_matches("view_space.").to_owned());
    let shell = convert::shell(&json).map_err(named)?;
    let space = ViewSpace { center_in_base: Point::origin(), radius_m: shell.radius_m, band: shell.band };
    space.validate().map_err(|error| named(error.into()))?;
    let set = tammes(n as usize, space.band).map_err(|error| match error {
        ViewsError::Count { count, min, max } => {
            Problem::field("out_of_range", "n", count, format!("from {min} to {max}"))
        }
        other => named(other.into()),
    })?;
    let view = |(id, direction): (usize, &crate::geometry::Direction)| {
        let (azimuth_rad, elevation_rad) = azimuth_elevation_from_direction(direction);
        ViewSpaceView {
            id: id as u32,
            direction: [direction.x, direction.y, direction.z],
            azimuth_deg: azimuth_rad.to_degrees(),
            elevation_deg: elevation_rad.to_degrees(),
            pose: convert::pose_json(&space.pose(direction, 0.0)),
        }
    };
    Ok(ViewSpaceAnswer {
        n,
        view_space: json,
        separation_deg: set.separation_rad.to_degrees(),
        best_known_deg: best_known_rad(set.directions.len(), space.band).map(f64::to_degrees),
        views: set.directions.iter().enumerate().map(view).collect(),
    })
}

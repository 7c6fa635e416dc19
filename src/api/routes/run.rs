//! The run that a path names.

use std::sync::Arc;

use axum::extract::FromRequestParts;
use axum::http::request::Parts;
use serde::Deserialize;
use utoipa::IntoParams;

use crate::api::executions::Entry;
use crate::api::extract::PathParam;
use crate::api::problem::Problem;
use crate::api::state::AppState;

/// The parameter of every route about a run.
#[derive(Clone, Debug, Deserialize, IntoParams)]
#[into_params(parameter_in = Path)]
pub struct RunId {
    /// The run's id
    pub id: String,
}

/// The run with the path's id; 404 where there is none.
pub struct FoundRun {
    /// Its id.
    pub id: String,
    /// The run.
    pub entry: Arc<Entry>,
}

impl FromRequestParts<AppState> for FoundRun {
    type Rejection = Problem;

    async fn from_request_parts(parts: &mut Parts, app: &AppState) -> Result<Self, Problem> {
        let PathParam(RunId { id }) = PathParam::from_request_parts(parts, app).await?;
        match app.executions.get(&id) {
            Some(entry) => Ok(Self { id, entry }),
            None => Err(unknown(&id)),
        }
    }
}

/// 404: there is no such run.
pub fn unknown(id: &str) -> Problem {
    Problem::not_found("unknown_execution", "id", id, "the id of a run")
}

//! `/v1/checks`.

use axum::Json;
use axum::extract::{FromRequest, Request, State};

use super::refusals::BodyRefusals;
use crate::api::checker::check_plan;
use crate::api::extract::{JsonBody, parse_json};
use crate::api::problem::{Problem, ProblemJson};
use crate::api::state::AppState;
use crate::api::store::PlanStore;
use crate::api::wire::{CheckAnswer, CheckedPlanJson, CreateCheck, PlanRequestJson};
use crate::motion::Stop;

/// Check a plan, whoever wrote or changed it.
///
/// The check shares no code with the planner but forward kinematics and the request's numbers:
/// limits, times, view poses and continuous collisions are judged from the trajectory's points
/// alone. A plan with violations is an answer (`sound` is false), not an error.
#[utoipa::path(
    post, path = "/v1/checks", tag = "plans", request_body = CreateCheck,
    responses(
        (status = 200, description = "The verdict", body = CheckAnswer),
        BodyRefusals,
        (status = 404, description = "No such plan", body = ProblemJson, content_type = "application/problem+json"),
    )
)]
pub async fn create(State(app): State<AppState>, request: Request) -> Result<Json<CheckAnswer>, Problem> {
    let admission = app.heavy.admit()?;
    let JsonBody(json) = JsonBody::<CreateCheck>::from_request(request, &app).await?;
    let plans = app.plans.clone();
    let work = move |stop: &Stop| match (json.plan_id, json.request, json.plan) {
        (Some(id), None, None) => {
            let (request, plan) = stored(&plans, &id)?;
            check_plan(request, plan, stop)
        }
        (None, Some(request), Some(plan)) => check_plan(request, plan, stop).map_err(in_pair),
        (id, request, plan) => {
            let given = [("plan_id", id.is_some()), ("request", request.is_some()), ("plan", plan.is_some())];
            let names: Vec<&str> = given.iter().filter(|(_, g)| *g).map(|(name, _)| *name).collect();
            let value = if names.is_empty() { "none of them".to_owned() } else { names.join(" and ") };
            let bound = "either plan_id, or request and plan";
            Err(Problem::field("check_source", "body", value, bound))
        }
    };
    app.heavy.run_while_awaited(admission, work).await.map(Json)
}

/// The members of the request are those of `request` here.
fn in_pair(problem: Problem) -> Problem {
    problem.rename(
        |field| if field.starts_with("plan.") { field.to_owned() } else { format!("request.{field}") },
    )
}

fn stored(plans: &PlanStore, id: &str) -> Result<(PlanRequestJson, CheckedPlanJson), Problem> {
    let (Some(answer), Some(request)) = (plans.answer(id)?, plans.request(id)?) else {
        return Err(Problem::not_found("unknown_plan", "plan_id", id, "the id of a stored plan"));
    };
    let broken = |problem: Problem| Problem::internal(format!("stored plan {id}: {}", problem.detail));
    Ok((parse_json(&request).map_err(broken)?, parse_json(&answer).map_err(broken)?))
}

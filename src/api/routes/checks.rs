//! `/v1/checks`.

use axum::Json;
use axum::extract::{FromRequest, Request, State};

use crate::api::checker::check_plan;
use crate::api::extract::{JsonBody, parse_json};
use crate::api::problem::{Problem, ProblemJson};
use crate::api::state::AppState;
use crate::api::store::PlanStore;
use crate::api::wire::{CheckAnswer, CheckedPlanJson, CreateCheck, PlanRequestJson};

/// Check a plan, whoever wrote or changed it.
///
/// The check shares no code with the planner but forward kinematics and the request's numbers:
/// limits, times, view poses and continuous collisions are judged from the trajectory's points
/// alone. A plan with violations is an answer (`sound` is false), not an error.
#[utoipa::path(
    post, path = "/v1/checks", tag = "plans", request_body = CreateCheck,
    responses(
        (status = 200, description = "The verdict", body = CheckAnswer),
        (status = 404, description = "No such plan", body = ProblemJson, content_type = "application/problem+json"),
        (status = 422, description = "A member is refused: field, value and bound tell", body = ProblemJson, content_type = "application/problem+json"),
        (status = 503, description = "Overloaded", body = ProblemJson, content_type = "application/problem+json"),
    )
)]
pub async fn create(State(app): State<AppState>, request: Request) -> Result<Json<CheckAnswer>, Problem> {
    let admission = app.heavy.admit()?;
    let JsonBody(json) = JsonBody::<CreateCheck>::from_request(request, &app).await?;
    let plans = app.plans.clone();
    let work = move || {
        let (request, plan) = match (json.plan_id, json.request, json.plan) {
            (Some(id), None, None) => stored(&plans, &id)?,
            (None, Some(request), Some(plan)) => (request, plan),
            (id, request, plan) => {
                let given =
                    [("plan_id", id.is_some()), ("request", request.is_some()), ("plan", plan.is_some())];
                let names: Vec<&str> = given.iter().filter(|(_, g)| *g).map(|(name, _)| *name).collect();
                let bound = "either plan_id, or request and plan";
                return Err(Problem::field("check_source", "body", names.join(" and "), bound));
            }
        };
        check_plan(request, plan)
    };
    app.heavy.run(admission, work).await.map(Json)
}

fn stored(plans: &PlanStore, id: &str) -> Result<(PlanRequestJson, CheckedPlanJson), Problem> {
    let (Some(answer), Some(request)) = (plans.answer(id)?, plans.request(id)?) else {
        return Err(Problem::not_found("unknown_plan", "plan_id", id, "the id of a stored plan"));
    };
    let broken = |problem: Problem| Problem::internal(format!("stored plan {id}: {}", problem.detail));
    Ok((parse_json(&request).map_err(broken)?, parse_json(&answer).map_err(broken)?))
}

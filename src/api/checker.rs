//! Checks of plans, the same for the service and the command line.

use super::convert;
use super::problem::Problem;
use super::wire::{CheckAnswer, CheckedPlanJson, PlanRequestJson};
use crate::motion::Stop;
use crate::plan::{self, verify_until};

/// Judges `plan` as an answer to `request`; no verdict once `stop` is asked for.
///
/// # Errors
/// 422 for a request whose numbers are out of their bounds and a plan that cannot be read.
pub fn check_plan(
    request: PlanRequestJson,
    plan: CheckedPlanJson,
    stop: &Stop,
) -> Result<CheckAnswer, Problem> {
    let claimed = convert::claimed_plan(plan)?;
    // Photos decide the number of views and nothing else of a plan; its own number stands for them.
    let mut json = request;
    if json.view_count.is_none() && json.views.is_none() {
        (json.images, json.image_poses) = (None, None);
        json.view_count = Some(claimed.views.len() as u32);
    }
    let request = convert::plan_request(&json)?;
    plan::check(&request)?;
    Ok(convert::check_answer(&request, &claimed, verify_until(&request, &claimed, stop)))
}

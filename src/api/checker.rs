//! Checks of plans, the same for the service and the command line.

use super::convert;
use super::problem::Problem;
use super::wire::{CheckAnswer, CheckedPlanJson, PlanRequestJson};
use crate::plan::{self, verify};

/// Judges `plan` as an answer to `request`.
///
/// # Errors
/// 422 for a request whose numbers are out of their bounds and a plan that cannot be read.
pub fn check_plan(request: PlanRequestJson, plan: CheckedPlanJson) -> Result<CheckAnswer, Problem> {
    let claimed = convert::claimed_plan(plan)?;
    // Photos decide the number of views and nothing else of a plan; its own number stands for them.
    let from_photos = request.images.is_some() || (request.view_count.is_none() && request.views.is_none());
    let mut json = PlanRequestJson { images: None, image_poses: None, ..request };
    if from_photos {
        json.view_count = Some(claimed.views.len() as u32);
    }
    let request = convert::plan_request(&json)?;
    plan::check(&request)?;
    Ok(convert::check_answer(&request, &claimed, verify(&request, &claimed)))
}

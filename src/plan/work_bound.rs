//! Requests that would take too long are refused where their numbers alone tell it.

use super::{Arm, PlanError, PlanRequest, ViewSource};
use crate::motion::{Allowance, Roll, inverse_work};

/// Part of a plan's work that may go into looking at states with nothing near.
const SHARE: f64 = 0.5;
/// Branches of the inverse kinematics, about.
const STATES: u64 = 8;
/// Views of a plan from photos.
const PREDICTED: usize = 58;

/// Work of looking once at every state that takes one pose at one roll, with nothing near: the
/// inverse kinematics, and a bound for every solid of the arm and every region.
pub(super) fn work_of_pose(request: &PlanRequest, arm: &Arm) -> u64 {
    let around = &arm.surroundings;
    let links: usize = arm.model.links.iter().map(|link| link.shapes.len()).sum();
    let solids = links + around.camera_body.as_ref().map_or(2, Vec::len) + around.tool.len();
    let regions = around.keep_out.len() + usize::from(request.object.is_some()) + 1;
    inverse_work(arm.model.kinematics.as_ref()) + STATES * (solids * regions) as u64
}

/// Checks that every view can be looked at, at every roll.
///
/// # Errors
/// `too_much_work`, naming the rolls, which no number of views can do without.
pub(super) fn check(request: &PlanRequest, arm: &Arm) -> Result<(), PlanError> {
    let views = match &request.source {
        ViewSource::Count(count) => *count,
        ViewSource::Initial { .. } => return Ok(()),
        ViewSource::Photos(_) => PREDICTED,
    };
    of_poses(request, arm, views, "views")
}

/// The same for `poses` poses, called `what`.
pub(super) fn of_poses(request: &PlanRequest, arm: &Arm, poses: usize, what: &str) -> Result<(), PlanError> {
    let rolls = arm.roll.rolls_rad().len();
    let most = (SHARE * Allowance::PLAN as f64) as u64;
    let each = work_of_pose(request, arm).saturating_mul(poses as u64);
    if each.saturating_mul(rolls as u64) <= most {
        return Ok(());
    }
    let fit = (most / each.max(1)).max(1);
    let bound = format!(
        "at most {fit} for {poses} {what} of this arm among {} keep-out regions with {} solids on its flange \
         (roll free has {rolls_of_free})",
        arm.surroundings.keep_out.len(),
        arm.surroundings.tool.len() + arm.surroundings.camera_body.as_ref().map_or(2, Vec::len),
        rolls_of_free = Roll::FREE.rolls_rad().len(),
    );
    Err(PlanError::number("too_much_work", "roll_samples", rolls as f64, bound))
}

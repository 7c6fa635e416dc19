//! An independent judge of motions.
//!
//! Nothing of the planner is used here but its types: forward kinematics and
//! the request's own numbers, parry for every distance, levers of its own,
//! finite differences instead of formulas. It needs no more than what a plan's
//! JSON holds, since a controller may have changed the trajectory.

mod findings;
mod levers;
mod pairs;
mod passage;
mod solids;
mod time_law;
mod views;
mod violation;

use super::cell::Cell;
use super::plan::{MotionPlan, TrajectoryPoint, ViewOutcome};
use super::request::{MotionRequest, Roll, Timing};
use super::work::Stop;
use crate::geometry::Pose;
use findings::Findings;
use passage::Passage;
pub use passage::UNDERCUT_BOUND_M;
#[cfg(test)]
pub(super) use passage::sampled_excess_m;
pub use violation::Violation;

/// Most violations listed of one code: a hundred of a kind would hide the others.
pub const MOST_OF_A_KIND: usize = 10;

/// A view as a motion claims to take it.
#[derive(Clone, Copy, Debug)]
pub struct ClaimedView {
    /// `base_from_camera`.
    pub base_from_camera: Pose,
    /// Whether the motion visits it.
    pub planned: bool,
}

/// A motion and what it claims to be.
#[derive(Clone, Copy, Debug)]
pub struct Claim<'a> {
    /// The cell.
    pub cell: &'a Cell,
    /// Joint state before the motion, radians; one on its limit may have been up to
    /// [`crate::robot::START_TOLERANCE_RAD`] outside.
    pub start: Option<&'a [f64]>,
    /// Whether the turn about the optical axis is free.
    pub roll: Roll,
    /// What the motion's timing was to be.
    pub timing: Timing,
    /// The views.
    pub views: &'a [ClaimedView],
    /// The visited ones in order, indices into `views`.
    pub order: &'a [usize],
    /// The motion.
    pub trajectory: &'a [TrajectoryPoint],
    /// Ends the check, which then is no verdict; `None` where nobody may.
    pub stop: Option<&'a Stop>,
}

/// The two parts that come nearest to each other, and when.
#[derive(Clone, Debug, PartialEq)]
pub struct Nearest {
    /// Signed distance, metres.
    pub distance_m: f64,
    /// A link, the camera or the tool.
    pub first: String,
    /// What it is near to.
    pub second: String,
    /// Seconds.
    pub time_s: f64,
}

/// What was looked at, and its extremes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Looked {
    /// Joint states at which distances were taken.
    pub states: usize,
    /// Smallest distance to object, table and keep-out regions.
    pub nearest: Option<Nearest>,
    /// Smallest distance between parts of the arm.
    pub nearest_self: Option<Nearest>,
    /// Largest share of a joint's scaled speed limit.
    pub speed_share: f64,
    /// Largest share of a joint's scaled acceleration limit, from differences of speeds.
    pub acceleration_share: f64,
    /// Largest share of a joint's scaled jerk limit, from differences of accelerations; 0 where
    /// jerk is not bounded.
    pub jerk_share: f64,
    /// Largest distance of a camera from its view's pose, metres.
    pub pose_error_m: f64,
    /// Largest angle of a camera to its view's pose, radians.
    pub pose_error_rad: f64,
}

/// A verdict.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Verdict {
    /// What is wrong, at most ten entries of a kind; empty for a sound motion.
    pub violations: Vec<Violation>,
    /// What was looked at.
    pub looked: Looked,
}

/// Everything that is wrong with a motion.
///
/// Positions are interpolated by cubic splines between points. No pair of parts comes nearer than
/// its margin less a millimetre anywhere on them: between two looked-at states levers bound how
/// far joints can carry a part, and the time between is halved until that decides. Until the first
/// view a margin may be undercut by as much as the start state undercuts it.
pub fn check_claim(claim: &Claim) -> Verdict {
    let mut findings = Findings::default();
    let well_formed = time_law::judge(claim, &mut findings);
    views::judge(claim, well_formed, &mut findings);
    if well_formed {
        Passage::new(claim.cell).judge(claim.trajectory, claim.stop, &mut findings);
    }
    findings.verdict
}

/// Everything that is wrong with `plan` as an answer to `request`; see [`check_claim`].
pub fn check(request: &MotionRequest, plan: &MotionPlan) -> Vec<Violation> {
    let views: Vec<ClaimedView> = request
        .views
        .iter()
        .enumerate()
        .map(|(i, pose)| ClaimedView {
            base_from_camera: *pose,
            planned: matches!(plan.views.get(i), Some(ViewOutcome::Planned(_))),
        })
        .collect();
    let claim = Claim {
        cell: request.cell,
        start: request.start,
        roll: request.roll,
        timing: request.timing,
        views: &views,
        order: &plan.order,
        trajectory: &plan.trajectory,
        stop: None,
    };
    check_claim(&claim).violations
}

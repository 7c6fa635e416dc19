//! An independent judge of plans.
//!
//! Nothing of the planner is used here but its types: forward kinematics and
//! the request's own numbers, parry for every distance, dense samples instead
//! of bounds, finite differences instead of formulas.

mod solids;
mod time_law;
mod views;

use super::plan::MotionPlan;
use super::request::MotionRequest;
use solids::Solids;

/// Something wrong with a plan.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Violation {
    /// A point's vectors have the wrong length, or hold a NaN or infinity.
    #[error("point {point}: malformed")]
    Malformed {
        /// Index of the point.
        point: usize,
    },
    /// Time does not increase.
    #[error("point {point}: time {time_s} s is not after the one before")]
    Time {
        /// Index of the point.
        point: usize,
        /// Its time.
        time_s: f64,
    },
    /// A joint beyond its position, speed or acceleration limit.
    #[error("point {point}: {quantity} of joint {joint} is {value}, its limit {limit}")]
    Limit {
        /// Index of the point.
        point: usize,
        /// What is beyond.
        quantity: &'static str,
        /// Index of the joint.
        joint: usize,
        /// Its value, rad, rad/s or rad/s2.
        value: f64,
        /// The limit.
        limit: f64,
    },
    /// Positions do not follow from velocities.
    #[error("point {point}: joint {joint} jumps by {jump_rad} rad")]
    Jump {
        /// Index of the point.
        point: usize,
        /// Index of the joint.
        joint: usize,
        /// Difference to the motion its velocities give, radians.
        jump_rad: f64,
    },
    /// The motion does not begin at the start state.
    #[error("the motion does not begin at the start state")]
    Start,
    /// A planned view is not visited as it should be.
    #[error("view {view}: {problem}")]
    View {
        /// Index of the view.
        view: usize,
        /// What is wrong.
        problem: &'static str,
    },
    /// The camera is not where a view wants it.
    #[error("view {view}: camera is {position_m} m and {rotation_rad} rad off")]
    PoseError {
        /// Index of the view.
        view: usize,
        /// Distance, metres.
        position_m: f64,
        /// Angle, radians.
        rotation_rad: f64,
    },
    /// Two bodies come too near.
    #[error("{time_s:.3} s: {first} and {second} are {distance_m:.4} m apart, margin {margin_m:.4} m")]
    TooNear {
        /// Time, seconds.
        time_s: f64,
        /// A link or the camera.
        first: String,
        /// What it comes too near to.
        second: String,
        /// Their distance, metres; negative when they overlap.
        distance_m: f64,
        /// The margin asked for.
        margin_m: f64,
    },
}

/// Most violations listed.
const MOST_VIOLATIONS: usize = 100;

/// Everything that is wrong with `plan` as an answer to `request`; empty for a sound plan.
///
/// Positions are interpolated by cubic splines between points and looked at
/// every 0.02 rad; margins may be undercut by a millimetre, and until the
/// first view by as much as the start state undercuts them.
pub fn check(request: &MotionRequest, plan: &MotionPlan) -> Vec<Violation> {
    let mut violations = Vec::new();
    let well_formed = time_law::judge(request, plan, &mut violations);
    views::judge(request, plan, &mut violations);
    if well_formed {
        Solids::new(request.cell).judge(plan, &mut violations);
    }
    violations.truncate(MOST_VIOLATIONS);
    violations
}

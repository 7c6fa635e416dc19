//! The arm in its cell: from camera poses to a timed, collision-free joint motion.
//!
//! [`plan_motion`] finds the joint states that take each view, chooses among
//! them for all views together, connects them by checked legs and times the
//! whole. [`check`] judges a plan by code of its own. All frames are relative
//! to the arm's base; metres, radians, seconds.

mod along_path;
mod bodies;
mod broad;
mod candidates;
mod cell;
mod check;
mod choice;
mod contact;
mod detour;
mod distance;
mod error;
mod fastest;
mod fixed_overlaps;
mod joints;
mod levers;
mod metric;
mod object;
mod places;
mod plan;
mod planner;
mod point_count;
mod reach;
mod request;
mod resolve;
mod roll_axis;
mod rounded;
mod s_curve;
mod scene;
mod shape;
mod sweep;
mod trajectory;
mod trapezoid;
mod work;

#[cfg(test)]
mod tests;

pub use cell::{Cell, KeepOut, LARGEST_LENGTH_M, d435_body, default_camera_body};
pub use check::{
    Claim, ClaimedView, Looked, MOST_OF_A_KIND, Nearest, UNDERCUT_BOUND_M, Verdict, Violation, check,
    check_claim,
};
pub use contact::{Contact, ContactKind};
pub use error::MotionError;
pub use fixed_overlaps::fixed_overlaps;
pub use object::{CellObject, ObjectShape};
pub use places::{farthest_reach_m, object_stands_clear};
pub use plan::{Compared, Leg, LegStart, MotionPlan, PlannedView, SkipReason, TrajectoryPoint, ViewOutcome};
pub use planner::plan_motion;
pub use point_count::MOST_POINTS;
pub use reach::{KnownState, Probe, Reach};
pub use request::{MotionRequest, Objective, Order, OrderViews, Roll, Timing};
pub use work::{Allowance, Stop, inverse_work};

//! The answer: what became of each view, and the motion through those that can be reached.

use super::contact::Contact;
use crate::geometry::Pose;
use crate::robot::{ClampedJoint, UnreachableReason};

/// Why a view is left out.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SkipReason {
    /// No joint state puts the camera there (`no_ik`).
    #[error(
        "no joint state reaches the pose: nearest is {position_residual_m:.4} m and {rotation_residual_rad:.4} rad away: {cause}"
    )]
    NoIk {
        /// Distance of the nearest joint state found, metres.
        position_residual_m: f64,
        /// Its angle to the pose, radians.
        rotation_residual_rad: f64,
        /// What stands in the way.
        cause: UnreachableReason,
    },
    /// The pose is reached only with a joint beyond its limit (`joint_limit`).
    #[error("{joint} would have to go to {value_rad:.4} rad, its limit is {limit_rad:.4} rad")]
    JointLimit {
        /// The joint's name.
        joint: String,
        /// The angle it would need, radians.
        value_rad: f64,
        /// Its limit, radians.
        limit_rad: f64,
    },
    /// Every joint state that reaches the pose collides; this is the least deep
    /// collision (`self_collision`, `table_collision`, `object_collision`, `obstacle_collision`).
    #[error("{0}")]
    Collision(Contact),
    /// The pose can be taken, but no collision-free way to it was found (`no_path`).
    #[error("no collision-free way to the pose was found: {attempts} ways tried from {from}")]
    NoPath {
        /// The view (or start) it was tried from.
        from: LegStart,
        /// Pairs of joint states between which a way was searched.
        attempts: usize,
    },
    /// The cell is so hard that the planner's work ended before this view was settled (`work_limit`).
    #[error("the planner's work ended before the view was settled: the cell is too hard for it")]
    WorkLimit,
}

/// Where a leg begins.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LegStart {
    /// The request's start state.
    Start,
    /// A view, by its index in the request.
    View(usize),
}

impl std::fmt::Display for LegStart {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            LegStart::Start => f.write_str("the start"),
            LegStart::View(view) => write!(f, "view {view}"),
        }
    }
}

impl SkipReason {
    /// The stable code of the reason.
    pub fn code(&self) -> &'static str {
        use super::contact::ContactKind;
        match self {
            SkipReason::NoIk { .. } => "no_ik",
            SkipReason::JointLimit { .. } => "joint_limit",
            SkipReason::NoPath { .. } => "no_path",
            SkipReason::WorkLimit => "work_limit",
            SkipReason::Collision(contact) => match contact.kind {
                ContactKind::SelfCollision => "self_collision",
                ContactKind::Table => "table_collision",
                ContactKind::Object => "object_collision",
                ContactKind::Obstacle => "obstacle_collision",
            },
        }
    }
}

/// What became of a view.
#[derive(Clone, Debug, PartialEq)]
pub enum ViewOutcome {
    /// It is visited.
    Planned(PlannedView),
    /// It is left out.
    Skipped(SkipReason),
}

/// A visited view.
#[derive(Clone, Debug, PartialEq)]
pub struct PlannedView {
    /// Joint state at the view, radians.
    pub joints_rad: Vec<f64>,
    /// Turn about the optical axis against the requested pose, radians in [0, 2 pi).
    pub roll_rad: f64,
    /// The camera pose there, roll included.
    pub base_from_camera: Pose,
    /// When the arm arrives, seconds from the start; it then stands still for the settle time.
    pub arrival_s: f64,
}

/// One point of the trajectory.
#[derive(Clone, Debug, PartialEq)]
pub struct TrajectoryPoint {
    /// Joint angles, radians.
    pub positions_rad: Vec<f64>,
    /// Joint speeds, rad/s.
    pub velocities_rad_per_s: Vec<f64>,
    /// Joint accelerations, rad/s2, at the beginning of the interval that follows.
    pub accelerations_rad_per_s2: Vec<f64>,
    /// Seconds from the start, strictly increasing.
    pub time_from_start_s: f64,
    /// The view reached at this point, if one is; the arm stands still from here for the settle time.
    pub view: Option<usize>,
}

/// The joint path of one leg: straight between waypoints (corners rounded in
/// the trajectory where there are more than two).
#[derive(Clone, Debug, PartialEq)]
pub struct Leg {
    /// Where it begins.
    pub from: LegStart,
    /// The view it leads to.
    pub to_view: usize,
    /// Joint states, radians: both ends and the corners of a detour.
    pub waypoints_rad: Vec<Vec<f64>>,
}

/// A motion through all views that can be reached.
#[derive(Clone, Debug, PartialEq)]
pub struct MotionPlan {
    /// Names of the joints, in the order of all joint vectors.
    pub joint_names: Vec<String>,
    /// One entry for each requested view.
    pub views: Vec<ViewOutcome>,
    /// Visited views in order, indices into `views`.
    pub order: Vec<usize>,
    /// The legs between them.
    pub legs: Vec<Leg>,
    /// The timed motion; empty if no view can be reached.
    pub trajectory: Vec<TrajectoryPoint>,
    /// Time of the last point, seconds.
    pub duration_s: f64,
    /// Sum over legs of the largest joint move, radians.
    pub joint_travel_rad: f64,
    /// What the motion is compared with, when it was made for time.
    pub compared: Option<Compared>,
    /// Start values moved onto their limits.
    pub clamped_start: Vec<ClampedJoint>,
    /// Work that the plan took, in the units of [`Allowance`](super::Allowance).
    pub work: u64,
}

/// Beside a motion made for time: the one made for distance, and what no motion can beat.
#[derive(Clone, Debug, PartialEq)]
pub struct Compared {
    /// Visited views in the order of [`Objective::Distance`](super::Objective::Distance).
    pub order: Vec<usize>,
    /// Its duration, seconds.
    pub duration_s: f64,
    /// Proven: straight legs through all planned views, from one of the joint states considered for
    /// each to one of the next, in whatever order, and the rests at the views take at least so long.
    /// `None` if views were left out for want of a way, or there are too many states to say.
    pub least_duration_s: Option<f64>,
}

impl MotionPlan {
    /// How many views are visited.
    pub fn planned_count(&self) -> usize {
        self.order.len()
    }
}

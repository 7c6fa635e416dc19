//! The plan.

use std::time::Duration;

use super::Trajectory;
use crate::geometry::Pose;
use crate::predict::Prediction;

/// A plan.
#[derive(Clone, Debug)]
pub struct Plan {
    /// The number of views and where it comes from.
    pub count: ViewCount,
    /// Every view of the set; 0 is the top view.
    pub views: Vec<PlanView>,
    /// The camera's path through the planned views.
    pub path: CameraPath,
    /// What the arm's motion takes; `None` without one.
    pub motion_time: Option<MotionTime>,
    /// The arm's motion; `None` without arm.
    pub trajectory: Option<Trajectory>,
    /// How well the set covers its band; `None` without arm and for initial views.
    pub coverage: Option<CoverageReport>,
    /// Poses from which photos are expected; `None` when none were used.
    pub expected: Option<Vec<ExpectedView>>,
    /// What the caller should know although the plan is usable.
    pub warnings: Vec<Warning>,
    /// Time spent by step. The one member that differs between two runs.
    pub timings: Vec<(&'static str, Duration)>,
}

/// How well views cover their band.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coverage {
    /// Number of views.
    pub views: usize,
    /// Least angle between two of them, radians; pi for fewer than two.
    pub separation_rad: f64,
    /// Largest angle from a direction of the band, reachable or not, to its nearest view, radians;
    /// pi without views.
    pub largest_hole_rad: f64,
}

/// What adapting a set to the arm changes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CoverageReport {
    /// The views planned of the Tammes set when those that the arm cannot take are left out.
    pub before: Coverage,
    /// The views planned.
    pub after: Coverage,
    /// Part of the band's area that can be reached, 0 to 1; `None` where every view of the Tammes
    /// set could be and the band was not looked at.
    pub reachable_fraction: Option<f64>,
}

/// What a motion takes, and what it is compared with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MotionTime {
    /// The plan's own figures.
    pub planned: MotionFigures,
    /// Those of the plan for distance, beside a plan for time.
    pub by_distance: Option<MotionFigures>,
    /// Proven lower bound of the time over all orders and choices of states, seconds
    /// ([`Compared::least_duration_s`](crate::motion::Compared::least_duration_s)).
    pub least_duration_s: Option<f64>,
}

/// Time and way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MotionFigures {
    /// From the first to the last point of the trajectory, rests included, seconds.
    pub duration_s: f64,
    /// The camera's path, metres.
    pub path_length_m: f64,
}

/// The number of views.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ViewCount {
    /// The network's answer; `None` where the number was given.
    pub prediction: Option<Prediction>,
    /// The number of views in the set.
    pub used: usize,
}

/// One view.
#[derive(Clone, Debug)]
pub struct PlanView {
    /// Name of an initial view.
    pub name: Option<&'static str>,
    /// `base_from_camera`.
    pub pose: Pose,
    /// Whether the path visits it.
    pub status: ViewStatus,
}

/// Whether the path visits a view.
#[derive(Clone, Debug, PartialEq)]
pub enum ViewStatus {
    /// Visited.
    Planned,
    /// Left out.
    Skipped(Reason),
}

/// Why a view is left out.
#[derive(Clone, Debug, PartialEq)]
pub struct Reason {
    /// `no_ik`, `joint_limit`, `self_collision`, `table_collision`, `object_collision`,
    /// `obstacle_collision`, `no_path` or `work_limit`.
    pub code: &'static str,
    /// For people.
    pub message: String,
    /// The numbers of the message by name, with the unit in the name.
    pub numbers: Vec<(&'static str, f64)>,
    /// Names of the joint or of the touching parts.
    pub parts: Vec<String>,
}

/// The order of the planned views and the camera's way through them around the object.
#[derive(Clone, Debug, PartialEq)]
pub struct CameraPath {
    /// Indices of views.
    pub order: Vec<usize>,
    /// Length of the shortest curves around the object's sphere and above the table, metres.
    pub length_m: f64,
    /// Proven lower bound over all orders, metres.
    pub lower_bound_m: f64,
    /// No order is shorter.
    pub optimal: bool,
}

/// A pose from which a photo is expected.
#[derive(Clone, Debug)]
pub struct ExpectedView {
    /// Name of the initial view.
    pub name: &'static str,
    /// `base_from_camera`, level horizon.
    pub pose: Pose,
}

/// What the caller should know.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Warning {
    /// Stable name.
    pub code: &'static str,
    /// For people.
    pub message: String,
}

impl Warning {
    /// A warning.
    pub fn new(code: &'static str, message: impl Into<String>) -> Self {
        Self { code, message: message.into() }
    }
}

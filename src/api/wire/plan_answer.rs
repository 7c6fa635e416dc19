//! The plan.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use super::{ExpectedPose, PoseJson};

/// A plan: which views, in which order, along which motion.
#[derive(Clone, Debug, Serialize, Deserialize, ToSchema)]
#[schema(as = Plan)]
pub struct PlanAnswer {
    /// Hash of what the request means, the service's version and the model: requests that mean the same
    /// have the same id.
    pub id: String,
    /// The number of views and where it comes from.
    pub view_count: ViewCountJson,
    /// Every view of the set, by id.
    pub views: Vec<PlannedView>,
    /// Ids of the planned views in the order of the path; starts at the top view (an initial plan
    /// ends there).
    pub order: Vec<u32>,
    /// Length of the camera's path in metres: shortest curves around the object's sphere and above
    /// the table, in the order given.
    pub path_length_m: f64,
    /// True when no shorter order exists (within rounding).
    pub path_optimal: bool,
    /// Proven lower bound of the path's length over all orders, metres.
    pub path_lower_bound_m: f64,
    /// What the motion takes, and what it is compared with; absent without robot.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub motion_time: Option<MotionTimeJson>,
    /// The arm's motion through the views; absent without robot.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub trajectory: Option<TrajectoryJson>,
    /// How well the views cover the band, before and after views that cannot be reached were replaced;
    /// absent without robot and for initial views.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub coverage: Option<CoverageReportJson>,
    /// Poses from which the photos of a prediction are expected, with roll 0.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub expected_image_poses: Option<Vec<ExpectedPose>>,
    /// What the caller should know although the plan is usable.
    pub warnings: Vec<WarningJson>,
    /// Milliseconds by step. The one member that differs between two computations of one request.
    pub timings_ms: BTreeMap<String, f64>,
}

/// What became of the set's coverage of its band.
#[derive(Clone, Copy, Debug, Serialize, Deserialize, ToSchema)]
#[schema(as = CoverageReport)]
pub struct CoverageReportJson {
    /// The views planned where those of the Tammes set that cannot be taken are merely left out.
    pub before: CoverageJson,
    /// The views planned.
    pub after: CoverageJson,
    /// Part of the band's area that can be reached, 0 to 1; null where every view of the Tammes set
    /// can be, so that the band was not looked at.
    pub reachable_fraction: Option<f64>,
}

/// How well views cover their band.
#[derive(Clone, Copy, Debug, Serialize, Deserialize, ToSchema)]
#[schema(as = Coverage)]
pub struct CoverageJson {
    /// Number of views.
    pub views: u32,
    /// Smallest angle between two views, degrees; 180 for fewer than two.
    pub separation_deg: f64,
    /// Largest angle from any direction of the band, reachable or not, to its nearest view, degrees;
    /// 180 without views.
    pub largest_hole_deg: f64,
}

/// What a motion takes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
#[schema(as = MotionTime)]
pub struct MotionTimeJson {
    /// From the first to the last point of the trajectory in seconds, rests at the views included.
    pub duration_s: f64,
    /// With objective `time`: the figures of the plan for `distance` through the same views.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub by_distance: Option<MotionFiguresJson>,
    /// With objective `time`: no order of the views and no choice among the joint states considered
    /// takes less (proven); absent when there are too many states to say.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub least_duration_s: Option<f64>,
}

/// Time and way of a motion.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
#[schema(as = MotionFigures)]
pub struct MotionFiguresJson {
    /// Seconds, rests included.
    pub duration_s: f64,
    /// Length of the camera's path, metres.
    pub path_length_m: f64,
}

/// The number of views.
#[derive(Clone, Copy, Debug, Serialize, Deserialize, ToSchema)]
#[schema(as = ViewCount)]
pub struct ViewCountJson {
    /// The network's number, rounded: from here on one more view improves a NeRF by less than 0.05 dB; null without
    /// prediction.
    pub predicted: Option<u32>,
    /// The network's number before rounding; null without prediction.
    pub raw: Option<f64>,
    /// Least and largest number of views between which 80 % of objects' labels lie; null without prediction.
    #[serde(default)]
    pub interval: Option<[u32; 2]>,
    /// How unlike the objects trained on the photos are; beyond 1 a warning says so; null without prediction.
    #[serde(default)]
    pub novelty: Option<f64>,
    /// The number of views in the set.
    pub used: u32,
}

/// One view of the set.
#[derive(Clone, Debug, Serialize, Deserialize, ToSchema)]
pub struct PlannedView {
    /// Index in the set; 0 is the top view.
    pub id: u32,
    /// Name of an initial view.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// `base_from_camera`, OpenCV axes.
    pub pose: PoseJson,
    /// Whether the path visits it.
    pub status: ViewStatusJson,
    /// Why it is skipped; null when planned.
    pub reason: Option<SkipReason>,
}

/// Whether the path visits a view.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case")]
#[schema(as = ViewStatus)]
pub enum ViewStatusJson {
    /// Visited.
    Planned,
    /// Left out, with a reason.
    Skipped,
}

/// Why a view is skipped.
#[derive(Clone, Debug, Serialize, Deserialize, ToSchema)]
pub struct SkipReason {
    /// `no_ik`, `joint_limit`, `self_collision`, `table_collision`, `object_collision`, `obstacle_collision`,
    /// `no_path` or `work_limit`.
    pub code: String,
    /// For people.
    pub message: String,
    /// The joint, or the two parts that touch.
    pub parts: Vec<String>,
    /// The numbers of the message by name; names end in their unit.
    pub numbers: BTreeMap<String, f64>,
}

/// The arm's motion, as in ROS `FollowJointTrajectory`.
#[derive(Clone, Debug, Serialize, Deserialize, ToSchema)]
#[schema(as = Trajectory)]
pub struct TrajectoryJson {
    /// Names in the order of every array below.
    pub joint_names: Vec<String>,
    /// Points with strictly increasing times.
    pub points: Vec<TrajectoryPointJson>,
}

/// One point of the motion.
#[derive(Clone, Debug, Serialize, Deserialize, ToSchema)]
#[schema(as = TrajectoryPoint)]
pub struct TrajectoryPointJson {
    /// Radians.
    pub positions: Vec<f64>,
    /// rad/s.
    pub velocities: Vec<f64>,
    /// rad/s2.
    pub accelerations: Vec<f64>,
    /// Seconds.
    pub time_from_start: f64,
    /// The view whose photo is taken at this point, where the arm has come to rest.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub view: Option<u32>,
}

/// Something the caller should know.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
#[schema(as = Warning)]
pub struct WarningJson {
    /// Stable name.
    pub code: String,
    /// For people, with the numbers.
    pub message: String,
}

/// The stored plans.
#[derive(Clone, Debug, Serialize, ToSchema)]
pub struct PlanList {
    /// Ids, sorted.
    pub plans: Vec<String>,
}

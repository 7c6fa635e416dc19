//! `POST /v1/checks`.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use super::{PlanRequestJson, PoseJson, TrajectoryJson, ViewStatusJson};

/// What to check: a stored plan by its id, or a plan and the request that it answers.
#[derive(Clone, Debug, Default, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
#[schema(as = CreateCheck, example = json!({"plan_id": "0123456789abcdef0123456789abcdef"}))]
pub struct CreateCheck {
    /// Id of a stored plan.
    #[serde(default)]
    pub plan_id: Option<String>,
    /// The request. `images` and `image_poses` are not looked at.
    #[serde(default)]
    pub request: Option<PlanRequestJson>,
    /// The plan, changed or not.
    #[serde(default)]
    pub plan: Option<CheckedPlanJson>,
}

/// A plan as far as it is checked; a whole `Plan` is one, its other members are not looked at.
#[derive(Clone, Debug, Deserialize, ToSchema)]
#[schema(as = CheckedPlan)]
pub struct CheckedPlanJson {
    /// Every view of the set; ids count from 0.
    pub views: Vec<CheckedViewJson>,
    /// Ids of the planned views in the order of the path.
    pub order: Vec<u32>,
    /// The arm's motion.
    #[serde(default)]
    pub trajectory: Option<TrajectoryJson>,
}

/// A view as far as it is checked.
#[derive(Clone, Debug, Deserialize, ToSchema)]
#[schema(as = CheckedView)]
pub struct CheckedViewJson {
    /// Index in the set.
    pub id: u32,
    /// `base_from_camera`.
    pub pose: PoseJson,
    /// Whether the path visits it.
    pub status: ViewStatusJson,
}

/// The verdict on a plan.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
#[schema(as = Check)]
pub struct CheckAnswer {
    /// True when nothing is wrong.
    pub sound: bool,
    /// What is wrong, at most ten entries of each kind.
    pub violations: Vec<ViolationJson>,
    /// What was looked at.
    pub checked: CheckedJson,
}

/// Something wrong with a plan.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
#[schema(as = Violation)]
pub struct ViolationJson {
    /// Of the views: `view_missing`, `view_off_shell`, `view_off_aim`, `view_out_of_band`,
    /// `view_rolled`, `view_under_table`, `wrong_order`. Of the motion: `no_trajectory`,
    /// `wrong_joints`, `malformed_point`, `time_not_increasing`, `joint_limit`, `speed_limit`,
    /// `acceleration_limit`, `jerk_limit`, `jump`, `wrong_start`, `view_not_taken`, `wrong_pose`,
    /// `too_near`, `not_proven`.
    pub code: String,
    /// For people.
    pub message: String,
    /// When on the trajectory, seconds from its start.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub time: Option<f64>,
    /// The numbers of the message by name; names end in their unit.
    pub numbers: BTreeMap<String, f64>,
    /// The joint, or the two parts that come too near.
    pub parts: Vec<String>,
}

/// What was looked at.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
#[schema(as = Checked)]
pub struct CheckedJson {
    /// Views of the plan.
    pub views: u32,
    /// Points of the trajectory.
    pub points: u32,
    /// Duration of the trajectory, seconds.
    pub seconds: f64,
    /// Joint states at which distances were measured.
    pub states: u64,
    /// No pair of parts comes nearer than its margin less this anywhere between the points,
    /// metres, the points being joined by cubic splines; null when the trajectory is missing or
    /// could not be judged.
    pub undercut_bound_m: Option<f64>,
    /// Where arm, camera and tool come nearest to object, table or a keep-out region; null beyond
    /// half a metre.
    pub smallest_clearance: Option<ClearanceJson>,
    /// Where parts of the arm come nearest to each other.
    pub smallest_self_clearance: Option<ClearanceJson>,
    /// Largest share of a joint's speed limit (scaled by `timing.speed_scale`), at most 1e9.
    pub largest_speed_share: f64,
    /// Largest share of a joint's acceleration limit, from differences of speeds, at
    /// most 1e9.
    pub largest_acceleration_share: f64,
    /// Largest share of a joint's jerk limit, at most 1e9; null where jerk is not limited.
    pub largest_jerk_share: Option<f64>,
    /// Largest distance of a camera from its view's pose, metres.
    pub largest_pose_error_m: f64,
    /// Largest angle of a camera to its view's pose, radians.
    pub largest_pose_error_rad: f64,
}

/// Two parts and how near they come.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
#[schema(as = Clearance)]
pub struct ClearanceJson {
    /// Signed distance in metres.
    pub distance_m: f64,
    /// The two parts.
    pub between: [String; 2],
    /// Seconds from the trajectory's start.
    pub time: f64,
}

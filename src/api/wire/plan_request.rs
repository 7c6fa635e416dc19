//! `POST /v1/plans`.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use super::{
    CameraJson, KeepOutJson, LimitsJson, ObjectJson, PoseJson, RobotJson, SolidJson, TimingJson,
    ViewSpaceJson,
};

/// What to plan. Exactly one of `images`, `view_count` and `views` says how many views.
///
/// SI units, quaternions x, y, z, w, OpenCV camera axes, everything in the robot's `base` frame.
#[derive(Clone, Debug, Default, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
#[schema(as = PlanRequest, example = json!({
    "view_count": 35,
    "object": {"center": [0.45, 0.0, 0.1], "radius": 0.1, "table_z": 0.0},
    "view_space": {"radius": 0.3, "min_elevation_deg": 5.0, "max_elevation_deg": 90.0},
    "robot": {"model": "ur5e"},
    "flange_from_camera": {"position": [0.0, 0.0, 0.05], "orientation": [0.0, 0.0, 0.0, 1.0]},
    "roll": "free"
}))]
pub struct PlanRequestJson {
    /// 1 to 5 photos of the object, PNG or JPEG in base64, each of the camera's size and at most
    /// 25 megapixels, taken from the initial view poses: the number of views is predicted. The
    /// body may hold 32 MiB in all.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub images: Option<Vec<String>>,
    /// Where the photos were taken, `base_from_camera`, in the order of `images`. Poses that
    /// differ from the expected ones give a warning.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub image_poses: Option<Vec<PoseJson>>,
    /// Number of views, 1 to 200: skips the prediction.
    #[serde(
        default,
        skip_serializing_if = "Option::is_none",
        deserialize_with = "super::whole::optional_whole"
    )]
    pub view_count: Option<u32>,
    /// `initial` plans the path through the initial photo poses, ending at the top view.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub views: Option<InitialViewsJson>,
    /// Intrinsics of the camera; an Intel RealSense D435's colour camera (1280x720) with a warning
    /// when left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub camera: Option<CameraJson>,
    /// The object's enclosing sphere and table. Only a request without robot and images may leave
    /// it out (0.1 m at the origin, with a warning).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub object: Option<ObjectJson>,
    /// The views' shell; 0.3 m, 5 to 90 degrees when left out.
    #[serde(default)]
    pub view_space: ViewSpaceJson,
    /// The arm; without it the answer holds poses and order only. Members about the arm (`limits`,
    /// `flange_from_camera`, `start`, `roll`, `objective`, `keep_out`, `camera_body`, `tool`, `margin`, `timing`,
    /// `unreachable_views`) are refused without it, unless they say what is so anyway.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub robot: Option<RobotJson>,
    /// Joint limits by joint name that replace the robot's own.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schema(value_type = Option<std::collections::BTreeMap<String, super::JointLimitsJson>>)]
    pub limits: Option<LimitsJson>,
    /// Hand-eye calibration: the camera's pose in the flange (`tool0`) frame, which is what
    /// OpenCV's `calibrateHandEye` returns for eye-in-hand. When left out, the camera sits 0.05 m
    /// in front of the flange and looks along its z axis, with a warning.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub flange_from_camera: Option<PoseJson>,
    /// Joint angles in radians from which the arm starts, one a joint; the trajectory starts at
    /// the first view when left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub start: Option<Vec<f64>>,
    /// Whether the camera may be turned about its optical axis at a view: `fixed` keeps the horizon
    /// level, `free` lets the planner choose among 12 turns, `sampled` among `roll_samples`. Turned
    /// views see the same of the object; they are reached more often and with less motion. `fixed` when
    /// left out.
    #[serde(default)]
    pub roll: RollJson,
    /// What the order of the views and the arm's motion are made for: `distance`, the shortest path of the
    /// camera, or `time`, the shortest execution. `distance` when left out.
    #[serde(default, skip_serializing_if = "ObjectiveJson::is_distance")]
    pub objective: ObjectiveJson,
    /// Regions that nothing of the arm may enter, at most 64. Views that cannot be taken because of
    /// one are skipped with `obstacle_collision`, which names it.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub keep_out: Vec<KeepOutJson>,
    /// The camera's body in the camera frame, at most 32 solids: replaces the body of a RealSense
    /// D435 and its bracket, which are assumed when it is left out. An empty list is no body.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub camera_body: Option<Vec<SolidJson>>,
    /// What else is mounted on the flange, in the flange frame, at most 32 solids.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub tool: Vec<SolidJson>,
    /// Clearance kept from the object, the table and the keep-out regions in metres, 0 to 0.2;
    /// 0.01 when left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub margin: Option<f64>,
    /// How the motion is timed: share of the speed limits, rest at the views, time between points,
    /// bounded jerk. Each member has a default of its own.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub timing: Option<TimingJson>,
    /// With `roll` `sampled`, and only then: the number of evenly spaced rolls, 1 to 64, of which a
    /// level horizon is the first.
    #[serde(
        default,
        skip_serializing_if = "Option::is_none",
        deserialize_with = "super::whole::optional_whole"
    )]
    pub roll_samples: Option<u32>,
    /// What becomes of views that the arm cannot reach: `replace` spreads as many views as asked for
    /// again over the part of the band that it can reach, `skip` leaves them out with their reasons.
    /// Initial views are never replaced. `replace` when left out.
    #[serde(default, skip_serializing_if = "UnreachableViewsJson::is_replace")]
    pub unreachable_views: UnreachableViewsJson,
}

/// Which initial views.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case")]
#[schema(as = InitialViews)]
pub enum InitialViewsJson {
    /// Top, left and front.
    Initial,
    /// Top, left, right, front and back.
    InitialFive,
}

/// Rotation about the optical axis.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case")]
#[schema(as = Roll)]
pub enum RollJson {
    /// Chosen by the planner among 12 for least joint motion.
    Free,
    /// The horizon stays level.
    #[default]
    Fixed,
    /// Chosen by the planner among `roll_samples`.
    Sampled,
}

/// What becomes of views that the arm cannot reach.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case")]
#[schema(as = UnreachableViews)]
pub enum UnreachableViewsJson {
    /// As many views as asked for are spread again over the part of the band that can be reached.
    #[default]
    Replace,
    /// They are skipped with their reasons; the others stay where they are.
    Skip,
}

impl UnreachableViewsJson {
    fn is_replace(&self) -> bool {
        *self == Self::Replace
    }
}

/// What a plan is made for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case")]
#[schema(as = Objective)]
pub enum ObjectiveJson {
    /// The order with the shortest path of the camera, proven; joint states with the least travel
    /// along it.
    #[default]
    Distance,
    /// Order and joint states that the arm runs through in the least time. The answer holds the
    /// figures of both.
    Time,
}

impl ObjectiveJson {
    fn is_distance(&self) -> bool {
        *self == Self::Distance
    }
}

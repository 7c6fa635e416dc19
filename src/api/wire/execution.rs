//! Executions on the simulated arm.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use super::{CameraJson, PoseJson, WarningJson};

/// Starts a run of the simulated arm.
#[derive(Clone, Debug, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
#[schema(example = json!({"plan_id": "0123456789abcdef0123456789abcdef", "object": {"sample": "mug"}, "speed_factor": 10.0}))]
pub struct CreateExecution {
    /// A stored plan.
    pub plan_id: String,
    /// What stands at the plan's object centre, scaled to its radius.
    pub object: ExecutionObject,
    /// Simulated seconds per second, 0.01 to 100000; 1 when left out.
    #[serde(default = "default_speed")]
    pub speed_factor: f64,
    /// The simulated camera; the plan's when left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub camera: Option<CameraJson>,
    /// Background of the images; `transparent` when left out.
    #[serde(default)]
    pub background: BackgroundJson,
}

fn default_speed() -> f64 {
    1.0
}

/// The object: exactly one of `sample`, `made`, `file` and `glb`.
#[derive(Clone, Debug, Default, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
#[schema(example = json!({"sample": "mug"}))]
pub struct ExecutionObject {
    /// A sample of `GET /v1/objects`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sample: Option<String>,
    /// An object made from code, `made:FAMILY/SEED` as `prv objects` lists them; `~texture=N` at its end gives it
    /// other textures.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schema(example = "made:vase/3")]
    pub made: Option<String>,
    /// An OBJ or glTF file below the server's objects directory, as a relative path.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub file: Option<String>,
    /// A binary glTF file in base64.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub glb: Option<String>,
}

/// What lies behind the object in the images.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case")]
#[schema(as = Background)]
pub enum BackgroundJson {
    /// Straight alpha.
    #[default]
    Transparent,
    /// Opaque white.
    White,
    /// Opaque black.
    Black,
}

/// A run's state.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case")]
#[schema(as = ExecutionState)]
pub enum ExecutionStateJson {
    /// Waits for a free arm, also beyond the end of the service.
    Queued,
    /// The arm moves.
    Running,
    /// Every planned view was taken.
    Done,
    /// Stopped by request.
    Cancelled,
    /// Stopped by an error.
    Failed,
    /// The service ended while the arm moved.
    Interrupted,
}

/// A run.
#[derive(Clone, Debug, Serialize, Deserialize, ToSchema)]
#[schema(as = Execution)]
pub struct ExecutionJson {
    /// The run's id.
    pub id: String,
    /// The plan that is followed.
    pub plan_id: String,
    /// Where it stands.
    pub state: ExecutionStateJson,
    /// How far it came.
    pub progress: ProgressJson,
    /// The arm's joints now; absent without robot.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub joints: Option<JointsJson>,
    /// Ids of the views whose images can be fetched, in the order taken.
    pub images: Vec<u32>,
    /// What the caller should know.
    pub warnings: Vec<WarningJson>,
    /// Why it failed or was interrupted.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub error: Option<String>,
}

/// How far a run came.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize, ToSchema)]
#[schema(as = Progress)]
pub struct ProgressJson {
    /// Views taken.
    pub views_done: u32,
    /// Views planned.
    pub views_total: u32,
    /// Simulated time since the start, seconds.
    pub time_s: f64,
    /// Simulated time of the whole run, seconds.
    pub duration_s: f64,
}

/// Joint angles.
#[derive(Clone, Debug, Serialize, Deserialize, ToSchema)]
#[schema(as = Joints)]
pub struct JointsJson {
    /// Names.
    pub names: Vec<String>,
    /// Radians.
    pub positions: Vec<f64>,
}

/// The runs.
#[derive(Clone, Debug, Serialize, ToSchema)]
pub struct ExecutionList {
    /// Ids, sorted.
    pub executions: Vec<String>,
}

/// The images of a run in the form in which `POST /v1/plans` takes them.
#[derive(Clone, Debug, Serialize, ToSchema)]
pub struct ExecutionImages {
    /// PNG in base64, in the order taken.
    pub images: Vec<String>,
    /// `base_from_camera` of each, from the joints at the shot.
    pub image_poses: Vec<PoseJson>,
    /// The camera that took them.
    pub camera: CameraJson,
}

/// A sample object.
#[derive(Clone, Debug, Serialize, ToSchema)]
pub struct ObjectSummary {
    /// The name to give as `object.sample`.
    pub sample: String,
}

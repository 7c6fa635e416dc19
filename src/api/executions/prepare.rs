//! From a request to a run that is ready to go.

use std::path::{Path, PathBuf};

use super::{Job, load_object};
use crate::api::convert;
use crate::api::problem::Problem;
use crate::api::store::{ExecutionRecord, PlanStore};
use crate::api::wire::{
    BackgroundJson, CreateExecution, ExecutionJson, ExecutionStateJson, JointsJson, PlanAnswer,
    PlanRequestJson, ProgressJson, SphereJson, ViewStatusJson, WarningJson,
};
use crate::geometry::Pose;
use crate::imaging::Camera;
use crate::order::Obstacle;
use crate::plan::{Arm, ObjectSphere};
use crate::simulate::{Carrier, Flight, Following, MAX_SPEED_FACTOR, MIN_SPEED_FACTOR, SimulateError};

/// Most pixels of a simulated photo.
const MAX_PIXELS: u64 = convert::MAX_IMAGE_PIXELS;

/// Where plans and objects come from.
#[derive(Clone)]
pub struct Sources {
    /// Stored plans.
    pub plans: PlanStore,
    /// The directory below which runs may name object files.
    pub objects_dir: Option<PathBuf>,
}

impl Sources {
    /// Checks the request and loads plan and object; an uploaded one goes through a file in `scratch`.
    /// The record has no id yet.
    ///
    /// # Errors
    /// 404 for an unknown plan, 422 for what cannot be executed.
    pub fn prepare(&self, json: &CreateExecution, scratch: &Path) -> Result<(ExecutionRecord, Job), Problem> {
        prepare(json, &self.plans, self.objects_dir.as_deref(), scratch)
    }
}

fn prepare(
    json: &CreateExecution,
    plans: &PlanStore,
    objects_dir: Option<&Path>,
    scratch: &Path,
) -> Result<(ExecutionRecord, Job), Problem> {
    if !(MIN_SPEED_FACTOR..=MAX_SPEED_FACTOR).contains(&json.speed_factor) {
        let (least, most) = (MIN_SPEED_FACTOR, MAX_SPEED_FACTOR);
        return Err(SimulateError::SpeedFactor { value: json.speed_factor, least, most }.into());
    }
    let (answer, request) = stored_plan(plans, &json.plan_id)?;
    let camera = camera(json, &request)?;
    let object = request.object.as_ref().map_or(ObjectSphere::ASSUMED, convert::object);
    let carrier = carrier(&answer, &request, &object)?;
    let shots = carrier.shots().len();
    if shots == 0 {
        return Err(SimulateError::NoViews.into());
    }
    let mesh = load_object(&json.object, objects_dir, scratch)?;
    let mut warnings: Vec<WarningJson> = mesh
        .warnings
        .iter()
        .map(|warning| WarningJson { code: "object_mesh".to_owned(), message: warning.to_string() })
        .collect();
    if matches!(carrier, Carrier::Free(_)) {
        warnings.push(WarningJson {
            code: "free_camera".to_owned(),
            message: "the plan has no robot: a camera flies freely along its path".to_owned(),
        });
    }
    let joints = match &carrier {
        Carrier::Arm { motion, .. } => {
            Some(JointsJson { names: motion.joint_names().to_vec(), positions: motion.joints_at(0.0) })
        }
        Carrier::Free(_) => None,
    };
    let record = ExecutionRecord {
        execution: ExecutionJson {
            id: String::new(),
            plan_id: json.plan_id.clone(),
            state: ExecutionStateJson::Queued,
            progress: ProgressJson {
                views_total: shots as u32,
                duration_s: carrier.duration_s(),
                ..ProgressJson::default()
            },
            joints,
            images: Vec::new(),
            warnings,
            error: None,
        },
        camera: convert::camera_json(&camera),
        object: Some(SphereJson { center: object.center_in_base.into(), radius: object.radius_m }),
        image_poses: Vec::new(),
        events: Vec::new(),
    };
    let job = Job {
        carrier,
        mesh: mesh.fitted(object.center_in_base, object.radius_m),
        camera,
        background: match json.background {
            BackgroundJson::Transparent => None,
            BackgroundJson::White => Some([255; 3]),
            BackgroundJson::Black => Some([0; 3]),
        },
        speed_factor: json.speed_factor,
    };
    Ok((record, job))
}

fn stored_plan(plans: &PlanStore, id: &str) -> Result<(PlanAnswer, PlanRequestJson), Problem> {
    let (Some(answer), Some(request)) = (plans.answer(id)?, plans.request(id)?) else {
        return Err(Problem::not_found("unknown_plan", "plan_id", id, "the id of a stored plan"));
    };
    let broken = |error: serde_json::Error| Problem::internal(format!("stored plan {id}: {error}"));
    Ok((serde_json::from_slice(&answer).map_err(broken)?, serde_json::from_slice(&request).map_err(broken)?))
}

fn camera(json: &CreateExecution, request: &PlanRequestJson) -> Result<Camera, Problem> {
    let camera = match json.camera.as_ref().or(request.camera.as_ref()) {
        Some(json) => convert::camera(json)?,
        None => Camera::REALSENSE_D435,
    };
    let pixels = u64::from(camera.width) * u64::from(camera.height);
    if pixels > MAX_PIXELS {
        let value = format!("{}x{} = {pixels} pixels", camera.width, camera.height);
        return Err(Problem::field(
            "too_many_pixels",
            "camera",
            value,
            format!("at most {MAX_PIXELS} pixels"),
        ));
    }
    Ok(camera)
}

fn carrier(
    answer: &PlanAnswer,
    request: &PlanRequestJson,
    object: &ObjectSphere,
) -> Result<Carrier, Problem> {
    if let (Some(description), Some(trajectory)) = (&request.robot, &answer.trajectory) {
        let model = convert::robot(description)?;
        let mount = request.flange_from_camera.as_ref().map(|json| convert::pose("flange_from_camera", json));
        let motion = Following::new(convert::trajectory(trajectory.clone()), model.joints.len())?;
        let flange_from_camera = mount.transpose()?.unwrap_or_else(Arm::assumed_mount);
        return Ok(Carrier::Arm { motion, kinematics: model.kinematics, flange_from_camera });
    }
    if request.robot.is_some() {
        // No view can be reached.
        return Err(SimulateError::NoViews.into());
    }
    let mut views: Vec<(usize, Pose)> = Vec::with_capacity(answer.order.len());
    for id in &answer.order {
        let view = answer.views.iter().find(|view| view.id == *id && view.status == ViewStatusJson::Planned);
        let Some(view) = view else {
            return Err(Problem::internal(format!("stored plan {}: no view {id}", answer.id)));
        };
        views.push((*id as usize, convert::pose("views.pose", &view.pose)?));
    }
    let obstacle =
        Obstacle { center: object.center_in_base, radius_m: object.radius_m, table_z_m: object.table_z_m };
    Ok(Carrier::Free(Flight::through(&views, &obstacle)))
}

//! Requests.

use serde_json::Value;

use super::{camera, canonical, images, limited_robot, object, pose, surroundings, timing};
use crate::api::problem::Problem;
use crate::api::wire::{
    InitialViewsJson, ObjectiveJson, PlanRequestJson, PredictionRequest, RollJson, UnreachableViewsJson,
    ViewSpaceJson,
};
use crate::motion::{Objective, Roll};
use crate::plan::{Arm, PlanRequest, UnreachableViews, ViewShell, ViewSource};
use crate::robot::RobotWarning;
use crate::views::Band;

/// The shell of views.
///
/// # Errors
/// 422 for elevations that make no band.
pub fn shell(json: &ViewSpaceJson) -> Result<ViewShell, Problem> {
    let band = Band::from_degrees(json.min_elevation_deg, json.max_elevation_deg)?;
    Ok(ViewShell { radius_m: json.radius, band })
}

/// The request of a plan. Photos are decoded last: they are what takes time.
///
/// # Errors
/// 422 naming the member.
pub fn plan_request(json: &PlanRequestJson) -> Result<PlanRequest, Problem> {
    let given = [json.images.is_some(), json.view_count.is_some(), json.views.is_some()];
    if given.iter().filter(|given| **given).count() != 1 {
        let names: Vec<&str> = ["images", "view_count", "views"]
            .into_iter()
            .zip(given)
            .filter_map(|(name, given)| given.then_some(name))
            .collect();
        let value = if names.is_empty() { "none of them".to_owned() } else { names.join(" and ") };
        let field = names.first().copied().unwrap_or("images");
        return Err(Problem::field(
            "view_source",
            field,
            value,
            "exactly one of images, view_count and views",
        ));
    }
    let camera = json.camera.as_ref().map(camera).transpose()?;
    let arm = arm(json)?;
    let poses = |poses: &Vec<_>| {
        poses.iter().enumerate().map(|(index, json)| pose(&format!("image_poses[{index}]"), json)).collect()
    };
    let photo_poses = json.image_poses.as_ref().map(poses).transpose()?;
    let shell = shell(&json.view_space)?;
    let source = match (&json.images, json.view_count, json.views) {
        (Some(texts), _, _) => ViewSource::Photos(images(texts)?),
        (None, Some(count), _) => ViewSource::Count(count as usize),
        (None, None, initial) => ViewSource::Initial { five: initial == Some(InitialViewsJson::InitialFive) },
    };
    Ok(PlanRequest { source, photo_poses, camera, object: json.object.as_ref().map(object), shell, arm })
}

/// The freedom of roll.
fn roll(json: &PlanRequestJson) -> Result<Roll, Problem> {
    let bound = format!("from 1 to {}, with roll sampled", Roll::MOST_SAMPLES);
    match (json.roll, json.roll_samples) {
        (RollJson::Sampled, Some(samples)) if (1..=Roll::MOST_SAMPLES).contains(&(samples as usize)) => {
            Ok(Roll::Free { samples: samples as usize })
        }
        (RollJson::Sampled, Some(samples)) => {
            Err(Problem::field("out_of_range", "roll_samples", samples, bound))
        }
        (RollJson::Sampled, None) => {
            Err(Problem::field("missing_member", "roll_samples", Value::Null, bound))
        }
        (_, Some(samples)) => Err(Problem::field(
            "roll_not_sampled",
            "roll_samples",
            samples,
            "left out unless roll is sampled",
        )),
        (RollJson::Free, None) => Ok(Roll::FREE),
        (RollJson::Fixed, None) => Ok(Roll::Fixed),
    }
}

/// The first member that asks something of an arm, with its value. What says no more than its being left
/// out would, such as a timing of defaults, may stand in a request without robot.
fn needs_robot(json: &PlanRequestJson) -> Option<(&'static str, Value)> {
    let stated = canonical(PlanRequestJson { images: None, ..json.clone() });
    let members = serde_json::to_value(&stated).unwrap_or(Value::Null);
    [
        "limits",
        "flange_from_camera",
        "start",
        "roll",
        "objective",
        "keep_out",
        "camera_body",
        "tool",
        "margin",
        "timing",
        "roll_samples",
        "unreachable_views",
    ]
    .into_iter()
    .find_map(|name| {
        let value = members.get(name).filter(|value| **value != "fixed")?;
        Some((name, value.clone()))
    })
}

fn arm(json: &PlanRequestJson) -> Result<Option<Arm>, Problem> {
    let roll = roll(json)?;
    let Some(description) = &json.robot else {
        return match needs_robot(json) {
            Some((field, value)) => {
                let bound = "left out without robot: it is about the arm";
                Err(Problem::field("robot_missing", field, value, bound))
            }
            None => Ok(None),
        };
    };
    let mount = json.flange_from_camera.as_ref().map(|json| pose("flange_from_camera", json)).transpose()?;
    let mut model = limited_robot(description, json.limits.as_ref())?;
    let timing = timing(json.timing.as_ref());
    let with_jerk = json.limits.iter().flatten().filter(|(_, limits)| limits.max_jerk.is_some());
    let with_jerk: Vec<&str> = with_jerk.map(|(name, _)| name.as_str()).collect();
    if !timing.jerk_limited && !with_jerk.is_empty() {
        model.warnings.push(RobotWarning::unused_jerk_limit(&with_jerk));
    }
    Ok(Some(Arm {
        model,
        flange_from_camera: mount,
        start_rad: json.start.clone(),
        surroundings: surroundings(json)?,
        timing,
        roll,
        objective: match json.objective {
            ObjectiveJson::Distance => Objective::Distance,
            ObjectiveJson::Time => Objective::Time,
        },
        unreachable_views: match json.unreachable_views {
            UnreachableViewsJson::Replace => UnreachableViews::Replace,
            UnreachableViewsJson::Skip => UnreachableViews::Skip,
        },
    }))
}

/// The request of a prediction, as a plan's request without arm.
///
/// # Errors
/// 422 naming the member.
pub fn prediction_request(json: &PredictionRequest) -> Result<PlanRequest, Problem> {
    plan_request(&PlanRequestJson {
        images: Some(json.images.clone()),
        image_poses: json.image_poses.clone(),
        camera: json.camera,
        object: Some(json.object),
        view_space: json.view_space,
        ..PlanRequestJson::default()
    })
}

//! Robots.

use std::collections::HashMap;

use serde_json::Value;

use super::base64_bytes;
use crate::api::problem::Problem;
use crate::api::wire::{DhConventionJson, DhRowJson, RobotJson, RobotSummary};
use crate::robot::{DhConvention, DhRow, Meshes, RobotModel};

/// The robot of a request.
///
/// # Errors
/// 422 unless exactly one description is given, for members that belong to another one, and those of
/// the description.
pub fn robot(json: &RobotJson) -> Result<RobotModel, Problem> {
    belongs(json)?;
    match (&json.model, &json.dh, &json.urdf) {
        (Some(name), None, None) => Ok(RobotModel::named(name)?),
        (None, Some(rows), None) => {
            names_differ(rows)?;
            let rows: Vec<DhRow> = rows.iter().map(dh_row).collect();
            let convention = match json.convention {
                DhConventionJson::Standard => DhConvention::Standard,
                DhConventionJson::Modified => DhConvention::Modified,
            };
            Ok(RobotModel::from_dh(&rows, convention)?)
        }
        (None, None, Some(text)) => {
            let (base, tip) = (json.base_link.as_deref(), json.tip_link.as_deref());
            Ok(RobotModel::from_urdf_and_meshes(text, base, tip, &meshes(json)?)?)
        }
        (model, dh, urdf) => {
            let given =
                usize::from(model.is_some()) + usize::from(dh.is_some()) + usize::from(urdf.is_some());
            Err(Problem::field(
                "robot_description",
                "robot",
                format!("{given} of model, dh, urdf"),
                "exactly one of model, dh, urdf",
            ))
        }
    }
}

/// Refuses members that the description given has no use for, rather than to ignore them.
fn belongs(json: &RobotJson) -> Result<(), Problem> {
    let refuse = |code: &str, field: &str, value: Value, owner: &str| {
        Err(Problem::field(code, format!("robot.{field}"), value, format!("left out without robot.{owner}")))
    };
    if json.urdf.is_none() {
        if let Some(link) = &json.base_link {
            return refuse("urdf_missing", "base_link", link.clone().into(), "urdf");
        }
        if let Some(link) = &json.tip_link {
            return refuse("urdf_missing", "tip_link", link.clone().into(), "urdf");
        }
        if let Some(meshes) = json.meshes.as_ref().filter(|meshes| !meshes.is_empty()) {
            return refuse("urdf_missing", "meshes", format!("{} files", meshes.len()).into(), "urdf");
        }
    }
    if json.dh.is_none() && json.convention == DhConventionJson::Modified {
        return refuse("dh_missing", "convention", "modified".into(), "dh");
    }
    Ok(())
}

/// Refuses joints of one name: limits and trajectories go by names.
fn names_differ(rows: &[DhRowJson]) -> Result<(), Problem> {
    let mut bearers: HashMap<&str, usize> = HashMap::new();
    for (index, name) in rows.iter().enumerate().filter_map(|(i, row)| Some((i, row.name.as_deref()?))) {
        if let Some(earlier) = bearers.insert(name, index) {
            return Err(Problem::field(
                "duplicate_name",
                format!("robot.dh[{index}].name"),
                name,
                format!("another name than robot.dh[{earlier}] has"),
            ));
        }
    }
    Ok(())
}

/// The attached mesh files.
fn meshes(json: &RobotJson) -> Result<Meshes, Problem> {
    let given = json.meshes.iter().flatten();
    given
        .map(|(name, text)| {
            let shown: String = name.chars().take(64).collect();
            Ok((name.clone(), base64_bytes(&format!("robot.meshes.{shown}"), text)?))
        })
        .collect()
}

fn dh_row(json: &DhRowJson) -> DhRow {
    DhRow {
        a_m: json.a,
        alpha_rad: json.alpha,
        d_m: json.d,
        theta_offset_rad: json.theta,
        name: json.name.clone(),
        lower_rad: json.min,
        upper_rad: json.max,
        max_speed_rad_per_s: json.max_speed,
        max_acceleration_rad_per_s2: json.max_acceleration,
    }
}

/// The catalogue.
pub fn robot_summaries() -> Vec<RobotSummary> {
    let summary = |name: &str| {
        let joints = RobotModel::named(name).map_or(0, |model| model.joints.len() as u32);
        RobotSummary { model: name.to_owned(), joints }
    };
    RobotModel::names().into_iter().map(summary).collect()
}

//! Robots.

use super::base64_bytes;
use crate::api::problem::Problem;
use crate::api::wire::{DhConventionJson, DhRowJson, RobotJson, RobotSummary};
use crate::robot::{DhConvention, DhRow, Meshes, RobotModel};

/// The robot of a request.
///
/// # Errors
/// 422 unless exactly one description is given, and those of the description.
pub fn robot(json: &RobotJson) -> Result<RobotModel, Problem> {
    match (&json.model, &json.dh, &json.urdf) {
        (Some(name), None, None) => Ok(RobotModel::named(name)?),
        (None, Some(rows), None) => {
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

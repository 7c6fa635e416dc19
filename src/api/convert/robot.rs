//! Robots.

use crate::api::problem::Problem;
use crate::api::wire::{DhConventionJson, DhRowJson, JointLimitJson, RobotDetails, RobotJson, RobotSummary};
use crate::robot::{DhConvention, DhRow, RobotModel};

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
            Ok(RobotModel::from_urdf(text, json.base_link.as_deref(), json.tip_link.as_deref())?)
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

/// One robot's numbers.
pub fn robot_details(model: &RobotModel) -> RobotDetails {
    RobotDetails {
        model: model.name.clone(),
        base_frame: model.base_frame.clone(),
        flange_frame: model.flange_frame.clone(),
        joint_names: model.joints.iter().map(|joint| joint.name.clone()).collect(),
        limits: model
            .joints
            .iter()
            .map(|joint| JointLimitJson {
                min: joint.lower_rad,
                max: joint.upper_rad,
                max_speed: joint.max_speed_rad_per_s,
                max_acceleration: joint.max_acceleration_rad_per_s2,
            })
            .collect(),
        sources: model.sources.clone(),
    }
}

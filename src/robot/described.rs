//! Robots that the request describes: from a DH table.

use std::f64::consts::TAU;
use std::sync::Arc;

use super::bounds::{JERKS, JOINTS, LIMIT_WIDEST_RAD, RATES};
use super::geometric::GeometricKinematics;
use super::ur::UrShape;
use super::{
    Chain, DhConvention, DhRow, DhTable, Joint, Kinematics, Link, LinkShape, NumericKinematics, RobotError,
    RobotModel, RobotWarning, Source,
};
use crate::geometry::Pose;

/// Radius of the capsules that stand for links of unknown shape, metres.
pub(super) const DEFAULT_RADIUS_M: f64 = 0.05;

const LIMITS_SOURCE: &str = "the request's DH table; what it lacks is assumed and listed in the warnings.";

pub(super) fn from_dh(rows: &[DhRow], convention: DhConvention) -> Result<RobotModel, RobotError> {
    if !JOINTS.contains(&rows.len()) {
        return Err(RobotError::JointCount {
            found: rows.len(),
            least: *JOINTS.start(),
            most: *JOINTS.end(),
        });
    }
    let table = DhTable { convention, rows: rows.to_vec(), last_from_flange: Pose::identity() };
    let chain = table.chain()?;
    let mut warnings = Vec::new();
    let joints = rows
        .iter()
        .enumerate()
        .map(|(i, row)| joint_from_row(i, row, &mut warnings))
        .collect::<Result<Vec<_>, _>>()?;
    warnings.push(RobotWarning::description(format!(
        "the links' shapes are unknown: capsules of {DEFAULT_RADIUS_M} m radius between the joints stand for them"
    )));
    Ok(RobotModel {
        name: "dh".to_owned(),
        links: links_along(&chain, DEFAULT_RADIUS_M),
        dh: Some(table),
        kinematics: kinematics_of(chain, &joints)?,
        joints,
        base_frame: "base".to_owned(),
        flange_frame: "flange".to_owned(),
        sources: Source::of_model([
            "the request's DH table.",
            LIMITS_SOURCE,
            LIMITS_SOURCE,
            LIMITS_SOURCE,
            "assumed: capsules of 0.05 m radius between the joints' frames.",
        ]),
        warnings,
    })
}

/// The kinematics of a described chain.
///
/// The structure of the UR arms comes first: the numeric solver finds all of its branches.
pub(super) fn kinematics_of(chain: Chain, joints: &[Joint]) -> Result<Arc<dyn Kinematics>, RobotError> {
    let three_parallel = UrShape::of(&chain).is_some();
    if !three_parallel && let Some(found) = GeometricKinematics::new(chain.clone(), joints.to_vec())? {
        return Ok(Arc::new(found));
    }
    Ok(Arc::new(NumericKinematics::new(chain, joints.to_vec())?))
}

fn joint_from_row(index: usize, row: &DhRow, warnings: &mut Vec<RobotWarning>) -> Result<Joint, RobotError> {
    let name = match &row.name {
        Some(name) => super::error::short(name),
        None => format!("joint_{}", index + 1),
    };
    let mut given_or = |value: Option<f64>, field: &str, assumed: f64, unit: &str| {
        value.unwrap_or_else(|| {
            let message = format!("{name}: no {field} given, {assumed:.4} {unit} assumed");
            warnings.push(RobotWarning::description(message));
            assumed
        })
    };
    let joint = Joint {
        lower_rad: given_or(row.lower_rad, "lower limit", -TAU, "rad"),
        upper_rad: given_or(row.upper_rad, "upper limit", TAU, "rad"),
        max_speed_rad_per_s: given_or(
            row.max_speed_rad_per_s,
            "speed limit",
            RobotModel::ASSUMED_SPEED_RAD_PER_S,
            "rad/s",
        ),
        max_acceleration_rad_per_s2: given_or(
            row.max_acceleration_rad_per_s2,
            "acceleration limit",
            RobotModel::ASSUMED_ACCELERATION_RAD_PER_S2,
            "rad/s2",
        ),
        max_jerk_rad_per_s3: None,
        name,
        continuous: false,
    };
    check_joint(&joint).map_err(|error| match error {
        RobotError::OutOfRange { field, value, least, most, hint, .. } => {
            RobotError::DhRow { row: index, field: dh_member(field), value, least, most, hint }
        }
        other => other,
    })?;
    warnings.extend(RobotWarning::speed_in_degrees(&joint));
    Ok(joint)
}

/// What a request calls a joint's limit.
fn dh_member(field: &'static str) -> &'static str {
    match field {
        "lower limit" => "min",
        "upper limit" => "max",
        "speed limit" => "max_speed",
        "acceleration limit" => "max_acceleration",
        other => other,
    }
}

/// Whether a described joint's limits are numbers an arm can have.
pub(super) fn check_joint(joint: &Joint) -> Result<(), RobotError> {
    let refuse = |field, value, least, most, hint| {
        Err(RobotError::OutOfRange { joint: joint.name.clone(), field, value, least, most, hint })
    };
    const DEGREES: &str = "; degrees given as radians?";
    if !(-LIMIT_WIDEST_RAD..=LIMIT_WIDEST_RAD).contains(&joint.lower_rad) {
        return refuse("lower limit", joint.lower_rad, -LIMIT_WIDEST_RAD, LIMIT_WIDEST_RAD, DEGREES);
    }
    // Below or at the lower limit there is no room to move; NaN fails the comparison too.
    if !(joint.upper_rad > joint.lower_rad && joint.upper_rad <= LIMIT_WIDEST_RAD) {
        let hint = if joint.upper_rad > LIMIT_WIDEST_RAD { DEGREES } else { "" };
        return refuse("upper limit", joint.upper_rad, joint.lower_rad, LIMIT_WIDEST_RAD, hint);
    }
    for (field, value) in [
        ("speed limit", joint.max_speed_rad_per_s),
        ("acceleration limit", joint.max_acceleration_rad_per_s2),
    ] {
        if !RATES.contains(&value) {
            return refuse(field, value, *RATES.start(), *RATES.end(), "");
        }
    }
    if let Some(jerk) = joint.max_jerk_rad_per_s3
        && !JERKS.contains(&jerk)
    {
        return refuse("jerk limit", jerk, *JERKS.start(), *JERKS.end(), "");
    }
    Ok(())
}

/// Links as capsules from each joint's frame to the next one's; the last one
/// ends a radius short of the flange, so that a tool there does not touch it.
pub(super) fn links_along(chain: &Chain, radius_m: f64) -> Vec<Link> {
    let segments = chain.segments();
    let ends = segments.iter().map(|s| s.previous_from_joint.translation.vector);
    let flange = chain.last_link_from_flange().translation.vector;
    let shortened =
        if flange.norm() > radius_m { flange * (1.0 - radius_m / flange.norm()) } else { flange * 0.0 };
    ends.chain([shortened])
        .enumerate()
        .map(|(i, end)| {
            let name = if i == 0 { "base".to_owned() } else { format!("link_{i}") };
            // A piece shorter than the radius is inside its neighbours' round ends.
            let start =
                if i == 0 && end.norm() > radius_m { end * (radius_m / end.norm()) } else { end * 0.0 };
            let long_enough = (end - start).norm() > radius_m;
            let capsule = LinkShape::capsule(start.into(), end.into(), radius_m);
            Link { name, shapes: if long_enough { vec![capsule] } else { Vec::new() } }
        })
        .collect()
}

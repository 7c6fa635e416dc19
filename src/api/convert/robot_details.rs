//! A robot's numbers with their sources.

use super::pose_json;
use crate::api::wire::{
    DhConventionJson, JointLimitJson, KinematicsJson, KinematicsRowJson, LinkJson, LinkShapeJson,
    RobotDetails, SolverJson, SourceJson,
};
use crate::geometry::Pose;
use crate::robot::{DhConvention, DhTable, Joint, LinkShape, RobotModel};

/// One robot's numbers.
pub fn robot_details(model: &RobotModel) -> RobotDetails {
    let solver = model.solver();
    let joints = std::iter::once(None).chain(model.joints.iter().map(|joint| Some(joint.name.clone())));
    RobotDetails {
        model: model.name.clone(),
        base_frame: model.base_frame.clone(),
        flange_frame: model.flange_frame.clone(),
        solver: SolverJson { name: solver.name().to_owned(), description: solver.description() },
        joint_names: model.joints.iter().map(|joint| joint.name.clone()).collect(),
        limits: model.joints.iter().map(limit).collect(),
        kinematics: kinematics(model.dh.as_ref()),
        links: model
            .links
            .iter()
            .zip(joints)
            .map(|(link, joint)| LinkJson {
                name: link.name.clone(),
                joint,
                shapes: link.shapes.iter().map(shape).collect(),
            })
            .collect(),
        sources: model
            .sources
            .iter()
            .map(|source| SourceJson { group: source.group.name().to_owned(), source: source.text.clone() })
            .collect(),
    }
}

fn limit(joint: &Joint) -> JointLimitJson {
    JointLimitJson {
        min: joint.lower_rad,
        max: joint.upper_rad,
        max_speed: joint.max_speed_rad_per_s,
        max_acceleration: joint.max_acceleration_rad_per_s2,
        max_jerk: joint.max_jerk_rad_per_s3,
    }
}

fn kinematics(table: Option<&DhTable>) -> KinematicsJson {
    let row = |row: &crate::robot::DhRow| KinematicsRowJson {
        d: row.d_m,
        a: row.a_m,
        alpha: row.alpha_rad,
        theta: row.theta_offset_rad,
    };
    KinematicsJson {
        convention: match table.map(|table| table.convention) {
            Some(DhConvention::Modified) => DhConventionJson::Modified,
            _ => DhConventionJson::Standard,
        },
        dh: table.map(|table| table.rows.iter().map(row).collect()).unwrap_or_default(),
        last_from_flange: pose_json(&table.map_or_else(Pose::identity, |table| table.last_from_flange)),
    }
}

fn shape(shape: &LinkShape) -> LinkShapeJson {
    match shape {
        LinkShape::Capsule { from_in_link, to_in_link, radius_m } => LinkShapeJson::Capsule {
            from: from_in_link.coords.into(),
            to: to_in_link.coords.into(),
            radius: *radius_m,
        },
        LinkShape::Cuboid { link_from_box, half_extents_m } => {
            LinkShapeJson::Box { pose: pose_json(link_from_box), size: (half_extents_m * 2.0).into() }
        }
        LinkShape::Cylinder { link_from_cylinder, half_length_m, radius_m } => LinkShapeJson::Cylinder {
            pose: pose_json(link_from_cylinder),
            length: 2.0 * half_length_m,
            radius: *radius_m,
        },
    }
}

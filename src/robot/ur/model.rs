//! The UR arms as robot models.

use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use super::UrKinematics;
use super::links::{girth, links};
use super::parameters::{JOINT_NAMES, SHEETS, Sheet};
use crate::robot::{Joint, RobotError, RobotModel};

/// Index of the elbow among the joints.
const ELBOW: usize = 2;

/// The UR arm called `name`, or `None` if there is none.
pub fn model(name: &str) -> Option<Result<RobotModel, RobotError>> {
    SHEETS.iter().find(|sheet| sheet.name == name).map(build)
}

fn build(sheet: &Sheet) -> Result<RobotModel, RobotError> {
    let joints = joints(&sheet.max_speed_deg_per_s);
    Ok(RobotModel {
        name: sheet.name.to_owned(),
        kinematics: Arc::new(UrKinematics::new(sheet.parameters, joints.clone())?),
        joints,
        links: links(&sheet.parameters, &girth(sheet.name)),
        base_frame: "base".to_owned(),
        flange_frame: "tool0".to_owned(),
        sources: sources(),
        warnings: Vec::new(),
    })
}

fn joints(max_speed_deg_per_s: &[f64; 6]) -> Vec<Joint> {
    let named = JOINT_NAMES.iter().zip(max_speed_deg_per_s).enumerate();
    named
        .map(|(i, (name, speed))| {
            let bound = if i == ELBOW { PI } else { TAU };
            Joint {
                name: (*name).to_owned(),
                lower_rad: -bound,
                upper_rad: bound,
                max_speed_rad_per_s: speed.to_radians(),
                max_acceleration_rad_per_s2: RobotModel::ASSUMED_ACCELERATION_RAD_PER_S2,
                max_jerk_rad_per_s3: None,
                continuous: false,
            }
        })
        .collect()
}

fn sources() -> Vec<String> {
    [
        "Lengths and twists: the maker's published DH parameters (standard convention, metres); \
         frame `base` to `tool0`. ROS `base_link` is `base` turned by pi about z. A real arm's \
         calibration differs by millimetres: send its URDF or DH table instead.",
        "Position limits: +-360 degrees as published; the elbow is held to +-180 degrees, because \
         a wider elbow cuts the free space into parts that no path joins.",
        "Speed limits: the maker's data sheet.",
        "Acceleration limits: assumed, 5 rad/s2 for every joint; the maker publishes none.",
        "Link shapes: capsules, approximations from the DH lengths and the outlines of the \
         housings; without cables, tool or camera.",
    ]
    .map(str::to_owned)
    .to_vec()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Point, Pose, Vector};
    use crate::robot::LinkShape;
    use std::f64::consts::FRAC_PI_2;

    fn flange(name: &str, q: [f64; 6]) -> Pose {
        RobotModel::named(name).unwrap().kinematics.forward(&q)
    }

    /// At zero the arm lies stretched along -x: the flange is at
    /// (a2 + a3, -(d4 + d6), d1 - d5) by adding the lengths by hand, and its z
    /// axis points along -y, the direction of the shoulder's axis.
    #[test]
    fn the_zero_posture_is_the_sum_of_the_lengths() {
        let pose = flange("ur5e", [0.0; 6]);
        let by_hand = Vector::new(-0.425 - 0.3922, -0.1333 - 0.0996, 0.1625 - 0.0997);
        assert!((pose.translation.vector - by_hand).norm() < 1e-12);
        assert!((pose.rotation * Vector::z() + Vector::y()).norm() < 1e-12);
        assert!((pose.rotation * Vector::x() - Vector::x()).norm() < 1e-12);
    }

    /// Shoulder lift at -90 degrees stands the arm upright: the lengths of both arms and d5 add up in z.
    #[test]
    fn the_upright_posture_is_the_sum_of_the_lengths() {
        for (name, d1, a2, a3, d4, d5, d6) in [
            ("ur3e", 0.15185, -0.24355, -0.2132, 0.13105, 0.08535, 0.0921),
            ("ur5", 0.089159, -0.425, -0.39225, 0.10915, 0.09465, 0.0823),
            ("ur10e", 0.1807, -0.6127, -0.57155, 0.17415, 0.11985, 0.11655),
        ] {
            let pose = flange(name, [0.0, -FRAC_PI_2, 0.0, -FRAC_PI_2, 0.0, 0.0]);
            let by_hand = Vector::new(0.0, -d4 - d6, d1 - a2 - a3 + d5);
            assert!(
                (pose.translation.vector - by_hand).norm() < 1e-12,
                "{name}: {}",
                pose.translation.vector
            );
        }
    }

    /// In the same posture the last link is on top: its capsules, mapped by
    /// the link poses, lie where the lengths put them.
    #[test]
    fn the_capsules_follow_the_links() {
        let robot = RobotModel::named("ur5e").unwrap();
        let poses = robot.kinematics.link_poses(&[0.0, -FRAC_PI_2, 0.0, -FRAC_PI_2, 0.0, 0.0]);
        assert_eq!(poses.len(), robot.links.len());
        let Some(LinkShape::Capsule { from_in_link, to_in_link, .. }) = robot.links[3].shapes.last() else {
            panic!("the forearm is a capsule")
        };
        let elbow = poses[3] * from_in_link;
        let wrist = poses[3] * to_in_link;
        assert!((elbow - Point::new(0.0, -0.007, 0.1625 + 0.425)).norm() < 1e-12);
        assert!((wrist - Point::new(0.0, -0.007, 0.1625 + 0.425 + 0.3922)).norm() < 1e-12);
    }
}

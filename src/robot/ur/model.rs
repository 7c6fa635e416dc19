//! The UR arms as robot models.

use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use super::UrKinematics;
use super::links::{girth, links};
use super::parameters::{JOINT_NAMES, SHEETS, Sheet};
use crate::geometry::Pose;
use crate::robot::{DhConvention, DhTable, Joint, RobotError, RobotModel, Source};

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
        dh: Some(DhTable {
            convention: DhConvention::Standard,
            rows: sheet.parameters.dh_rows().to_vec(),
            last_from_flange: Pose::identity(),
        }),
        sources: sources(sheet),
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

fn sources(sheet: &Sheet) -> Vec<Source> {
    let Sheet { name, manual, .. } = sheet;
    let limits = format!(
        "Universal Robots, {manual}; Universal_Robots_ROS2_Description, config/{name}/joint_limits.yaml"
    );
    // The smallest arms' last joint knows no end.
    let endless = if name.starts_with("ur3") && *name != "ur30" {
        " Wrist 3 turns without end; plans keep it within +-360 degrees."
    } else {
        ""
    };
    let positions = format!(
        "{limits}: +-360 degrees; the elbow is held to +-180 degrees, because a wider elbow cuts the free space \
         into parts that no path joins.{endless}"
    );
    Source::of_model([
        "Universal Robots, \"DH parameters for calculations of kinematics and dynamics\" (standard \
         convention); frame `base` to `tool0`. ROS `base_link` is `base` turned by pi about z. A real \
         arm's calibration differs by millimetres: send its URDF or DH table instead.",
        &positions,
        &format!("{limits}."),
        "assumed, 5 rad/s2 for every joint; the maker publishes none (its settings for MoveIt assume 5 too, \
         3.14 in later versions for the UR5e).",
        "assumed: capsules from the DH lengths and the outlines of the housings; without cables, tool or \
         camera.",
    ])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Point, Vector};
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
            ("ur3", 0.1519, -0.24365, -0.21325, 0.11235, 0.08535, 0.0819),
            ("ur10", 0.1273, -0.612, -0.5723, 0.163941, 0.1157, 0.0922),
            ("ur20", 0.2363, -0.862, -0.7287, 0.201, 0.1593, 0.1543),
            ("ur30", 0.2363, -0.637, -0.5037, 0.201, 0.1593, 0.1543),
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

    /// The data sheets' working radius lies between the stretched arms and the wrist's end
    /// beyond them; for the larger arms it is that end to a few millimetres.
    #[test]
    fn the_arms_reach_what_their_data_sheets_say() {
        for (name, reach_m, slack_m) in [
            ("ur3", 0.5, 0.06),
            ("ur5", 0.85, 0.07),
            ("ur16e", 0.9, 0.06),
            ("ur10", 1.3, 0.005),
            ("ur10e", 1.3, 0.005),
            ("ur20", 1.75, 0.005),
            ("ur30", 1.3, 0.005),
        ] {
            let sheet = SHEETS.iter().find(|sheet| sheet.name == name).unwrap();
            let p = sheet.parameters;
            let (arms_m, end_m) = (-p.a2_m - p.a3_m, -p.a2_m - p.a3_m + p.d5_m);
            assert!(arms_m < reach_m && (end_m - reach_m).abs() < slack_m, "{name}: {arms_m} {end_m}");
        }
    }
}

//! The dimensions of the UR arms.

use std::f64::consts::FRAC_PI_2;

use crate::robot::DhRow;

/// Standard DH parameters of a UR arm, metres; `alpha = [pi/2, 0, 0, pi/2, -pi/2, 0]`,
/// every other length is 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UrParameters {
    /// Height of the shoulder.
    pub d1_m: f64,
    /// Upper arm, negative.
    pub a2_m: f64,
    /// Forearm, negative.
    pub a3_m: f64,
    /// Offset of the wrist beside the arm's plane.
    pub d4_m: f64,
    /// Wrist 1 to wrist 2.
    pub d5_m: f64,
    /// Wrist 2 to flange.
    pub d6_m: f64,
}

/// The twists of every UR arm, radians.
pub(super) const TWISTS_RAD: [f64; 6] = [FRAC_PI_2, 0.0, 0.0, FRAC_PI_2, -FRAC_PI_2, 0.0];

/// The names of the joints of every UR arm.
pub(super) const JOINT_NAMES: [&str; 6] = [
    "shoulder_pan_joint",
    "shoulder_lift_joint",
    "elbow_joint",
    "wrist_1_joint",
    "wrist_2_joint",
    "wrist_3_joint",
];

/// What the data sheet of one arm says.
pub(super) struct Sheet {
    pub name: &'static str,
    pub parameters: UrParameters,
    pub max_speed_deg_per_s: [f64; 6],
    /// The maker's document with the joint speeds and ranges.
    pub manual: &'static str,
}

/// The names of the arms below.
pub const NAMES: [&str; 9] = ["ur3", "ur3e", "ur5", "ur5e", "ur10", "ur10e", "ur16e", "ur20", "ur30"];

const fn lengths(d1_m: f64, a2_m: f64, a3_m: f64, d4_m: f64, d5_m: f64, d6_m: f64) -> UrParameters {
    UrParameters { d1_m, a2_m, a3_m, d4_m, d5_m, d6_m }
}

/// The maker's published DH parameters and joint speeds, as its package
/// Universal_Robots_ROS2_Description has them (config/*/joint_limits.yaml, default_kinematics.yaml).
pub(super) const SHEETS: [Sheet; 9] = [
    Sheet {
        name: "ur3",
        parameters: lengths(0.1519, -0.24365, -0.21325, 0.11235, 0.08535, 0.0819),
        max_speed_deg_per_s: [180.0, 180.0, 180.0, 360.0, 360.0, 360.0],
        manual: "UR3 User Manual (CB3), version 3.13",
    },
    Sheet {
        name: "ur3e",
        parameters: lengths(0.15185, -0.24355, -0.2132, 0.13105, 0.08535, 0.0921),
        max_speed_deg_per_s: [180.0, 180.0, 180.0, 360.0, 360.0, 360.0],
        manual: "UR3e User Manual, version 5.8",
    },
    Sheet {
        name: "ur5",
        parameters: lengths(0.089159, -0.425, -0.39225, 0.10915, 0.09465, 0.0823),
        max_speed_deg_per_s: [180.0; 6],
        manual: "UR5 User Manual (CB3), version 3.13",
    },
    Sheet {
        name: "ur5e",
        parameters: lengths(0.1625, -0.425, -0.3922, 0.1333, 0.0997, 0.0996),
        max_speed_deg_per_s: [180.0; 6],
        manual: "UR5e User Manual, version 5.8",
    },
    Sheet {
        name: "ur10",
        parameters: lengths(0.1273, -0.612, -0.5723, 0.163941, 0.1157, 0.0922),
        max_speed_deg_per_s: [120.0, 120.0, 180.0, 180.0, 180.0, 180.0],
        manual: "UR10 User Manual (CB3), version 3.13",
    },
    Sheet {
        name: "ur10e",
        parameters: lengths(0.1807, -0.6127, -0.57155, 0.17415, 0.11985, 0.11655),
        max_speed_deg_per_s: [120.0, 120.0, 180.0, 180.0, 180.0, 180.0],
        manual: "UR10e User Manual, version 5.8",
    },
    Sheet {
        name: "ur16e",
        parameters: lengths(0.1807, -0.4784, -0.36, 0.17415, 0.11985, 0.11655),
        max_speed_deg_per_s: [120.0, 120.0, 180.0, 180.0, 180.0, 180.0],
        manual: "UR16e User Manual, version 5.8",
    },
    Sheet {
        name: "ur20",
        parameters: lengths(0.2363, -0.862, -0.7287, 0.201, 0.1593, 0.1543),
        max_speed_deg_per_s: [120.0, 120.0, 150.0, 210.0, 210.0, 210.0],
        manual: "UR20 User Manual, version 5.14",
    },
    Sheet {
        name: "ur30",
        parameters: lengths(0.2363, -0.637, -0.5037, 0.201, 0.1593, 0.1543),
        max_speed_deg_per_s: [120.0, 120.0, 150.0, 210.0, 210.0, 210.0],
        manual: "UR20 User Manual, version 5.14 (the maker gives the UR30 the same)",
    },
];

impl UrParameters {
    /// The DH table, standard convention, without limits.
    pub fn dh_rows(&self) -> [DhRow; 6] {
        let [t1, t2, t3, t4, t5, t6] = TWISTS_RAD;
        [
            DhRow::new(0.0, t1, self.d1_m, 0.0),
            DhRow::new(self.a2_m, t2, 0.0, 0.0),
            DhRow::new(self.a3_m, t3, 0.0, 0.0),
            DhRow::new(0.0, t4, self.d4_m, 0.0),
            DhRow::new(0.0, t5, self.d5_m, 0.0),
            DhRow::new(0.0, t6, self.d6_m, 0.0),
        ]
    }
}

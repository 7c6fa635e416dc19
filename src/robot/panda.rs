//! The Franka Panda: seven joints, numeric inverse kinematics.

use std::f64::consts::FRAC_PI_2;
use std::sync::Arc;

use super::dh::chain_from_dh;
use super::{DhConvention, DhRow, Joint, Link, LinkShape, NumericKinematics, RobotError, RobotModel};
use crate::geometry::Pose;

/// The model's name.
pub(super) const NAME: &str = "panda";

/// Modified DH: a, d (metres), alpha (radians) of rows 1 to 7.
const GEOMETRY: [(f64, f64, f64); 7] = [
    (0.0, 0.333, 0.0),
    (0.0, 0.0, -FRAC_PI_2),
    (0.0, 0.316, FRAC_PI_2),
    (0.0825, 0.0, FRAC_PI_2),
    (-0.0825, 0.384, -FRAC_PI_2),
    (0.0, 0.0, FRAC_PI_2),
    (0.088, 0.0, FRAC_PI_2),
];

/// From joint 7 to the flange along z, metres.
const FLANGE_M: f64 = 0.107;

/// Lower, upper (radians), speed (rad/s), acceleration (rad/s2) of joints 1 to 7.
const LIMITS: [(f64, f64, f64, f64); 7] = [
    (-2.8973, 2.8973, 2.175, 15.0),
    (-1.7628, 1.7628, 2.175, 7.5),
    (-2.8973, 2.8973, 2.175, 10.0),
    (-3.0718, -0.0698, 2.175, 12.5),
    (-2.8973, 2.8973, 2.61, 15.0),
    (-0.0175, 3.7525, 2.61, 20.0),
    (-2.8973, 2.8973, 2.61, 20.0),
];

/// The arm without its hand.
pub(super) fn model() -> Result<RobotModel, RobotError> {
    let rows = GEOMETRY.map(|(a, d, alpha)| DhRow::new(a, alpha, d, 0.0));
    let chain = chain_from_dh(&rows, DhConvention::Modified, &Pose::translation(0.0, 0.0, FLANGE_M))?;
    let joints: Vec<Joint> = LIMITS
        .iter()
        .enumerate()
        .map(|(i, &(lower_rad, upper_rad, max_speed_rad_per_s, max_acceleration_rad_per_s2))| Joint {
            name: format!("panda_joint{}", i + 1),
            lower_rad,
            upper_rad,
            max_speed_rad_per_s,
            max_acceleration_rad_per_s2,
            max_jerk_rad_per_s3: None,
            continuous: false,
        })
        .collect();
    Ok(RobotModel {
        name: NAME.to_owned(),
        kinematics: Arc::new(NumericKinematics::new(chain, joints.clone())?),
        joints,
        links: links(),
        base_frame: "panda_link0".to_owned(),
        flange_frame: "panda_link8".to_owned(),
        sources: [
            "Lengths and twists: the maker's published DH parameters (modified convention), flange at 0.107 m.",
            "Position, speed and acceleration limits: the maker's interface specification.",
            "Link shapes: capsules, approximations from the DH lengths and the outlines of the housings; \
             without hand, cables or camera.",
        ]
        .map(str::to_owned)
        .to_vec(),
        warnings: Vec::new(),
    })
}

/// The links as capsules. Frames: link i turns with joint i, z along that
/// joint's axis, origin before the row's `d`.
fn links() -> Vec<Link> {
    type Capsule = ([f64; 3], [f64; 3], f64);
    let shapes: [&[Capsule]; 8] = [
        &[([-0.10, 0.0, 0.07], [0.0, 0.0, 0.07], 0.065), ([0.0, 0.0, 0.07], [0.0, 0.0, 0.13], 0.065)],
        &[([0.0, 0.0, 0.22], [0.0, 0.0, 0.333], 0.07)],
        &[([0.0, 0.0, -0.05], [0.0, 0.0, 0.05], 0.07), ([0.0, 0.0, 0.0], [0.0, -0.12, 0.0], 0.065)],
        &[([0.0, 0.0, 0.22], [0.0, 0.0, 0.316], 0.065), ([0.0, 0.0, 0.316], [0.0825, 0.0, 0.316], 0.06)],
        &[([0.0, 0.0, -0.05], [0.0, 0.0, 0.05], 0.065), ([0.0, 0.0, 0.0], [-0.0825, 0.08, 0.0], 0.06)],
        &[([0.0, 0.0, 0.12], [0.0, 0.0, 0.18], 0.065), ([0.0, 0.06, 0.22], [0.0, 0.06, 0.31], 0.045)],
        &[([0.0, 0.0, -0.05], [0.0, 0.0, 0.01], 0.06), ([0.0, 0.0, 0.0], [0.088, 0.0, 0.0], 0.05)],
        &[([0.0, 0.0, -0.02], [0.0, 0.0, 0.06], 0.045)],
    ];
    shapes
        .iter()
        .enumerate()
        .map(|(i, capsules)| Link {
            name: format!("panda_link{i}"),
            shapes: capsules.iter().map(|&(from, to, radius)| LinkShape::capsule(from, to, radius)).collect(),
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Vector;

    /// At zero the arm stands upright with its hand over the elbow's offset:
    /// x = 0.0825 - 0.0825 + 0.088, z = 0.333 + 0.316 + 0.384 - 0.107, flange looking down.
    #[test]
    fn the_zero_posture_is_the_sum_of_the_lengths() {
        let pose = model().unwrap().kinematics.forward(&[0.0; 7]);
        assert!((pose.translation.vector - Vector::new(0.088, 0.0, 0.926)).norm() < 1e-12);
        assert!((pose.rotation * Vector::z() + Vector::z()).norm() < 1e-12);
    }
}

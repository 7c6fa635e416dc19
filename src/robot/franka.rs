//! The seven-joint arms of Franka: Panda and Research 3.

use std::f64::consts::FRAC_PI_2;

use super::described::kinematics_of;
use super::{DhConvention, DhRow, DhTable, Joint, Link, LinkShape, RobotError, RobotModel, Source};
use crate::geometry::Pose;

/// The names of the arms below.
pub(super) const NAMES: [&str; 2] = ["panda", "fr3"];

/// Modified DH of both arms: a, d (metres), alpha (radians) of rows 1 to 7.
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

/// What the makers' documents say of one arm.
struct Sheet {
    name: &'static str,
    /// Lower, upper (radians), speed (rad/s), acceleration (rad/s2) of joints 1 to 7.
    limits: [(f64, f64, f64, f64); 7],
    sources: [&'static str; 5],
}

const GEOMETRY_SOURCE: &str = "Franka Control Interface documentation, Denavit-Hartenberg parameters (modified \
     convention), flange at 0.107 m. A real arm's calibration differs: send its URDF or DH table instead.";

const SHAPES_SOURCE: &str = "assumed: capsules from the DH lengths and the outlines of the housings; without \
     hand, cables or camera.";

const PANDA: Sheet = Sheet {
    name: "panda",
    limits: [
        (-2.8973, 2.8973, 2.175, 15.0),
        (-1.7628, 1.7628, 2.175, 7.5),
        (-2.8973, 2.8973, 2.175, 10.0),
        (-3.0718, -0.0698, 2.175, 12.5),
        (-2.8973, 2.8973, 2.61, 15.0),
        (-0.0175, 3.7525, 2.61, 20.0),
        (-2.8973, 2.8973, 2.61, 20.0),
    ],
    sources: [
        GEOMETRY_SOURCE,
        "Franka Control Interface documentation, limits for Panda.",
        "Franka Control Interface documentation, limits for Panda.",
        "Franka Control Interface documentation, limits for Panda.",
        SHAPES_SOURCE,
    ],
};

const FR3: Sheet = Sheet {
    name: "fr3",
    limits: [
        (-2.7437, 2.7437, 2.62, 10.0),
        (-1.7837, 1.7837, 2.62, 10.0),
        (-2.9007, 2.9007, 2.62, 10.0),
        (-3.0421, -0.1518, 2.62, 10.0),
        (-2.8065, 2.8065, 5.26, 10.0),
        (0.5445, 4.5169, 4.18, 10.0),
        (-3.0159, 3.0159, 5.26, 10.0),
    ],
    sources: [
        GEOMETRY_SOURCE,
        "Franka Control Interface documentation, limits for Franka Research 3.",
        "Franka Control Interface documentation, limits for Franka Research 3: the largest value of each \
         joint. The published limit falls towards the ends of the range, which is not modelled: give \
         lower speeds or narrower ranges in the request for views near the ends.",
        "Franka Control Interface documentation, limits for Franka Research 3.",
        SHAPES_SOURCE,
    ],
};

/// The arm called `name` without its hand, or `None` if there is none.
pub(super) fn model(name: &str) -> Option<Result<RobotModel, RobotError>> {
    [PANDA, FR3].iter().find(|sheet| sheet.name == name).map(build)
}

fn build(sheet: &Sheet) -> Result<RobotModel, RobotError> {
    let name = sheet.name;
    let dh = DhTable {
        convention: DhConvention::Modified,
        rows: GEOMETRY.iter().map(|&(a, d, alpha)| DhRow::new(a, alpha, d, 0.0)).collect(),
        last_from_flange: Pose::translation(0.0, 0.0, FLANGE_M),
    };
    let joints: Vec<Joint> = sheet
        .limits
        .iter()
        .enumerate()
        .map(|(i, &(lower_rad, upper_rad, max_speed_rad_per_s, max_acceleration_rad_per_s2))| Joint {
            name: format!("{name}_joint{}", i + 1),
            lower_rad,
            upper_rad,
            max_speed_rad_per_s,
            max_acceleration_rad_per_s2,
            max_jerk_rad_per_s3: None,
            continuous: false,
        })
        .collect();
    Ok(RobotModel {
        name: name.to_owned(),
        kinematics: kinematics_of(dh.chain()?, &joints)?,
        joints,
        links: links(name),
        dh: Some(dh),
        base_frame: format!("{name}_link0"),
        flange_frame: format!("{name}_link8"),
        sources: Source::of_model(sheet.sources),
        warnings: Vec::new(),
    })
}

/// The links as capsules. Frames: link i turns with joint i, z along that
/// joint's axis, origin before the row's `d`.
fn links(name: &str) -> Vec<Link> {
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
            name: format!("{name}_link{i}"),
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
        for name in NAMES {
            let pose = model(name).unwrap().unwrap().kinematics.forward(&[0.0; 7]);
            assert!((pose.translation.vector - Vector::new(0.088, 0.0, 0.926)).norm() < 1e-12);
            assert!((pose.rotation * Vector::z() + Vector::z()).norm() < 1e-12);
        }
    }

    /// The makers' "ready" posture, elbow and wrist square: x = 0.0825 + 0.384 + 0.088 less the
    /// elbow's way back, by adding the pieces along x and z.
    #[test]
    fn the_square_posture_is_the_sum_of_the_lengths() {
        let pose = model("fr3")
            .unwrap()
            .unwrap()
            .kinematics
            .forward(&[0.0, 0.0, 0.0, -FRAC_PI_2, 0.0, FRAC_PI_2, 0.0]);
        let by_hand = Vector::new(0.0825 + 0.384 + 0.088, 0.0, 0.333 + 0.316 + 0.0825 - 0.107);
        assert!((pose.translation.vector - by_hand).norm() < 1e-12, "{}", pose.translation.vector);
    }
}

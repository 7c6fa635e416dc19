//! The seven-joint arms of Franka: Panda and Research 3.

use std::f64::consts::FRAC_PI_2;

use super::braking::Braking;
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
    /// Lower, upper (radians), speed (rad/s), acceleration (rad/s2), jerk (rad/s3) of joints 1 to 7.
    limits: [(f64, f64, f64, f64, f64); 7],
    /// Where the speed limit falls towards the ends of the range.
    braking: Option<[Braking; 7]>,
    sources: [&'static str; 5],
}

const GEOMETRY_SOURCE: &str = "Franka Control Interface documentation, Denavit-Hartenberg parameters (modified \
     convention), flange at 0.107 m; the same lengths as in franka_description, robots/fer/kinematics.yaml. A \
     real arm's calibration differs: send its URDF or DH table instead.";

const SHAPES_SOURCE: &str = "assumed: capsules from the DH lengths and the outlines of the housings; without \
     hand, cables or camera.";

const PANDA_LIMITS: &str = "Franka Control Interface documentation, limits for Panda.";

const PANDA: Sheet = Sheet {
    name: "panda",
    limits: [
        (-2.8973, 2.8973, 2.175, 15.0, 7500.0),
        (-1.7628, 1.7628, 2.175, 7.5, 3750.0),
        (-2.8973, 2.8973, 2.175, 10.0, 5000.0),
        (-3.0718, -0.0698, 2.175, 12.5, 6250.0),
        (-2.8973, 2.8973, 2.61, 15.0, 7500.0),
        (-0.0175, 3.7525, 2.61, 20.0, 10000.0),
        (-2.8973, 2.8973, 2.61, 20.0, 10000.0),
    ],
    braking: None,
    sources: [
        GEOMETRY_SOURCE,
        PANDA_LIMITS,
        PANDA_LIMITS,
        "Franka Control Interface documentation, limits for Panda, jerks included (libfranka, \
         rate_limiting.h, has the same).",
        SHAPES_SOURCE,
    ],
};

const FR3: Sheet = Sheet {
    name: "fr3",
    limits: [
        (-2.7437, 2.7437, 2.62, 10.0, 5000.0),
        (-1.7837, 1.7837, 2.62, 10.0, 5000.0),
        (-2.9007, 2.9007, 2.62, 10.0, 5000.0),
        (-3.0421, -0.1518, 2.62, 10.0, 5000.0),
        (-2.8065, 2.8065, 5.26, 10.0, 5000.0),
        (0.5445, 4.5169, 4.18, 10.0, 5000.0),
        (-3.0159, 3.0159, 5.26, 10.0, 5000.0),
    ],
    braking: Some([
        Braking::new(0.30, 6.0, -2.7501, 2.7501),
        Braking::new(0.20, 2.585, -1.7918, 1.7918),
        Braking::new(0.20, 3.5, -2.9065, 2.9065),
        Braking::new(0.30, 4.0, -3.0481, -0.1458),
        Braking::new(0.35, 17.0, -2.8101, 2.8101),
        Braking::new(0.35, 5.5, 0.54092, 4.5205),
        Braking::new(0.35, 17.0, -3.0196, 3.0196),
    ]),
    sources: [
        GEOMETRY_SOURCE,
        "Franka Control Interface documentation, limits for Franka Research 3 (franka_description, \
         robots/fr3/joint_limits.yaml), each end moved in by 1 to 3 degrees, so that no motion within \
         range and acceleration limits breaks the speed limit that falls towards the ends.",
        "Franka Control Interface documentation, limits for Franka Research 3: the largest value of each \
         joint (franka_description, robots/fr3/joint_limits.yaml). The published limit falls towards the \
         ends of the range (libfranka, rate_limiting.h); ranges and accelerations are chosen so that plans \
         keep it. Wider ranges or accelerations in a request's limits may break it near the ends.",
        "Franka Control Interface documentation, limits for Franka Research 3, 10 rad/s2 and 5000 rad/s3; \
         accelerations of joints 1 to 4 and 6 are held to 0.8 times the deceleration that the falling speed \
         limit allows (libfranka, rate_limiting.h).",
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
    let joint =
        |(i, &(lower_rad, upper_rad, speed, acceleration, jerk)): (usize, &(f64, f64, f64, f64, f64))| {
            let joint = Joint {
                name: format!("{name}_joint{}", i + 1),
                lower_rad,
                upper_rad,
                max_speed_rad_per_s: speed,
                max_acceleration_rad_per_s2: acceleration,
                max_jerk_rad_per_s3: Some(jerk),
                continuous: false,
            };
            let braking = sheet.braking.as_ref().and_then(|braking| braking.get(i));
            braking.map_or(joint.clone(), |braking| braking.kept_by(joint))
        };
    let joints: Vec<Joint> = sheet.limits.iter().enumerate().map(joint).collect();
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

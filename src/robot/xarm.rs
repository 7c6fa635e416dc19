//! The xArm 6 of UFACTORY: axes 5 and 6 pass each other at 76 mm.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use super::described::kinematics_of;
use super::{DhConvention, DhRow, DhTable, Joint, Link, LinkShape, RobotError, RobotModel, Source};
use crate::geometry::Pose;

/// The model's name.
pub(super) const NAME: &str = "xarm6";

/// Modified DH: a, d (metres), alpha, offset (radians) of rows 1 to 6. The
/// upper arm's 0.28948866 m and 1.3849179 rad are the hypotenuse of 0.2845 m
/// up and 0.0535 m forward.
const GEOMETRY: [(f64, f64, f64, f64); 6] = [
    (0.0, 0.267, 0.0, 0.0),
    (0.0, 0.0, -FRAC_PI_2, -1.3849179),
    (0.28948866, 0.0, 0.0, 1.3849179),
    (0.0775, 0.3425, -FRAC_PI_2, 0.0),
    (0.0, 0.0, FRAC_PI_2, 0.0),
    (0.076, 0.097, -FRAC_PI_2, 0.0),
];

/// Lower and upper position limits, radians.
const LIMITS: [(f64, f64); 6] =
    [(-TAU, TAU), (-2.059, 2.0944), (-3.927, 0.19198), (-TAU, TAU), (-1.69297, PI), (-TAU, TAU)];

/// Every joint's speed, rad/s: 180 degrees a second, rounded down as the maker's URDF does.
#[allow(clippy::approx_constant, reason = "the maker's number, a little below pi")]
const SPEED_RAD_PER_S: f64 = 3.14;

/// The arm without a tool.
pub(super) fn model() -> Result<RobotModel, RobotError> {
    let dh = DhTable {
        convention: DhConvention::Modified,
        rows: GEOMETRY.iter().map(|&(a, d, alpha, offset)| DhRow::new(a, alpha, d, offset)).collect(),
        last_from_flange: Pose::identity(),
    };
    let joints: Vec<Joint> = LIMITS
        .iter()
        .enumerate()
        .map(|(i, &(lower_rad, upper_rad))| Joint {
            name: format!("joint{}", i + 1),
            lower_rad,
            upper_rad,
            max_speed_rad_per_s: SPEED_RAD_PER_S,
            max_acceleration_rad_per_s2: RobotModel::ASSUMED_ACCELERATION_RAD_PER_S2,
            max_jerk_rad_per_s3: None,
            continuous: false,
        })
        .collect();
    Ok(RobotModel {
        name: NAME.to_owned(),
        kinematics: kinematics_of(dh.chain()?, &joints)?,
        joints,
        links: links(),
        dh: Some(dh),
        base_frame: "link_base".to_owned(),
        flange_frame: "link_eef".to_owned(),
        sources: Source::of_model([
            "UFACTORY xArm user manual, kinematics of xArm 6 (modified DH parameters); the same lengths as in \
             the maker's xarm_ros2, xarm_description/urdf/xarm6/xarm6.urdf.xacro. A real arm's calibration \
             differs: send its URDF or DH table instead.",
            "UFACTORY xArm user manual, joint ranges of xArm 6 (+-360, -118..120, -225..11, +-360, -97..180, \
             +-360 degrees), in radians as in the maker's xarm6.urdf.xacro.",
            "UFACTORY xArm user manual, 180 degrees a second for every joint; 3.14 rad/s in the maker's \
             xarm6.urdf.xacro. The maker's settings for MoveIt hold every joint to 2.14 rad/s.",
            "assumed, 5 rad/s2 for every joint: the largest setting of the maker's software is no rated value.",
            "assumed: capsules from the DH lengths and the outlines of the housings; without cables, tool or \
             camera.",
        ]),
        warnings: Vec::new(),
    })
}

/// The links as capsules. Frames: link i turns with joint i, z along that
/// joint's axis, origin before the row's `d`; link 2 and link 3 at their DH angles.
fn links() -> Vec<Link> {
    // In the frame of link 2 the elbow lies along x; the housing goes up 0.2845 m and then
    // forward 0.0535 m, which is a knee beside that line.
    let (up_m, forward_m, length_m) = (0.2845_f64, 0.0535_f64, 0.28948866_f64);
    let knee = [up_m * up_m / length_m, -up_m * forward_m / length_m, 0.0];
    let elbow = [length_m, 0.0, 0.0];
    type Capsule = ([f64; 3], [f64; 3], f64);
    let shapes: [Vec<Capsule>; 7] = [
        vec![([0.0, 0.0, 0.075], [0.0, 0.0, 0.14], 0.06)],
        vec![([0.0, 0.0, 0.267], [0.0, 0.0, 0.23], 0.065)],
        vec![([0.0; 3], knee, 0.055), (knee, elbow, 0.055)],
        vec![([0.0; 3], [0.0775, 0.0, 0.0], 0.05), ([0.0775, 0.0, 0.0], [0.0775, 0.12, 0.0], 0.05)],
        vec![([0.0, 0.0, 0.18], [0.0, 0.0, 0.3425], 0.045)],
        vec![([0.0; 3], [0.076, 0.0, 0.0], 0.045)],
        vec![([0.0, 0.0, 0.0], [0.0, 0.0, 0.055], 0.04)],
    ];
    let names = ["link_base", "link1", "link2", "link3", "link4", "link5", "link6"];
    names
        .iter()
        .zip(shapes)
        .map(|(name, capsules)| Link {
            name: (*name).to_owned(),
            shapes: capsules
                .into_iter()
                .map(|(from, to, radius)| LinkShape::capsule(from, to, radius))
                .collect(),
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Vector;

    /// The maker's zero posture: the tool looks down at x = 207 mm, z = 112 mm. The published
    /// angle of the upper arm is rounded: 2 um at the flange.
    #[test]
    fn the_zero_posture_is_the_makers() {
        let pose = model().unwrap().kinematics.forward(&[0.0; 6]);
        assert!(
            (pose.translation.vector - Vector::new(0.207, 0.0, 0.112)).norm() < 5e-6,
            "{}",
            pose.translation.vector
        );
        assert!((pose.rotation * Vector::z() + Vector::z()).norm() < 1e-6);
        assert!((pose.rotation * Vector::x() - Vector::x()).norm() < 1e-6);
    }
}

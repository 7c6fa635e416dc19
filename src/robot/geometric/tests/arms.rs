//! Arms to test with.

use std::f64::consts::{FRAC_PI_2, TAU};

use nalgebra::{Translation3, UnitQuaternion};

use crate::geometry::{Direction, Pose, Vector};
use crate::robot::{
    Chain, DhConvention, DhRow, InverseSolutions, Joint, Kinematics, NumericKinematics, RobotModel, Segment,
};

/// An arm with parallel axes 2 and 3 and a spherical wrist by the seven lengths
/// of Brandstoetter et al. 2014: a1, a2, b, c1, c2, c3, c4 (metres).
pub fn industrial([a1, a2, b, c1, c2, c3, c4]: [f64; 7]) -> RobotModel {
    let rows = [
        DhRow::new(a1, -FRAC_PI_2, c1, 0.0),
        DhRow::new(c2, 0.0, 0.0, -FRAC_PI_2),
        DhRow::new(-a2, -FRAC_PI_2, b, 0.0),
        DhRow::new(0.0, FRAC_PI_2, c3, 0.0),
        DhRow::new(0.0, -FRAC_PI_2, 0.0, 0.0),
        DhRow::new(0.0, 0.0, c4, 0.0),
    ];
    RobotModel::from_dh(&rows, DhConvention::Standard).unwrap()
}

/// Lengths in the table of that paper: KUKA KR6 R700 sixx, Fanuc R2000iB/200R, Staubli TX40,
/// ABB IRB 2400/10, Katana 450 6M90A; and an Adept Viper s650 (as data sheets give them).
pub const INDUSTRIAL: [[f64; 7]; 6] = [
    [0.025, -0.035, 0.0, 0.400, 0.315, 0.365, 0.080],
    [0.720, -0.225, 0.0, 0.600, 1.075, 1.280, 0.235],
    [0.0, 0.0, 0.035, 0.320, 0.225, 0.225, 0.065],
    [0.100, -0.135, 0.0, 0.615, 0.705, 0.755, 0.085],
    [0.0, 0.0, 0.0, 0.2015, 0.190, 0.139, 0.1883],
    [0.075, -0.090, 0.0, 0.335, 0.270, 0.295, 0.080],
];

/// A joint that turns a whole turn each way.
fn free_joint(i: usize) -> Joint {
    Joint {
        name: format!("j{i}"),
        lower_rad: -TAU,
        upper_rad: TAU,
        max_speed_rad_per_s: 1.0,
        max_acceleration_rad_per_s2: 1.0,
        max_jerk_rad_per_s3: None,
        continuous: false,
    }
}

pub fn joints(count: usize) -> Vec<Joint> {
    (1..=count).map(free_joint).collect()
}

/// A chain of axes with these directions, each joint's frame this far behind the one before.
pub fn chain(pieces: &[([f64; 3], [f64; 3])], flange: [f64; 3]) -> Chain {
    let segments = pieces.iter().map(|&(axis, shift)| Segment {
        previous_from_joint: Pose::from_parts(Translation3::from(shift), UnitQuaternion::identity()),
        axis_in_joint: Direction::new_normalize(Vector::from(axis)),
    });
    let flange =
        Pose::from_parts(Translation3::from(flange), UnitQuaternion::from_euler_angles(0.3, -0.2, 0.9));
    Chain::new(segments.collect(), flange).unwrap()
}

/// Position and rotation by which `joints_rad` misses the target, the larger one, metres or radians.
pub fn miss(kinematics: &dyn Kinematics, target: &Pose, joints_rad: &[f64]) -> f64 {
    let reached = kinematics.forward(joints_rad);
    let turn = reached.rotation.inverse() * target.rotation;
    let position = (reached.translation.vector - target.translation.vector).norm();
    position.max(2.0 * turn.imag().norm().atan2(turn.w.abs()))
}

/// The largest difference in any joint, whole turns aside.
pub fn apart(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| ((x - y) - ((x - y) / TAU).round() * TAU).abs()).fold(0.0, f64::max)
}

/// The difference of the nearest solution from `q`.
pub fn nearest(answer: &InverseSolutions, q: &[f64]) -> f64 {
    answer.solutions.iter().map(|s| apart(s, q)).fold(f64::INFINITY, f64::min)
}

/// All solutions within limits and on the target; an empty list has its reason.
pub fn check_all(kinematics: &dyn Kinematics, joints: &[Joint], target: &Pose, answer: &InverseSolutions) {
    for state in &answer.solutions {
        let miss = miss(kinematics, target, state);
        assert!(miss < 1.5e-9, "misses by {miss} at {state:?}");
        assert!(joints.iter().zip(state).all(|(joint, q)| joint.contains(*q)), "{state:?}");
    }
    assert_eq!(answer.failure.is_some(), answer.solutions.is_empty());
}

/// The same chain solved by descents alone.
pub fn numeric(chain: &Chain, joints: &[Joint]) -> NumericKinematics {
    NumericKinematics::new(chain.clone(), joints.to_vec()).unwrap()
}

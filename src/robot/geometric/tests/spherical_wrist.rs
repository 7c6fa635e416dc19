//! Arms with three axes that meet in a point.

use std::f64::consts::PI;

use proptest::prelude::*;

use super::arms::{INDUSTRIAL, apart, chain, check_all, industrial, joints, miss, nearest, numeric};
use crate::geometry::Pose;
use crate::robot::geometric::GeometricKinematics;
use crate::robot::{
    ArmStructure, DhConvention, Kinematics, ReachBound, RobotModel, Solver, UnreachableReason,
};

const EXACT: Solver = Solver { structure: ArmStructure::SphericalWrist, exact: true };

/// A random arm of the structure: axes 2 and 3 parallel or 1 and 2 meeting, the last three (or, turned
/// round, the first three) meeting at slanted angles.
fn random_structure(
    x: [[f64; 3]; 10],
    opposite: bool,
    meeting: bool,
    reversed: bool,
) -> Option<crate::robot::Chain> {
    let [a1, a2, free, a4, a5, a6, s2, s3, s4, flange] = x;
    let turned = if opposite { a2.map(|v| -v) } else { a2 };
    let (a3, s2) = if meeting { (free, [0.0; 3]) } else { (turned, s2) };
    let pieces = [(a1, [0.1, 0.2, 0.3]), (a2, s2), (a3, s3), (a4, s4), (a5, [0.0; 3]), (a6, [0.0; 3])];
    let line = |v: [f64; 3]| nalgebra::Vector3::from(v).normalize();
    let square = |a: [f64; 3], b: [f64; 3]| line(a).cross(&line(b)).norm();
    let sound = square(a1, a2) > 0.3 && square(a4, a5) > 0.3 && square(a5, a6) > 0.3;
    let levers = [(a3, s3), (a3, s4)]
        .iter()
        .all(|(axis, shift)| line(*axis).cross(&nalgebra::Vector3::from(*shift)).norm() > 0.1);
    if !(sound && levers && pieces.iter().all(|(axis, _)| nalgebra::Vector3::from(*axis).norm() > 0.2)) {
        return None;
    }
    if !reversed {
        return Some(chain(&pieces, flange));
    }
    // The same arm seen from its hand: axes in the other order, the pieces between them turned round.
    let shifts = [[0.1, 0.2, 0.3], [0.0; 3], [0.0; 3], s4, s3, s2];
    let axes = [a6, a5, a4, a3, a2, a1];
    let pieces: Vec<_> =
        axes.into_iter().zip(shifts).map(|(axis, shift)| (axis, shift.map(|v| -v))).collect();
    Some(chain(&pieces, flange))
}

fn triple() -> impl Strategy<Value = [f64; 3]> {
    proptest::array::uniform3(-1.0..1.0f64)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1500))]

    #[test]
    fn industrial_arms_find_the_posture_they_came_from(
        which in 0usize..INDUSTRIAL.len(), q in proptest::array::uniform6(-PI..PI)
    ) {
        let robot = industrial(INDUSTRIAL[which]);
        prop_assert_eq!(robot.solver(), EXACT);
        let target = robot.kinematics.forward(&q);
        let answer = robot.kinematics.inverse(&target, &[]);
        check_all(robot.kinematics.as_ref(), &robot.joints, &target, &answer);
        prop_assert!(!answer.solutions.is_empty() && answer.solutions.len() <= 8);
        // Near singularities the angles are only known to the root of the rounding.
        let bends = q[4].sin().abs() > 1e-3;
        if bends && nearest(&answer, &q) > 1e-6 {
            let near = robot.kinematics.inverse_near(&target, &q);
            prop_assert!(apart(&near.solutions[0], &q) < 1e-4, "{}", apart(&near.solutions[0], &q));
        }
    }

    #[test]
    fn any_arm_of_the_structure_is_recognised_and_solved(
        x in proptest::array::uniform10(triple()), flags in any::<(bool, bool, bool)>(), q in proptest::array::uniform6(-PI..PI)
    ) {
        let Some(chain) = random_structure(x, flags.0, flags.1, flags.2) else { return Ok(()) };
        let joints = joints(6);
        let arm = GeometricKinematics::new(chain, joints.clone()).unwrap().unwrap();
        prop_assert_eq!(arm.solver(), EXACT);
        let target = arm.forward(&q);
        let answer = arm.inverse(&target, &[]);
        check_all(&arm, &joints, &target, &answer);
        prop_assert!(!answer.solutions.is_empty(), "{:?}", answer.failure);
    }

    #[test]
    fn singular_postures_keep_exact_solutions_and_the_seeds_angles(
        which in 0usize..INDUSTRIAL.len(), mut q in proptest::array::uniform6(-2.5..2.5f64), wrist in any::<bool>(),
        nudge in prop_oneof![Just(0.0), 1e-14..1e-6f64, Just(1e-8), Just(1e-9)],
    ) {
        let robot = industrial(INDUSTRIAL[which]);
        let [a1, a2, b, _, c2, c3, _] = INDUSTRIAL[which];
        if wrist {
            q[4] = nudge;
        } else {
            // Stretched: the wrist in line with the upper arm.
            q[2] = -a2.atan2(c3) - std::f64::consts::FRAC_PI_2 + nudge;
        }
        let target = robot.kinematics.forward(&q);
        let answer = robot.kinematics.inverse_near(&target, &q);
        check_all(robot.kinematics.as_ref(), &robot.joints, &target, &answer);
        prop_assert!(!answer.solutions.is_empty(), "{:?} {a1} {b} {c2}", answer.failure);
        if wrist && nudge == 0.0 {
            prop_assert!(apart(&answer.solutions[0], &q) < 1e-6, "{:?} {q:?}", answer.solutions[0]);
        }
    }

    #[test]
    fn no_pose_makes_it_panic(x in proptest::array::uniform7(proptest::num::f64::ANY)) {
        let rotation = nalgebra::UnitQuaternion::new_unchecked(nalgebra::Quaternion::new(x[0], x[1], x[2], x[3]));
        let pose = Pose::from_parts(nalgebra::Translation3::new(x[4], x[5], x[6]), rotation);
        let robot = industrial(INDUSTRIAL[3]);
        let answer = robot.kinematics.inverse_near(&pose, &x);
        prop_assert_eq!(answer.failure.is_some(), answer.solutions.is_empty());
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    #[test]
    fn what_descents_find_the_closed_form_has_found(
        which in 0usize..INDUSTRIAL.len(), q in proptest::array::uniform6(-2.9..2.9f64)
    ) {
        let robot = industrial(INDUSTRIAL[which]);
        let target = robot.kinematics.forward(&q);
        let chain = robot.dh.as_ref().unwrap().chain().unwrap();
        let found = numeric(&chain, &robot.joints).inverse(&target, &[]);
        let answer = robot.kinematics.inverse(&target, &[]);
        // Next to a singularity the pose hardly changes with the joints: a descent ends somewhere near.
        let regular = |state: &[f64]| robot.kinematics.jacobian(state).singular_values().min() > 0.02;
        for state in found.solutions.iter().filter(|state| regular(state)) {
            prop_assert!(nearest(&answer, state) < 1e-3, "{state:?}");
        }
    }

    #[test]
    fn a_calibrated_arm_is_refined_to_what_descents_find(
        q in proptest::array::uniform6(-2.5..2.5f64), off in proptest::array::uniform6(-1.0..1.0f64)
    ) {
        let mut rows = industrial(INDUSTRIAL[3]).dh.unwrap().rows;
        for (row, off) in rows.iter_mut().zip(off) {
            row.a_m += 0.001 * off;
            row.alpha_rad -= 0.0015 * off;
            row.theta_offset_rad += 0.01 * off;
        }
        let robot = RobotModel::from_dh(&rows, DhConvention::Standard).unwrap();
        prop_assert_eq!(robot.solver().name(), "spherical_wrist_refined");
        let target = robot.kinematics.forward(&q);
        let answer = robot.kinematics.inverse(&target, &[]);
        check_all(robot.kinematics.as_ref(), &robot.joints, &target, &answer);
        prop_assert!(!answer.solutions.is_empty(), "{:?}", answer.failure);
    }
}

#[test]
fn a_generic_pose_has_eight_branches_all_different() {
    let robot = industrial(INDUSTRIAL[0]);
    let target = robot.kinematics.forward(&[0.3, 0.5, -0.4, 0.7, 1.1, 0.4]);
    let answer = robot.kinematics.inverse(&target, &[]);
    assert_eq!(answer.solutions.len(), 8);
    for (i, a) in answer.solutions.iter().enumerate() {
        assert!(answer.solutions[..i].iter().all(|b| apart(a, b) > 1e-3));
    }
}

#[test]
fn a_wrist_on_the_first_axis_takes_the_seeds_angle() {
    // No shoulder offset: folded so that the wrist stands over the first axis.
    let robot = industrial([0.0, 0.0, 0.0, 0.4, 0.5, 0.5, 0.1]);
    let q = [0.8, -PI / 4.0, 0.0, 0.3, 0.9, -0.2];
    let target = robot.kinematics.forward(&q);
    let wrist = target * crate::geometry::Point::new(0.0, 0.0, -0.1);
    assert!(wrist.x.hypot(wrist.y) < 1e-12, "{wrist}");
    let answer = robot.kinematics.inverse_near(&target, &q);
    check_all(robot.kinematics.as_ref(), &robot.joints, &target, &answer);
    assert!(apart(&answer.solutions[0], &q) < 1e-6);
}

#[test]
fn poses_out_of_reach_say_by_how_much_and_at_which_end() {
    let robot = industrial(INDUSTRIAL[3]);
    let far = Pose::translation(3.0, 0.0, 1.0);
    let failure = robot.kinematics.inverse(&far, &[]).failure.unwrap();
    let UnreachableReason::OutOfReach { beyond_m, bound } = failure.reason else { panic!("{failure:?}") };
    assert_eq!(bound, ReachBound::TooFar);
    assert!((miss(robot.kinematics.as_ref(), &far, &failure.nearest) - beyond_m).abs() < 1e-9);
    assert!(beyond_m > 3.0 - 0.1 - 0.705 - 0.767 - 0.085, "{beyond_m}");
    // A fork's offset keeps the wrist off the first axis.
    let robot = industrial(INDUSTRIAL[2]);
    let near = Pose::translation(0.001, 0.0, 0.6);
    let failure = robot.kinematics.inverse(&near, &[]).failure.unwrap();
    let bound = ReachBound::InsideShoulderColumn;
    assert!(
        matches!(failure.reason, UnreachableReason::OutOfReach { bound: b, .. } if b == bound),
        "{failure:?}"
    );
}

#[test]
fn a_limit_in_the_way_is_named() {
    let mut rows = industrial(INDUSTRIAL[3]).dh.unwrap().rows;
    let target = industrial(INDUSTRIAL[3]).kinematics.forward(&[0.5, -0.4, 0.3, 0.4, 1.0, 2.0]);
    (rows[0].lower_rad, rows[0].upper_rad) = (Some(-0.01), Some(0.01));
    let tight = RobotModel::from_dh(&rows, DhConvention::Standard).unwrap();
    let failure = tight.kinematics.inverse(&target, &[]).failure.unwrap();
    let UnreachableReason::JointLimit { joint, value_rad, .. } = failure.reason else {
        panic!("{failure:?}")
    };
    assert!(joint == "joint_1" && value_rad.abs() > 0.01);
}

#[test]
fn what_does_not_fit_is_left_to_descents() {
    let mut rows = industrial(INDUSTRIAL[0]).dh.unwrap().rows;
    rows[1].alpha_rad = 0.4;
    rows[2].a_m = 0.05;
    let slanted = RobotModel::from_dh(&rows, DhConvention::Standard).unwrap();
    assert_eq!(slanted.solver().name(), "numeric");
    let target = slanted.kinematics.forward(&[0.3, 0.5, -0.4, 0.7, 1.1, 0.4]);
    assert!(!slanted.kinematics.inverse(&target, &[]).solutions.is_empty());
}

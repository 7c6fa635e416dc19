//! Arms whose last axis passes beside the two that meet.

use proptest::prelude::*;

use super::arms::{apart, check_all, joints, nearest, numeric};
use crate::robot::{ArmStructure, Kinematics, RobotModel};

/// Smallest singular value of the Jacobian (metres and radians) under which two
/// solutions are so near to each other that one may be missed.
const SINGULAR: f64 = 2e-3;

fn stiffness(kinematics: &dyn Kinematics, q: &[f64]) -> f64 {
    kinematics.jacobian(q).singular_values().min()
}

fn xarm() -> RobotModel {
    RobotModel::named("xarm6").unwrap()
}

/// The state at these shares of the joints' ranges.
fn state(robot: &RobotModel, share: [f64; 6]) -> Vec<f64> {
    robot.joints.iter().zip(share).map(|(j, s)| j.lower_rad + s * (j.upper_rad - j.lower_rad)).collect()
}

#[test]
fn a_solution_within_reach_for_less_than_a_step_of_the_search_is_found() {
    // Nearly stretched: while the last joint turns, the wrist is within reach for 0.06 rad.
    let robot = xarm();
    let q = state(&robot, [0.01, 0.01, 0.2943, 0.4958, 0.7701, 0.0188]);
    assert!(stiffness(robot.kinematics.as_ref(), &q) > SINGULAR);
    let target = robot.kinematics.forward(&q);
    let answer = robot.kinematics.inverse(&target, &[]);
    check_all(robot.kinematics.as_ref(), &robot.joints, &target, &answer);
    assert!(nearest(&answer, &q) < 1e-4, "{answer:?}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(500))]

    #[test]
    fn the_xarm_finds_the_posture_it_came_from(share in proptest::array::uniform6(0.01..0.99f64)) {
        let robot = xarm();
        prop_assert_eq!(robot.solver().structure, ArmStructure::OffsetWrist);
        let q = state(&robot, share);
        let target = robot.kinematics.forward(&q);
        let answer = robot.kinematics.inverse(&target, &[]);
        check_all(robot.kinematics.as_ref(), &robot.joints, &target, &answer);
        let near = robot.kinematics.inverse_near(&target, &q);
        if stiffness(robot.kinematics.as_ref(), &q) > SINGULAR {
            prop_assert!(!answer.solutions.is_empty() && !near.solutions.is_empty());
            prop_assert!(nearest(&answer, &q) < 1e-4, "{q:?} {}", nearest(&answer, &q));
            prop_assert!(apart(&near.solutions[0], &q) < 1e-4, "{q:?} {}", apart(&near.solutions[0], &q));
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]

    #[test]
    fn what_descents_find_the_search_has_found(q in proptest::array::uniform6(-2.9..2.9f64)) {
        let chain = xarm().dh.unwrap().chain().unwrap();
        let free = joints(6);
        let arm = crate::robot::geometric::GeometricKinematics::new(chain.clone(), free.clone()).unwrap().unwrap();
        let target = arm.forward(&q);
        let answer = arm.inverse(&target, &[]);
        let missing = numeric(&chain, &free).inverse(&target, &[]).solutions
            .into_iter().filter(|state| nearest(&answer, state) > 1e-3 && stiffness(&arm, state) > SINGULAR).count();
        prop_assert_eq!(missing, 0);
    }
}

//! Arms with seven joints.

use proptest::prelude::*;

use super::arms::{apart, check_all};
use crate::geometry::Pose;
use crate::robot::{ArmStructure, RobotModel, UnreachableReason};

fn state(robot: &RobotModel, share: [f64; 7]) -> Vec<f64> {
    let within = |(joint, share): (&crate::robot::Joint, f64)| {
        joint.lower_rad + share * (joint.upper_rad - joint.lower_rad)
    };
    robot.joints.iter().zip(share).map(within).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    #[test]
    fn franka_arms_reach_what_they_reached_before(
        name in prop_oneof![Just("panda"), Just("fr3")], share in proptest::array::uniform7(0.02..0.98f64)
    ) {
        let robot = RobotModel::named(name).unwrap();
        prop_assert!(robot.solver().structure == ArmStructure::SpareJoint && robot.solver().exact);
        let q = state(&robot, share);
        let target = robot.kinematics.forward(&q);
        let answer = robot.kinematics.inverse(&target, &[]);
        check_all(robot.kinematics.as_ref(), &robot.joints, &target, &answer);
        prop_assert!(!answer.solutions.is_empty(), "{q:?} {:?}", answer.failure);
        let near = robot.kinematics.inverse_near(&target, &q);
        prop_assert!(apart(&near.solutions[0], &q) < 1e-6);
    }
}

#[test]
fn a_common_pose_has_many_different_solutions() {
    let robot = RobotModel::named("fr3").unwrap();
    let target = robot.kinematics.forward(&[0.2, -0.5, 0.1, -2.0, 0.1, 1.6, 0.5]);
    let answer = robot.kinematics.inverse(&target, &[]);
    assert_eq!(answer.solutions.len(), 16);
    for (i, a) in answer.solutions.iter().enumerate() {
        assert!(answer.solutions[..i].iter().all(|b| apart(a, b) >= 0.2));
    }
}

#[test]
fn a_pose_that_no_posture_reaches_has_its_nearest_state() {
    let robot = RobotModel::named("panda").unwrap();
    let failure = robot.kinematics.inverse(&Pose::translation(0.7, 0.0, 0.9), &[]).failure.unwrap();
    assert!(failure.position_residual_m.is_finite() && failure.nearest.len() == 7, "{failure:?}");
    let failure = robot.kinematics.inverse(&Pose::translation(0.0, 2.0, 0.3), &[]).failure.unwrap();
    assert!(matches!(failure.reason, UnreachableReason::OutOfReach { .. }));
}

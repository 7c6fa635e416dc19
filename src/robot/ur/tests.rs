//! Property tests of the closed form.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use proptest::prelude::*;

use super::parameters::{NAMES, SHEETS};
use crate::geometry::Pose;
use crate::robot::{InverseSolutions, Kinematics, ReachBound, RobotModel, UnreachableReason};

fn arm(name: &str) -> RobotModel {
    RobotModel::named(name).unwrap()
}

fn residuals(a: &Pose, b: &Pose) -> (f64, f64) {
    let rotation = a.rotation.to_rotation_matrix().matrix() - b.rotation.to_rotation_matrix().matrix();
    ((a.translation.vector - b.translation.vector).norm(), rotation.norm() / 2f64.sqrt())
}

fn check_all(kinematics: &dyn Kinematics, target: &Pose, answer: &InverseSolutions) {
    for state in &answer.solutions {
        let (position, rotation) = residuals(&kinematics.forward(state), target);
        assert!(position < 1e-9 && rotation < 1e-9, "{position} m, {rotation} rad at {state:?}");
    }
    assert_eq!(answer.failure.is_some(), answer.solutions.is_empty());
}

fn turns_apart(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| ((x - y) - ((x - y) / TAU).round() * TAU).abs()).fold(0.0, f64::max)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn the_original_posture_is_among_the_branches(
        model in 0usize..NAMES.len(),
        q in (proptest::array::uniform2(-PI..PI), -3.0..3.0f64, proptest::array::uniform3(-PI..PI)),
    ) {
        let robot = arm(NAMES[model]);
        let q = [q.0[0], q.0[1], q.1, q.2[0], q.2[1], q.2[2]];
        let target = robot.kinematics.forward(&q);
        let answer = robot.kinematics.inverse(&target, &[]);
        check_all(robot.kinematics.as_ref(), &target, &answer);
        let nearest = answer.solutions.iter().map(|s| turns_apart(s, &q)).fold(f64::INFINITY, f64::min);
        // Close to a singularity the angles are only known to the root of the rounding.
        let well_posed = q[2].sin().abs() > 1e-3 && q[4].sin().abs() > 1e-3;
        if well_posed {
            prop_assert!(nearest < 1e-6, "nearest {nearest}");
        }
    }

    #[test]
    fn singular_postures_keep_exact_solutions(
        model in 0usize..NAMES.len(),
        mut q in proptest::array::uniform6(-3.0..3.0f64),
        which in 0usize..4,
        nudge in prop_oneof![Just(0.0), 1e-14..1e-6f64],
    ) {
        match which {
            0 => q[2] = nudge,                 // elbow stretched
            1 => q[4] = nudge,                 // wrist axes parallel
            2 => q[4] = PI - nudge,            // and the other way round
            _ => { q[2] = nudge; q[4] = -nudge; }
        }
        let robot = arm(NAMES[model]);
        let target = robot.kinematics.forward(&q);
        let answer = robot.kinematics.inverse_near(&target, &q);
        check_all(robot.kinematics.as_ref(), &target, &answer);
        prop_assert!(!answer.solutions.is_empty());
        if nudge == 0.0 && which != 0 && which != 3 {
            // The free joint takes the seed's angle, so the seed itself comes back first.
            prop_assert!(turns_apart(&answer.solutions[0], &q) < 1e-6);
        }
    }

    #[test]
    fn poses_out_of_reach_say_by_how_much(az in -PI..PI, el in 0.1..1.4f64, far in 1.2..3.0f64) {
        let robot = arm("ur5e");
        let direction = crate::geometry::direction_from_azimuth_elevation(az, el).into_inner();
        let pose = Pose::translation(direction.x * far, direction.y * far, 0.1625 + direction.z * far);
        let answer = robot.kinematics.inverse(&pose, &[]);
        let failure = answer.failure.unwrap();
        let UnreachableReason::OutOfReach { beyond_m, bound } = failure.reason else { panic!("{failure:?}") };
        prop_assert_eq!(bound, ReachBound::TooFar);
        let (position, rotation) = residuals(&robot.kinematics.forward(&failure.nearest), &pose);
        prop_assert!((position - beyond_m).abs() < 1e-9 && rotation < 1e-9);
        prop_assert!((position - failure.position_residual_m).abs() < 1e-9);
        // The arm's reach from the shoulder is at most 0.425 + 0.3922 + its offsets.
        prop_assert!(beyond_m >= far - (0.425 + 0.3922 + 0.1333 + 0.0997 + 0.0996) - 1e-9);
    }

    #[test]
    fn no_pose_makes_it_panic(x in proptest::array::uniform7(proptest::num::f64::ANY)) {
        let rotation = nalgebra::UnitQuaternion::new_unchecked(nalgebra::Quaternion::new(x[0], x[1], x[2], x[3]));
        let pose = Pose::from_parts(nalgebra::Translation3::new(x[4], x[5], x[6]), rotation);
        let robot = arm("ur10e");
        let answer = robot.kinematics.inverse_near(&pose, &x);
        prop_assert_eq!(answer.failure.is_some(), answer.solutions.is_empty());
    }
}

#[test]
fn a_generic_pose_has_eight_branches_all_different() {
    let robot = arm("ur5e");
    let target = robot.kinematics.forward(&[0.3, -1.2, 1.4, -0.9, 1.1, 0.4]);
    let answer = robot.kinematics.inverse(&target, &[]);
    assert_eq!(answer.solutions.len(), 8);
    for (i, a) in answer.solutions.iter().enumerate() {
        assert!(answer.solutions[..i].iter().all(|b| turns_apart(a, b) > 1e-3));
    }
}

#[test]
fn the_wrist_point_on_the_shoulder_cylinder_is_still_reached() {
    // The flange hangs so that the wrist point lies exactly d4 beside the first axis.
    let robot = arm("ur5e");
    let mut upright = [0.7, -FRAC_PI_2 - 0.4, 0.8, 0.0, 0.6, 0.2];
    // Chosen so that the arm's plane coordinate of the wrist point is 0: solve for q4.
    let along = |q: &[f64; 6]| {
        let pose = robot.kinematics.forward(q);
        let wrist = pose.translation.vector - pose.rotation * nalgebra::Vector3::z() * 0.0996;
        wrist.x * q[0].cos() + wrist.y * q[0].sin()
    };
    let (mut low, mut high) = (-1.0, 1.5);
    let at = |q4: f64| along(&[upright[0], upright[1], upright[2], q4, upright[4], upright[5]]);
    assert!(at(low) * at(high) < 0.0);
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if at(low) * at(middle) <= 0.0 { high = middle } else { low = middle }
    }
    upright[3] = 0.5 * (low + high);
    let target = robot.kinematics.forward(&upright);
    let answer = robot.kinematics.inverse(&target, &[]);
    check_all(robot.kinematics.as_ref(), &target, &answer);
    let nearest = answer.solutions.iter().map(|s| turns_apart(s, &upright)).fold(f64::INFINITY, f64::min);
    assert!(nearest < 1e-6, "{nearest}");
}

#[test]
fn a_wrist_point_within_the_shoulder_column_is_named_so() {
    let robot = arm("ur5e");
    let down = nalgebra::UnitQuaternion::from_scaled_axis(nalgebra::Vector3::x() * PI);
    let pose = Pose::from_parts(nalgebra::Translation3::new(0.02, 0.0, 0.6), down);
    let failure = robot.kinematics.inverse(&pose, &[]).failure.unwrap();
    let UnreachableReason::OutOfReach { bound, beyond_m } = failure.reason else { panic!() };
    assert_eq!(bound, ReachBound::InsideShoulderColumn);
    assert!(beyond_m >= 0.1333 - 0.02 - 1e-9, "{beyond_m}");
}

#[test]
fn a_solution_that_breaks_a_limit_names_the_joint_and_the_amount() {
    let mut joints = arm("ur5e").joints;
    for joint in &mut joints {
        (joint.lower_rad, joint.upper_rad) = (-0.5, 0.5);
    }
    joints[0].upper_rad = 0.25;
    let parameters = SHEETS[3].parameters;
    let kinematics = super::UrKinematics::new(parameters, joints).unwrap();
    let target = kinematics.forward(&[0.3, 0.1, 0.4, -0.2, 0.3, 0.1]);
    let failure = kinematics.inverse(&target, &[]).failure.unwrap();
    let UnreachableReason::JointLimit { joint, value_rad, bound_rad } = failure.reason else { panic!() };
    assert_eq!((joint.as_str(), bound_rad), ("shoulder_pan_joint", 0.25));
    assert!((value_rad - 0.3).abs() < 1e-9);
}

#[test]
fn the_nearest_solution_comes_first_and_wraps_towards_the_previous_state() {
    let robot = arm("ur3e");
    let previous = [5.0, -1.0, 1.3, -4.0, 1.2, -5.5];
    let target = robot.kinematics.forward(&previous);
    let answer = robot.kinematics.inverse_near(&target, &previous);
    assert!(answer.solutions[0].iter().zip(&previous).all(|(a, b)| (a - b).abs() < 1e-9));
}

#[test]
fn a_free_last_joint_turns_until_the_elbow_reaches() {
    // Nearly stretched, wrist axes parallel: only a few angles of the free joint leave the elbow room.
    for name in NAMES {
        let robot = arm(name);
        let target = robot.kinematics.forward(&[0.3, -1.0, 0.3, -0.5, 0.0, 2.6]);
        let answer = robot.kinematics.inverse(&target, &[]);
        check_all(robot.kinematics.as_ref(), &target, &answer);
        assert!(!answer.solutions.is_empty(), "{name}: {:?}", answer.failure);
    }
}

#[test]
fn postures_of_everyday_work_do_not_touch_themselves() {
    for name in NAMES {
        let robot = arm(name);
        for q in [
            [0.0; 6],
            [0.0, -FRAC_PI_2, 0.0, -FRAC_PI_2, 0.0, 0.0],
            [0.0, -FRAC_PI_2, FRAC_PI_2, -FRAC_PI_2, -FRAC_PI_2, 0.0],
            [1.0, -2.0, 2.2, -1.8, -FRAC_PI_2, 1.0],
            [1.0, -0.8, 1.2, -2.4, -1.2, 0.4],
        ] {
            let gap = gap_between_links(&robot, &q);
            assert!(gap > 0.005, "{name}: {gap} m at {q:?}");
        }
    }
}

/// The smallest distance between links that are not neighbours, by points along their capsules, metres.
fn gap_between_links(robot: &RobotModel, q: &[f64]) -> f64 {
    let poses = robot.kinematics.link_poses(q);
    let balls: Vec<Vec<(crate::geometry::Point, f64)>> = robot
        .links
        .iter()
        .zip(&poses)
        .map(|(link, pose)| {
            let along = |shape: &crate::robot::LinkShape| {
                let crate::robot::LinkShape::Capsule { from_in_link, to_in_link, radius_m } = shape.clone()
                else {
                    panic!("a capsule")
                };
                let ball = move |i| from_in_link + (to_in_link - from_in_link) * (f64::from(i) / 40.0);
                (0..=40).map(|i| (pose * ball(i), radius_m)).collect::<Vec<_>>()
            };
            link.shapes.iter().flat_map(along).collect()
        })
        .collect();
    let mut least = f64::INFINITY;
    for (i, a) in balls.iter().enumerate() {
        for b in balls.iter().skip(i + 2) {
            for (p, r) in a {
                for (s, t) in b {
                    least = least.min((p - s).norm() - r - t);
                }
            }
        }
    }
    least
}

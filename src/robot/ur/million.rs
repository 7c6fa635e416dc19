//! A million poses: random ones and ones at or near the singularities.

use std::f64::consts::{PI, TAU};

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;

use super::parameters::{NAMES, SHEETS};
use crate::robot::RobotModel;

/// Poses in all, in pieces that each have their own stream.
const PIECES: u64 = 1000;
const POSES_A_PIECE: usize = 1000;

/// Sine of elbow and wrist angle under which solutions fall together, so that the
/// angles are only known to the root of the rounding.
const SINGULAR: f64 = 1e-3;

/// What a piece has shown.
#[derive(Default)]
struct Seen {
    worst_m: f64,
    worst_rad: f64,
    unsolved: usize,
    lost: usize,
    singular: usize,
}

/// A joint state; every second one at a singularity or near one.
fn state(random: &mut ChaCha8Rng, index: usize) -> [f64; 6] {
    let mut q: [f64; 6] = std::array::from_fn(|_| random.random_range(-PI..PI));
    // From 1e-15 to 1 rad beside it, evenly in the exponent; now and then exactly there.
    let size = 10f64.powf(random.random_range(-15.0..0.0));
    let nudge = match index % 16 {
        1 => 0.0,
        3 | 5 | 7 => -size,
        _ => size,
    };
    if index % 2 == 1 {
        match random.random_range(0..6) {
            0 => q[4] = nudge,
            1 => q[4] = PI - nudge.abs(),
            2 => q[2] = nudge,
            3 => q[2] = PI - nudge.abs(),
            4 => (q[2], q[4]) = (nudge, -nudge),
            // The forearm folded so that the wrist point comes near to the first axis.
            _ => q[1] = -0.5 * PI - 0.5 * q[2] + nudge,
        }
    }
    q
}

fn piece(number: u64) -> Seen {
    let robot = RobotModel::named(NAMES[number as usize % NAMES.len()]).unwrap();
    let parameters = SHEETS[number as usize % SHEETS.len()].parameters;
    let mut random = ChaCha8Rng::seed_from_u64(number);
    let mut seen = Seen::default();
    for index in 0..POSES_A_PIECE {
        let q = state(&mut random, index);
        let target = robot.kinematics.forward(&q);
        let matrix = *target.rotation.to_rotation_matrix().matrix();
        let branches = parameters.branches(&target, &q).unwrap();
        assert!(branches.all().iter().all(|b| b.joints_rad.iter().all(|angle| angle.is_finite())));
        let mut nearest = f64::INFINITY;
        let mut check = |solution: &[f64]| {
            let reached = robot.kinematics.forward(solution);
            let position_m = (reached.translation.vector - target.translation.vector).norm();
            let turned = (reached.rotation.to_rotation_matrix().matrix() - matrix).norm() / 2f64.sqrt();
            (seen.worst_m, seen.worst_rad) = (seen.worst_m.max(position_m), seen.worst_rad.max(turned));
            let apart = solution.iter().zip(&q).map(|(a, b)| ((a - b) - ((a - b) / TAU).round() * TAU).abs());
            nearest = nearest.min(apart.fold(0.0, f64::max));
        };
        branches.exact().for_each(|branch| check(&branch.joints_rad));
        if branches.exact().next().is_none() {
            // Where two singularities meet the whole solver polishes what the closed form leaves.
            let solutions = robot.kinematics.inverse_near(&target, &q).solutions;
            solutions.iter().for_each(|solution| check(solution));
            seen.unsolved += usize::from(solutions.is_empty());
        }
        let singular =
            q[2].sin().abs() < SINGULAR || q[4].sin().abs() < SINGULAR || column(&q, &target, &parameters);
        seen.singular += usize::from(singular);
        seen.lost += usize::from(!singular && !(nearest < 1e-6));
    }
    seen
}

/// Whether the wrist point is so near to the column about the first axis that both
/// shoulders fall together.
fn column(q: &[f64; 6], target: &crate::geometry::Pose, p: &super::UrParameters) -> bool {
    let wrist = target.translation.vector - target.rotation * crate::geometry::Vector::z() * p.d6_m;
    (wrist.x * q[0].cos() + wrist.y * q[0].sin()).abs() < SINGULAR
}

#[test]
fn a_million_poses_are_solved_to_a_nanometre_and_a_nanoradian() {
    let all = (0..PIECES).into_par_iter().map(piece).reduce(Seen::default, |a, b| Seen {
        worst_m: a.worst_m.max(b.worst_m),
        worst_rad: a.worst_rad.max(b.worst_rad),
        unsolved: a.unsolved + b.unsolved,
        lost: a.lost + b.lost,
        singular: a.singular + b.singular,
    });
    // A NaN would have failed the comparisons that `max` lets pass: see `lost`.
    assert!(all.worst_m < 1e-9 && all.worst_rad < 1e-9, "{} m, {} rad", all.worst_m, all.worst_rad);
    assert_eq!((all.unsolved, all.lost), (0, 0));
    assert!(all.singular > 200_000, "{}", all.singular);
}

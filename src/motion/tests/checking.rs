//! What the checker finds, and how much of it.

use std::collections::BTreeMap;

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::cells::{cell, views};
use crate::motion::check::sampled_excess_m;
use crate::motion::*;

/// Points `period_s` apart on a straight joint move, without a stop at its ends.
fn straight(from: &[f64], to: &[f64], count: usize, period_s: f64) -> Vec<TrajectoryPoint> {
    let speed: Vec<f64> = from.iter().zip(to).map(|(a, b)| (b - a) / (count as f64 * period_s)).collect();
    let at = |i: usize| TrajectoryPoint {
        positions_rad: from.iter().zip(to).map(|(a, b)| a + (b - a) * i as f64 / count as f64).collect(),
        velocities_rad_per_s: speed.clone(),
        accelerations_rad_per_s2: vec![0.0; from.len()],
        time_from_start_s: i as f64 * period_s,
        view: None,
    };
    (0..=count).map(at).collect()
}

fn claim<'a>(cell: &'a Cell, views: &'a [ClaimedView], trajectory: &'a [TrajectoryPoint]) -> Claim<'a> {
    Claim {
        cell,
        start: None,
        roll: Roll::Fixed,
        timing: Timing::default(),
        views,
        order: &[],
        trajectory,
        stop: None,
    }
}

#[test]
fn every_pass_that_comes_too_near_is_found_and_no_other() {
    let mut cell = cell("ur5e", 0.45, 0.0);
    cell.keep_out.push(KeepOut {
        name: "post".into(),
        shape_in_base: crate::robot::LinkShape::capsule([0.0, 0.5, 0.0], [0.0, 0.5, 0.8], 0.05),
    });
    let mut rng = ChaCha8Rng::seed_from_u64(9);
    let mut count = [0; 2];
    for _ in 0..60 {
        let base = [0.3, -1.4, 1.6, -1.7, -1.5, 0.0];
        let mut state = |spread: f64| -> Vec<f64> {
            base.iter().map(|q| q + rng.random_range(-spread..spread)).collect()
        };
        let (from, to) = (state(0.6), state(1.2));
        let mut trajectory = straight(&from, &to, 25, 0.05);
        // A view at the beginning: nothing is excused.
        trajectory[0].view = Some(0);
        let verdict = check_claim(&claim(&cell, &[], &trajectory));
        let found = verdict.violations.iter().any(|v| matches!(v, Violation::TooNear { .. }));
        // By how much the nearest pair undercuts its margin, looked at everywhere.
        let excess_m = sampled_excess_m(&cell, &trajectory, 20);
        if excess_m > UNDERCUT_BOUND_M + 1e-5 {
            assert!(found, "{excess_m} was not found");
        }
        if excess_m < 0.0 {
            assert!(!found, "{excess_m}: {:?}", verdict.violations);
        }
        count[usize::from(found)] += 1;
    }
    assert!(count[0] > 8 && count[1] > 8, "{count:?}");
}

#[test]
fn points_that_are_all_marked_as_views_are_counted_and_do_not_hide_the_motion() {
    let cell = cell("ur5e", 0.45, 0.0);
    let wanted = views(&cell, 5, 0.3);
    let claimed: Vec<ClaimedView> =
        wanted.iter().map(|pose| ClaimedView { base_from_camera: *pose, planned: true }).collect();
    let rest = [0.3, -1.4, 1.6, -1.7, -1.5, 0.0];
    // A minute of rest, every point of it a visit, then a jump at ten times the speed.
    let mut trajectory = straight(&rest, &rest, 60_000, 1e-3);
    for (i, point) in trajectory.iter_mut().enumerate() {
        point.view = Some(i % 7);
    }
    trajectory.extend(straight(&rest, &[3.0, -1.4, 1.6, -1.7, -1.5, 0.0], 10, 1e-3).into_iter().map(
        |mut p| {
            p.time_from_start_s += 61.0;
            p
        },
    ));
    let mut claim = claim(&cell, &claimed, &trajectory);
    claim.timing.settle_s = 50.0;
    let verdict = check_claim(&claim);
    let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
    verdict.violations.iter().for_each(|violation| *counts.entry(violation.code()).or_default() += 1);
    assert!(counts.values().all(|count| *count <= MOST_OF_A_KIND), "{counts:?}");
    for code in ["view_not_taken", "wrong_pose", "speed_limit"] {
        assert!(counts.contains_key(code), "{code}: {counts:?}");
    }
    let strangers = verdict
        .violations
        .iter()
        .filter(|v| matches!(v, Violation::View { view: 5..=6, problem: "is not in the plan" }));
    assert_eq!(strangers.count(), 2);
}

#[test]
fn a_motion_that_cannot_be_judged_within_the_work_of_a_check_is_not_proven() {
    let mut cell = cell("ur5e", 0.45, 0.0);
    cell.object = None;
    let rest = [0.3, -1.4, 1.6, -1.7, -1.5, 0.0];
    let mut far = rest;
    far[0] = 1e300;
    let trajectory = straight(&rest, &far, 3, 0.1);
    let verdict = check_claim(&claim(&cell, &[], &trajectory));
    assert!(verdict.violations.iter().any(|v| matches!(v, Violation::NotProven { .. })));
}

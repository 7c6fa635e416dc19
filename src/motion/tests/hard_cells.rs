//! Cells with much in them, and plans that run out of work.

use nalgebra::{Translation3, UnitQuaternion};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::cells::{as_order, by_camera_path, cell, views};
use crate::geometry::{Pose, Vector};
use crate::motion::joints::joints_from;
use crate::motion::scene::{Placement, Scene};
use crate::motion::*;
use crate::robot::LinkShape;

fn cylinder(x: f64, y: f64, z: f64, radius_m: f64, half_length_m: f64) -> LinkShape {
    let turned = UnitQuaternion::from_scaled_axis(Vector::new(0.7, 0.2, 0.0));
    LinkShape::Cylinder {
        link_from_cylinder: Pose::from_parts(Translation3::new(x, y, z), turned),
        half_length_m,
        radius_m,
    }
}

/// A cell with `regions` cylinders around the object and `solids` on the flange.
fn crowded(regions: u32, solids: u32) -> Cell {
    let mut cell = cell("ur5e", 0.45, 0.0);
    for i in 0..regions {
        // In front of the object and beside it.
        let (sin, cos) = (2.4 * (f64::from(i) + 0.5) / f64::from(regions) - 1.2).sin_cos();
        let shape_in_base = cylinder(0.45 + 0.45 * cos, 0.45 * sin, 0.2, 0.02, 0.05);
        cell.keep_out.push(KeepOut { name: format!("post {i}"), shape_in_base });
    }
    for i in 0..solids {
        let (x, y) = (f64::from(i % 4) * 0.015 - 0.03, f64::from(i / 4) * 0.015 - 0.03);
        cell.tool.push(cylinder(x, y, 0.02, 0.005, 0.015));
    }
    cell
}

#[test]
fn bounds_never_hide_a_collision() {
    let cell = crowded(9, 12);
    let scene = Scene::new(&cell);
    assert!(!scene.groups().is_empty());
    let mut placement = Placement::default();
    let mut rng = ChaCha8Rng::seed_from_u64(5);
    let mut count = [0; 2];
    for _ in 0..3000 {
        let q: Vec<f64> = (0..6).map(|_| rng.random_range(-3.0..3.0)).collect();
        let q = joints_from(&q);
        let is_free = scene.is_free(&q, &mut placement);
        scene.place(&q, &mut placement);
        let keeps = |i: usize, pair: &crate::motion::scene::Pair, placement: &mut Placement| {
            scene.clearance(i, placement, f64::INFINITY) >= pair.margin_m
        };
        let each = scene.pairs().iter().enumerate().all(|(i, pair)| keeps(i, pair, &mut placement));
        assert_eq!(is_free, each);
        count[usize::from(is_free)] += 1;
    }
    assert!(count[0] > 100 && count[1] > 100, "{count:?}");
}

#[test]
fn a_region_that_no_part_of_the_arm_can_reach_is_not_looked_at() {
    let near = crowded(3, 2);
    let mut far = near.clone();
    far.keep_out.push(KeepOut { name: "far".into(), shape_in_base: cylinder(3.0, 0.0, 0.5, 0.5, 0.5) });
    assert_eq!(Scene::new(&near).pairs().len(), Scene::new(&far).pairs().len());
}

#[test]
fn a_plan_that_runs_out_of_work_leaves_the_rest_out_and_stays_sound() {
    let cell = crowded(8, 8);
    let views = views(&cell, 12, 0.3);
    let order = by_camera_path(&cell, &views);
    let mut request = MotionRequest::new(&cell, &views);
    (request.roll, request.objective) = (Roll::FREE, Objective::Time);
    request.order = Order::By(as_order(&order));
    let whole = plan_motion(&request).unwrap();
    let unsettled = |plan: &MotionPlan| {
        let limit = |view: &&ViewOutcome| matches!(view, ViewOutcome::Skipped(SkipReason::WorkLimit));
        plan.views.iter().filter(limit).count()
    };
    assert!(whole.planned_count() > 5 && unsettled(&whole) == 0, "{} {:?}", whole.work, whole.views);
    let mut cut = 0;
    for share in [0.0, 0.02, 0.1, 0.4] {
        let allowance = Allowance { most: (share * whole.work as f64) as u64, stop: Stop::default() };
        let request = MotionRequest { allowance: Some(&allowance), ..request };
        let plan = plan_motion(&request).unwrap();
        assert_eq!(check(&request, &plan), vec![], "{share}");
        assert_eq!(plan, plan_motion(&request).unwrap(), "{share}");
        // What is under way when the work ends is a single step.
        assert!(plan.work <= allowance.most + whole.work / 20, "{share}: {} of {}", plan.work, whole.work);
        assert_eq!(share == 0.0, plan.order.is_empty());
        cut += unsettled(&plan);
    }
    assert!(cut > 12, "{cut}");
}

#[test]
fn a_plan_that_is_stopped_is_no_plan() {
    let cell = cell("ur5e", 0.45, 0.0);
    let views = views(&cell, 5, 0.3);
    let mut request = MotionRequest::new(&cell, &views);
    let stop = Stop::default();
    let allowance = Allowance::plan(&stop);
    request.allowance = Some(&allowance);
    assert!(plan_motion(&request).is_ok());
    stop.ask();
    assert_eq!(plan_motion(&request), Err(MotionError::Stopped));
}

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::cells::{as_order, by_camera_path, cell, views};
use crate::geometry::{Pose, Vector};
use crate::motion::*;
use crate::robot::LinkShape;

/// A random UR cell: arm, object, hand-eye, sometimes a box, a start, free roll.
fn random_cell(rng: &mut ChaCha8Rng) -> (Cell, Vec<Pose>, bool) {
    let robots = ["ur3e", "ur5", "ur5e", "ur10e", "ur16e"];
    let robot = robots[rng.random_range(0..robots.len())];
    let reach = if robot == "ur3e" { 0.3 } else { 0.5 };
    let azimuth = rng.random_range(-3.1..3.1f64);
    let distance = reach * rng.random_range(0.7..1.3);
    let mut cell = cell(robot, distance * azimuth.cos(), distance * azimuth.sin());
    let mut uniform = |low: f64, high: f64| rng.random_range(low..high);
    let turn = Vector::new(uniform(-0.3, 0.3), uniform(-0.3, 0.3), uniform(-3.0, 3.0));
    cell.flange_from_camera =
        Pose::new(Vector::new(uniform(-0.05, 0.05), uniform(-0.05, 0.05), uniform(0.02, 0.1)), turn);
    cell.camera_body = default_camera_body(&cell.flange_from_camera);
    if uniform(0.0, 1.0) < 0.5 {
        let at = Vector::new(uniform(-0.8, 0.8), uniform(-0.8, 0.8), uniform(0.0, 0.6));
        let half_extents_m = Vector::new(uniform(0.02, 0.2), uniform(0.02, 0.2), uniform(0.02, 0.2));
        let shape_in_base = LinkShape::Cuboid { link_from_box: Pose::new(at, turn), half_extents_m };
        cell.keep_out.push(KeepOut { name: "box".into(), shape_in_base });
    }
    let radius_m = uniform(0.25, 0.35);
    let free_roll = uniform(0.0, 1.0) < 0.3;
    let views = views(&cell, rng.random_range(4..16), radius_m);
    (cell, views, free_roll)
}

#[test]
fn every_plan_of_random_cells_passes_the_independent_checker() {
    let mut rng = ChaCha8Rng::seed_from_u64(5);
    let (mut planned, mut asked, mut detours) = (0, 0, 0);
    for _ in 0..120 {
        let (cell, views, free_roll) = random_cell(&mut rng);
        let order = by_camera_path(&cell, &views);
        let mut request = MotionRequest::new(&cell, &views);
        request.order = Order::By(as_order(&order));
        request.roll = if free_roll { Roll::Free { samples: 6 } } else { Roll::Fixed };
        let plan = plan_motion(&request).unwrap();
        assert_eq!(check(&request, &plan), vec![]);
        planned += plan.planned_count();
        asked += views.len();
        detours += plan.legs.iter().filter(|l| l.waypoints_rad.len() > 2).count();
    }
    println!("{planned} of {asked} views planned, {detours} detours");
    // Without plans and detours the assertions above would say nothing.
    assert!(planned > asked / 4 && detours > 0);
}

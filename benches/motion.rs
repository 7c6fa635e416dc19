//! Planning time of the arm's motion: `cargo bench --bench motion`.

mod common;

use std::hint::black_box;
use std::time::Duration;

use common::{median_time, row};
use nalgebra::{Translation3, UnitQuaternion};
use prv::geometry::{Point, Pose};
use prv::motion::{Cell, CellObject, MotionRequest, Order, Roll, SkipReason, ViewOutcome, plan_motion};
use prv::order::{Obstacle, order_points};
use prv::robot::RobotModel;
use prv::views::{Band, ViewSpace, tammes};

fn main() {
    for count in [20, 35, 58] {
        for (name, roll) in [("fixed roll", Roll::Fixed), ("free roll", Roll::FREE)] {
            plan(count, name, roll);
        }
    }
}

/// A UR5e with a D435 60 mm ahead of its flange, a 0.1 m object at (0.45, 0), views 0.3 m around it.
fn plan(count: usize, name: &str, roll: Roll) {
    let flange_from_camera = Pose::from_parts(Translation3::new(0.0, 0.0, 0.06), UnitQuaternion::identity());
    let Ok(robot) = RobotModel::named("ur5e") else { return };
    let mut cell = Cell::new(robot, flange_from_camera);
    let center_in_base = Point::new(0.45, 0.0, 0.1);
    cell.object = Some(CellObject::sphere(center_in_base, 0.1));
    cell.table_z_m = Some(0.0);
    let Ok(set) = tammes(count, Band::DEFAULT) else { return };
    let space = ViewSpace { center_in_base, radius_m: 0.3, band: Band::DEFAULT };
    let views: Vec<Pose> = set.directions.iter().map(|d| space.pose(d, 0.0)).collect();
    let points: Vec<Point> = views.iter().map(|p| Point::from(p.translation.vector)).collect();
    let obstacle = Obstacle { center: center_in_base, radius_m: 0.1, table_z_m: Some(0.0) };
    let order = |reachable: &[usize], first: usize| {
        let points: Vec<Point> = reachable.iter().filter_map(|&i| points.get(i).copied()).collect();
        order_points(&points, first, &obstacle, Duration::from_secs(5)).map(|o| o.order).unwrap_or_default()
    };
    let mut request = MotionRequest::new(&cell, &views);
    request.roll = roll;
    // The order is not part of the figure: it has its own bench.
    let mut visited = Vec::new();
    request.order = Order::By(&order);
    if let Ok(plan) = plan_motion(&request) {
        visited.clone_from(&plan.order);
        let detours = plan.legs.iter().filter(|l| l.waypoints_rad.len() > 2).count();
        println!(
            "{count} views, {name}: {} planned, {:.1} s of motion, {:.1} rad of joint travel, {detours} detours{}",
            plan.planned_count(),
            plan.duration_s,
            plan.joint_travel_rad,
            reasons(&plan.views)
        );
    }
    let known = |reachable: &[usize], _: usize| {
        let position = |view: &usize| reachable.iter().position(|v| v == view);
        let mut order: Vec<usize> = visited.iter().filter_map(position).collect();
        order.extend((0..reachable.len()).filter(|i| !visited.contains(&reachable[*i])));
        order
    };
    request.order = Order::By(&known);
    let time = median_time(11, 1, || {
        black_box(plan_motion(&request).is_ok());
    });
    row(&format!("plan, {count} views, {name}"), time * 1e3, "ms", (count == 58).then_some(30.0));
}

fn reasons(views: &[ViewOutcome]) -> String {
    let codes = views.iter().filter_map(|v| match v {
        ViewOutcome::Skipped(reason) => Some(reason),
        ViewOutcome::Planned(_) => None,
    });
    let mut counts = std::collections::BTreeMap::new();
    codes.map(SkipReason::code).for_each(|code| *counts.entry(code).or_insert(0) += 1);
    counts.iter().map(|(code, n)| format!(", {n} {code}")).collect()
}

//! Planning time of the arm's motion: `cargo bench --bench motion`.

mod common;

use std::hint::black_box;
use std::time::Duration;

use common::{median_processor_time, median_time, row};
use nalgebra::{Translation3, UnitQuaternion};
use prv::geometry::{Point, Pose, Vector};
use prv::motion::{
    Cell, CellObject, KeepOut, MotionRequest, ObjectShape, Order, Roll, SkipReason, ViewOutcome, check,
    plan_motion,
};
use prv::order::{Obstacle, order_points};
use prv::robot::{LinkShape, RobotModel};
use prv::views::{Band, ViewSpace, tammes};

fn main() {
    for count in [20, 35, 58] {
        for (name, roll) in [("fixed roll", Roll::Fixed), ("free roll", Roll::FREE)] {
            plan(count, name, roll);
        }
    }
    row("VAMP, one collision-free leg, median (published)", 0.035, "ms", None);
    row("cuRobo, one collision-free motion on a GPU (published, 30 to 50)", 30.0, "ms", None);
    shapes();
    jerk_limited();
}

/// What the object's shape and keep-out regions cost: 58 views in a good order, fixed roll.
fn shapes() {
    let cylinder = ObjectShape::Cylinder { radius_m: 0.06, height_m: 0.16 };
    let cuboid = ObjectShape::Cuboid { size_m: Vector::new(0.1, 0.1, 0.14), yaw_rad: 0.4 };
    let post = |i: i32| KeepOut {
        name: format!("post {i}"),
        shape_in_base: LinkShape::capsule(
            [-0.4, 0.3 * f64::from(i), 0.0],
            [-0.4, 0.3 * f64::from(i), 1.0],
            0.05,
        ),
    };
    for (name, shape, posts) in [
        ("sphere", ObjectShape::Sphere, 0),
        ("cylinder", cylinder, 0),
        ("box", cuboid, 0),
        ("sphere and 4 posts", ObjectShape::Sphere, 4),
    ] {
        let Some((mut cell, views)) = cell_and_views(58) else { return };
        if let Some(object) = &mut cell.object {
            object.shape = shape;
        }
        cell.keep_out.extend((0..posts).map(post));
        let points: Vec<Point> = views.iter().map(|p| Point::from(p.translation.vector)).collect();
        let obstacle = Obstacle { center: Point::new(0.45, 0.0, 0.1), radius_m: 0.1, table_z_m: Some(0.0) };
        let Ok(path) = order_points(&points, 0, &obstacle, Duration::from_secs(5)) else { return };
        let views: Vec<Pose> = path.order.iter().filter_map(|i| views.get(*i).copied()).collect();
        let request = MotionRequest::new(&cell, &views);
        let time = median_processor_time(7, 1, || {
            black_box(plan_motion(&request).is_ok());
        });
        row(&format!("plan, 58 views, fixed roll, object {name}"), time * 1e3, "ms", None);
    }
}

/// How much longer a motion takes when its jerk is bounded, and what the check of it costs.
fn jerk_limited() {
    let Some((cell, views)) = cell_and_views(35) else { return };
    let mut request = MotionRequest::new(&cell, &views);
    request.roll = Roll::FREE;
    request.timing.settle_s = 0.0;
    let Ok(without) = plan_motion(&request) else { return };
    request.timing.jerk_limited = true;
    let Ok(with) = plan_motion(&request) else { return };
    row("motion of 35 views, jerk not bounded", without.duration_s, "s", None);
    row("the same, 100 rad/s3 (assumed for a UR5e)", with.duration_s, "s", None);
    row("longer by", 100.0 * (with.duration_s / without.duration_s - 1.0), "%", None);
    println!("{} violations", check(&request, &with).len());
    let time = median_processor_time(5, 1, || {
        black_box(check(&request, &with).len());
    });
    row("its independent check", time * 1e3, "ms", None);
}

/// A UR5e with a D435 60 mm ahead of its flange, a 0.1 m object at (0.45, 0), views 0.3 m around it.
fn cell_and_views(count: usize) -> Option<(Cell, Vec<Pose>)> {
    let flange_from_camera = Pose::from_parts(Translation3::new(0.0, 0.0, 0.06), UnitQuaternion::identity());
    let mut cell = Cell::new(RobotModel::named("ur5e").ok()?, flange_from_camera);
    let center_in_base = Point::new(0.45, 0.0, 0.1);
    cell.object = Some(CellObject::sphere(center_in_base, 0.1));
    cell.table_z_m = Some(0.0);
    let set = tammes(count, Band::DEFAULT).ok()?;
    let space = ViewSpace { center_in_base, radius_m: 0.3, band: Band::DEFAULT };
    let views = set.directions.iter().map(|d| space.pose(d, 0.0)).collect();
    Some((cell, views))
}

fn plan(count: usize, name: &str, roll: Roll) {
    let Some((cell, views)) = cell_and_views(count) else { return };
    let center_in_base = Point::new(0.45, 0.0, 0.1);
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

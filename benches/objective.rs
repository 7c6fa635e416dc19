//! Execution time of plans made for time against plans made for distance, on random UR5e cells:
//! `cargo bench --bench objective [-- CELLS]`.

mod common;

use std::time::{Duration, Instant};

use common::row;
use nalgebra::{Translation3, UnitQuaternion};
use prv::geometry::{Point, Pose, Vector};
use prv::motion::{
    Cell, CellObject, MotionRequest, Objective, Order, Roll, check, default_camera_body, plan_motion,
};
use prv::order::{Obstacle, order_points};
use prv::robot::RobotModel;
use prv::views::{Band, ViewSpace, tammes};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

const VIEWS: usize = 35;

fn main() {
    let cells = std::env::args().skip(1).find_map(|a| a.parse().ok()).unwrap_or(200);
    for (name, roll) in [("fixed roll", Roll::Fixed), ("free roll", Roll::FREE)] {
        compare(cells, name, roll);
    }
}

/// A UR5e somewhere near its object, with a camera mounted somehow ahead of its flange.
fn random_cell(rng: &mut ChaCha8Rng) -> Option<Cell> {
    let mut uniform = |low: f64, high: f64| rng.random_range(low..high);
    let (azimuth, distance) = (uniform(-3.1, 3.1), uniform(0.35, 0.6));
    let radius_m = uniform(0.07, 0.12);
    let turn = UnitQuaternion::from_scaled_axis(Vector::new(
        uniform(-0.2, 0.2),
        uniform(-0.2, 0.2),
        uniform(-3.1, 3.1),
    ));
    let mount = Translation3::new(uniform(-0.05, 0.05), uniform(-0.05, 0.05), uniform(0.03, 0.08));
    let mut cell = Cell::new(RobotModel::named("ur5e").ok()?, Pose::from_parts(mount, turn));
    cell.camera_body = default_camera_body(&cell.flange_from_camera);
    let center_in_base = Point::new(distance * azimuth.cos(), distance * azimuth.sin(), radius_m);
    cell.object = Some(CellObject::sphere(center_in_base, radius_m));
    cell.table_z_m = Some(0.0);
    Some(cell)
}

fn compare(cells: usize, name: &str, roll: Roll) {
    let mut rng = ChaCha8Rng::seed_from_u64(7);
    let (mut shares, mut least, mut moving, mut times, mut wrong, mut planned) =
        (vec![], vec![], vec![], vec![], 0, 0);
    while times.len() < cells {
        let Some(cell) = random_cell(&mut rng) else { return };
        let Some(object) = cell.object else { return };
        let Ok(set) = tammes(VIEWS, Band::DEFAULT) else { return };
        let space = ViewSpace { center_in_base: object.center_in_base, radius_m: 0.3, band: Band::DEFAULT };
        let views: Vec<Pose> = set.directions.iter().map(|d| space.pose(d, 0.0)).collect();
        let points: Vec<Point> = views.iter().map(|p| Point::from(p.translation.vector)).collect();
        let obstacle =
            Obstacle { center: object.center_in_base, radius_m: object.radius_m, table_z_m: Some(0.0) };
        let by_length = |reachable: &[usize], first: usize| {
            let points: Vec<Point> = reachable.iter().filter_map(|&i| points.get(i).copied()).collect();
            order_points(&points, first, &obstacle, Duration::from_secs(5))
                .map(|o| o.order)
                .unwrap_or_default()
        };
        let mut request = MotionRequest::new(&cell, &views);
        (request.roll, request.order, request.objective) = (roll, Order::By(&by_length), Objective::Time);
        let begin = Instant::now();
        let Ok(plan) = plan_motion(&request) else { continue };
        let seconds = begin.elapsed().as_secs_f64();
        let Some(compared) = &plan.compared else { continue };
        if plan.planned_count() < VIEWS / 2 {
            continue;
        }
        times.push(seconds);
        planned += plan.planned_count();
        wrong += usize::from(!check(&request, &plan).is_empty());
        shares.push(plan.duration_s / compared.duration_s);
        least.extend(compared.least_duration_s.map(|least_s| least_s / compared.duration_s));
        let still = request.timing.settle_s * plan.planned_count() as f64;
        moving.push((plan.duration_s - still) / (compared.duration_s - still));
    }
    println!(
        "{VIEWS} views, {name}, {cells} cells with {planned} views planned; {wrong} plans refused by the checker"
    );
    row("execution time for time against for distance, median", median(&mut shares), "", Some(0.75));
    row("proven: no order and choice of states takes less than", median(&mut least), "", None);
    row("time for time against for distance, without rests", median(&mut moving), "", None);
    row("planning both, median", median(&mut times) * 1e3, "ms", Some(300.0));
}

fn median(values: &mut [f64]) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}

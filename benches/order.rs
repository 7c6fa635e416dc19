//! Time of the exact order on Tammes sets and on random points, beside greedy and 2-opt.

mod common;

use std::hint::black_box;
use std::time::{Duration, Instant};

use common::{median_time, row};
use prv::geometry::Point;
use prv::order::{CostMatrix, LocalPath, Obstacle, nearest_neighbour, shortest_path, two_opt};
use prv::views::{Band, ViewSpace, tammes};
use rand::Rng;
use rand_chacha::{ChaCha8Rng, rand_core::SeedableRng};

const BUDGET: Duration = Duration::from_secs(20);

fn main() {
    let space = ViewSpace { center_in_base: Point::new(0.5, 0.0, 0.1), radius_m: 0.3, band: Band::DEFAULT };
    let obstacle = Obstacle { center: space.center_in_base, radius_m: 0.10625, table_z_m: Some(0.0) };
    let directions = tammes(58, space.band).map(|set| set.directions).unwrap_or_default();
    let around: Vec<Point> = directions.iter().map(|d| space.position(d)).collect();
    // From the last view, on the rim, to the one farthest from it: around the ball.
    let across = |a: Point| around.iter().copied().max_by(|p, q| (p - a).norm().total_cmp(&(q - a).norm()));
    if let Some((a, b)) = around.last().and_then(|&a| Some((a, across(a)?))) {
        let seconds = median_time(21, 1000, || {
            black_box(LocalPath::between(black_box(a), black_box(b), &obstacle).length_m());
        });
        row("local path", seconds * 1e6, "us", None);
    }
    for (n, bound_ms) in [(20, None), (35, None), (58, Some(5.0)), (80, None), (100, Some(50.0))] {
        if let Some(matrix) = tammes_matrix(n, &space, &obstacle) {
            compare(&format!("{n} Tammes views"), &matrix, bound_ms);
        }
    }
    for (n, bound_ms) in [(58, 5.0), (100, 50.0)] {
        let mut milliseconds: Vec<f64> = Vec::new();
        let mut unproven = 0;
        for seed in 0..25 {
            let mut rng = ChaCha8Rng::seed_from_u64(seed);
            let points: Vec<Point> = (0..n).map(|_| random_view(&space, &mut rng)).collect();
            let Ok(matrix) = CostMatrix::from_points(&points, &obstacle) else { continue };
            let (ms, proven) = solve(&matrix);
            unproven += usize::from(!proven);
            milliseconds.push(ms);
        }
        milliseconds.sort_by(f64::total_cmp);
        row(&format!("{n} random views: median"), milliseconds[milliseconds.len() / 2], "ms", Some(bound_ms));
        row(&format!("{n} random views: slowest of 25"), milliseconds[milliseconds.len() - 1], "ms", None);
        row(&format!("{n} random views: not proven optimal"), unproven as f64, "", Some(0.0));
    }
    let (mut unproven, mut slowest) = (0, (0.0, 0));
    for n in 30..=100 {
        let Some(matrix) = tammes_matrix(n, &space, &obstacle) else { continue };
        let (ms, proven) = solve(&matrix);
        unproven += usize::from(!proven);
        if ms > slowest.0 {
            slowest = (ms, n);
        }
    }
    row(&format!("slowest of 30 to 100 Tammes views ({})", slowest.1), slowest.0, "ms", None);
    row("30 to 100 Tammes views: not proven optimal", unproven as f64, "", Some(0.0));
}

fn tammes_matrix(n: usize, space: &ViewSpace, obstacle: &Obstacle) -> Option<CostMatrix> {
    let set = tammes(n, space.band).ok()?;
    let points: Vec<Point> = set.directions.iter().map(|d| space.position(d)).collect();
    CostMatrix::from_points(&points, obstacle).ok()
}

/// Milliseconds, and whether the path is proven optimal.
fn solve(matrix: &CostMatrix) -> (f64, bool) {
    let begin = Instant::now();
    let proven = shortest_path(matrix, 0, BUDGET).is_ok_and(|path| path.optimal);
    (begin.elapsed().as_secs_f64() * 1e3, proven)
}

fn compare(name: &str, matrix: &CostMatrix, bound_ms: Option<f64>) {
    let Ok(path) = shortest_path(matrix, 0, BUDGET) else { return };
    let seconds = median_time(11, 1, || drop(black_box(shortest_path(matrix, 0, BUDGET))));
    row(&format!("{name}: exact"), seconds * 1e3, "ms", bound_ms);
    let gap = (path.length - path.lower_bound) / path.length;
    row(&format!("{name}: gap, parts in 10^9"), gap * 1e9, "", Some(1.0));
    let mut order = nearest_neighbour(matrix, 0);
    row(&format!("{name}: greedy is longer by"), excess(matrix, &order, path.length), "%", None);
    two_opt(matrix, &mut order);
    row(&format!("{name}: greedy and 2-opt is longer by"), excess(matrix, &order, path.length), "%", None);
}

fn excess(matrix: &CostMatrix, order: &[usize], best: f64) -> f64 {
    100.0 * (matrix.path_length(order) / best - 1.0)
}

fn random_view(space: &ViewSpace, rng: &mut ChaCha8Rng) -> Point {
    let z: f64 = rng.random_range(space.band.min_elevation_rad.sin()..1.0);
    let azimuth: f64 = rng.random_range(0.0..std::f64::consts::TAU);
    let horizontal = (1.0 - z * z).sqrt();
    space.center_in_base
        + nalgebra::Vector3::new(horizontal * azimuth.cos(), horizontal * azimuth.sin(), z) * space.radius_m
}

//! Time of the exact order on Tammes sets and on random points, beside HiGHS, greedy and 2-opt.
//!
//! HiGHS takes minutes to build: `make bench` does, or `cargo bench --features peers` where cmake and libclang are.

mod common;
#[cfg(feature = "peers")]
mod peers;

use std::hint::black_box;
use std::time::Duration;

use common::{median_processor_time, median_time, processor_time, row};
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
    if cfg!(not(feature = "peers")) {
        println!(
            "HiGHS is not built in: `make bench` compares with it (minutes of building; cmake and libclang)"
        );
    }
    for (n, bound_ms) in [(30, None), (58, Some(5.0)), (100, Some(50.0))] {
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
            #[cfg(feature = "peers")]
            if seed < 3 {
                compare_with_highs(&format!("{n} random views, set {seed}"), &matrix, ms * 1e-3, 1e-4);
            }
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

/// Milliseconds of this thread, and whether the path is proven optimal.
fn solve(matrix: &CostMatrix) -> (f64, bool) {
    let (path, seconds) = processor_time(|| shortest_path(matrix, 0, BUDGET));
    (seconds * 1e3, path.is_ok_and(|path| path.optimal))
}

/// Our path and the peers': one row each, in milliseconds of one thread.
fn compare(name: &str, matrix: &CostMatrix, bound_ms: Option<f64>) {
    let Ok(path) = shortest_path(matrix, 0, BUDGET) else { return };
    let seconds = median_processor_time(11, 1, || drop(black_box(shortest_path(matrix, 0, BUDGET))));
    row(&format!("{name}: exact"), seconds * 1e3, "ms", bound_ms);
    let gap = (path.length - path.lower_bound) / path.length;
    row(&format!("{name}: gap, parts in 10^9"), gap * 1e9, "", Some(1.0));
    #[cfg(feature = "peers")]
    for gap in [1e-4, 0.0] {
        compare_with_highs(name, matrix, seconds, gap);
    }
    let greedy = nearest_neighbour(matrix, 0);
    let greedy_seconds =
        median_processor_time(21, 100, || drop(black_box(nearest_neighbour(black_box(matrix), 0))));
    peer_row(&format!("{name}: greedy"), greedy_seconds, excess(matrix, &greedy, path.length), "");
    let improved = || {
        let mut order = nearest_neighbour(black_box(matrix), 0);
        two_opt(matrix, &mut order);
        order
    };
    let improved_seconds = median_processor_time(21, 10, || drop(black_box(improved())));
    let name = format!("{name}: greedy and 2-opt");
    peer_row(&name, improved_seconds, excess(matrix, &improved(), path.length), "");
}

/// One run of HiGHS, beside the `seconds` that our path took.
#[cfg(feature = "peers")]
fn compare_with_highs(name: &str, matrix: &CostMatrix, seconds: f64, gap: f64) {
    let Ok(path) = shortest_path(matrix, 0, BUDGET) else { return };
    let (found, peer_seconds) = processor_time(|| peers::highs_path(matrix, 0, gap));
    let name = format!("{name}: HiGHS, gap {gap}");
    let Some(found) = found else {
        println!("{name}: no path found");
        return;
    };
    let note = format!("{:.0} times ours, {} programmes", peer_seconds / seconds, found.programmes);
    peer_row(&name, peer_seconds, excess(matrix, &found.order, path.length), &note);
}

/// A peer's time, and by how many percent its path is longer than ours.
fn peer_row(name: &str, seconds: f64, excess_percent: f64, note: &str) {
    let comma = if note.is_empty() { "" } else { "; " };
    println!("{name:<58} {:>12.3} ms     {excess_percent:>9.4} % longer{comma}{note}", seconds * 1e3);
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

//! Separation of the sets and time of the generator and of adaptation, beside their bounds.

mod common;

use std::hint::black_box;

use common::{median_time, row};
use prv::api::{PlanRequestJson, Planner, ResolvedRequest, parse_json, reachability_of};
use prv::motion::Stop;
use prv::views::{Band, best_known_rad, tammes};

/// Least separation asked for on the closed hemisphere, degrees.
const HEMISPHERE: [(usize, f64); 8] =
    [(5, 90.0), (10, 51.96), (13, 46.76), (20, 35.88), (30, 29.50), (40, 24.88), (50, 22.41), (58, 20.49)];
/// Separation of the paper authors' hemisphere sets, degrees.
const AUTHORS: [(usize, f64); 8] =
    [(5, 77.87), (10, 47.69), (13, 43.71), (20, 33.49), (30, 28.26), (40, 24.42), (50, 21.72), (58, 19.99)];
/// Bands that were searched long, degrees.
const SEARCHED: [(f64, f64); 3] = [(0.0, 90.0), (5.0, 90.0), (10.0, 80.0)];

fn main() {
    let hemisphere = Band { min_elevation_rad: 0.0, max_elevation_rad: Band::DEFAULT.max_elevation_rad };
    for (n, bound_deg) in HEMISPHERE {
        let Ok(set) = tammes(n, hemisphere) else { continue };
        let separation_deg = set.separation_rad.to_degrees();
        row(&format!("separation of {n} views, 0 to 90 deg"), separation_deg, "deg", None);
        if let Some((_, theirs_deg)) = AUTHORS.iter().find(|(count, _)| *count == n) {
            row("  the paper authors' set of that many (published)", *theirs_deg, "deg", None);
        }
        // Bounds are given to two decimals.
        row(&format!("  short of {bound_deg} by"), bound_deg - separation_deg, "deg", Some(0.005));
    }
    for (low, high) in SEARCHED {
        let Ok(band) = Band::from_degrees(low, high) else { continue };
        let shortfall = |n: usize| {
            let (set, best_rad) = (tammes(n, band).ok()?, best_known_rad(n, band)?);
            Some((100.0 * (1.0 - set.separation_rad / best_rad), n))
        };
        let all: Vec<(f64, usize)> = (3..=100).filter_map(shortfall).collect();
        let Some(&(worst, at)) = all.iter().max_by(|a, b| a.0.total_cmp(&b.0)) else { continue };
        let what =
            format!("{} sets, {low} to {high} deg, short of the best known, worst ({at} views)", all.len());
        row(&what, worst, "%", Some(0.3));
    }
    for (n, bound_s) in [(35, None), (58, None), (100, Some(2.0))] {
        let seconds = median_time(1, 1, || drop(black_box(tammes(n, hemisphere))));
        row(&format!("generator, {n} views"), seconds, "s", bound_s);
    }
    for n in [35, 200] {
        let seconds = median_time(21, 5, || drop(black_box(tammes(n, Band::DEFAULT))));
        row(&format!("table, {n} views"), seconds * 1e3, "ms", None);
    }
    adaptation();
}

/// Time to replace the views that a UR5e cannot reach, without the motion through them.
fn adaptation() {
    let planner = Planner::load(None, 1, 1);
    for (n, roll, bound_ms) in [
        (35, "fixed", Some(50.0)),
        (35, "free", Some(150.0)),
        (58, "fixed", None),
        (58, "free", None),
        (100, "free", None),
    ] {
        let text = format!(
            r#"{{"view_count": {n}, "roll": "{roll}", "robot": {{"model": "ur5e"}},
                "object": {{"center": [0.45, 0.0, 0.1], "radius": 0.1, "table_z": 0.0}},
                "flange_from_camera": {{"position": [0, 0, 0.05], "orientation": [0, 0, 0, 1]}}}}"#
        );
        let Ok(json) = parse_json::<PlanRequestJson>(text.as_bytes()) else { continue };
        let request = ResolvedRequest::from(json.clone());
        let mut times: Vec<f64> =
            (0..11).filter_map(|_| planner.plan(&request).ok()?.timings_ms.get("adapt").copied()).collect();
        times.sort_by(f64::total_cmp);
        let median = times.get(times.len() / 2).copied().unwrap_or(f64::NAN);
        row(&format!("adapting {n} views, UR5e, {roll} roll"), median, "ms", bound_ms);
        if n == 35 {
            let seconds =
                median_time(5, 1, || drop(black_box(reachability_of(&json, None, None, &Stop::default()))));
            row(&format!("reachability of the band, UR5e, {roll} roll"), seconds, "s", Some(1.0));
        }
    }
}

//! Separation of the sets and time of the generator, beside their bounds.

mod common;

use std::hint::black_box;

use common::{median_time, row};
use prv::views::{Band, tammes};

/// Least separation asked for on the closed hemisphere, degrees.
const HEMISPHERE: [(usize, f64); 8] =
    [(5, 90.0), (10, 51.96), (13, 46.76), (20, 35.88), (30, 29.50), (40, 24.88), (50, 22.41), (58, 20.49)];

fn main() {
    let hemisphere = Band { min_elevation_rad: 0.0, max_elevation_rad: Band::DEFAULT.max_elevation_rad };
    for (n, bound_deg) in HEMISPHERE {
        let Ok(set) = tammes(n, hemisphere) else { continue };
        let separation_deg = set.separation_rad.to_degrees();
        row(&format!("separation of {n} views, 0 to 90 deg"), separation_deg, "deg", None);
        // Bounds are given to two decimals.
        row(&format!("  short of {bound_deg} by"), bound_deg - separation_deg, "deg", Some(0.005));
    }
    for (n, bound_s) in [(35, None), (58, None), (100, Some(2.0))] {
        let seconds = median_time(1, 1, || drop(black_box(tammes(n, hemisphere))));
        row(&format!("generator, {n} views"), seconds, "s", bound_s);
    }
    for n in [35, 200] {
        let seconds = median_time(21, 5, || drop(black_box(tammes(n, Band::DEFAULT))));
        row(&format!("table, {n} views"), seconds * 1e3, "ms", None);
    }
}

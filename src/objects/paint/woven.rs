//! Cloth and wickerwork.

use super::Painter;
use super::color::{Color, mix, scaled};
use super::noise::{fractal, unit};
use crate::objects::exact::wave;

/// Threads over and under each other, `count` across and along; some are of the second colour.
pub(super) fn woven(count: [i32; 2], colors: [Color; 2], share: f32, seed: u32) -> Painter {
    Box::new(move |u, v| {
        let (x, y) = (u * count[0] as f32, v * count[1] as f32);
        let (i, j) = (x.floor() as i32, y.floor() as i32);
        let over = (i + j).rem_euclid(2) == 0;
        let (thread, across) =
            if over { (unit(i, -1, seed), x - x.floor()) } else { (unit(-1, j, seed), y - y.floor()) };
        let bulge = 1.0 - 1.6 * (across - 0.5) * (across - 0.5);
        let color = if thread < share { colors[1] } else { colors[0] };
        scaled(color, (0.6 + 0.4 * bulge) * (0.92 + 0.16 * unit(i, j, seed + 1)))
    })
}

/// Knitted rows of stitches with a pattern of `motif` stitches a side.
pub(super) fn knitted(count: [i32; 2], colors: [Color; 3], motif: i32, seed: u32) -> Painter {
    Box::new(move |u, v| {
        let (x, y) = (u * count[0] as f32, v * count[1] as f32);
        let lean = ((x - x.floor()) - 0.5).abs();
        let row = y + lean * 0.9;
        let (i, j) = (x.floor() as i32, row.floor() as i32);
        let (a, b) = (i.rem_euclid(motif), j.rem_euclid(motif));
        // Mirrored, as knitters do.
        let cell = unit(a.min(motif - 1 - a), b.min(motif - 1 - b), seed);
        let color = if cell < 0.45 {
            colors[0]
        } else if cell < 0.8 {
            colors[1]
        } else {
            colors[2]
        };
        let inside = row - row.floor();
        scaled(color, 0.68 + 0.32 * (1.0 - (2.0 * inside - 1.0).abs()) + 0.1 * (0.5 - lean))
    })
}

/// Stone or earth: layers of clouds with veins.
pub(super) fn veined(count: [i32; 2], colors: [Color; 3], veins: f32, seed: u32) -> Painter {
    Box::new(move |u, v| {
        let (x, y) = (u * count[0] as f32, v * count[1] as f32);
        let warp = fractal(x, y, count, 5, seed);
        let cloud = fractal(x * 2.0 + warp * 3.0, y * 2.0, count.map(|c| c * 2), 5, seed + 7);
        let vein = 1.0 - (wave((cloud + warp) * veins).abs() * 3.5).min(1.0);
        mix(mix(colors[0], colors[1], (cloud - 0.3) * 2.2), colors[2], vein * 0.8)
    })
}

//! A pot plant; its leaves are cut out of their texture.

use std::f32::consts::TAU;

use rand::Rng;
use rand_chacha::ChaCha8Rng;

use super::build::{Builder, WHOLE, placed, rounded};
use super::noise;
use super::paint::{any_hue, mix, of_hue, painted, painted_with_holes, scaled};
use crate::render::Mesh;

pub(super) fn make(rng: &mut ChaCha8Rng) -> Mesh {
    let seed: u32 = rng.random();
    let (ring, green) = (any_hue(rng, 0.6, 0.85), of_hue(rng.random_range(0.24..0.38), 0.7, 0.62));
    let mut b = Builder::new();
    let clay = b.material(painted("clay pot", (1024, 512), |u, v| {
        let lime = noise::fractal(u * 10.0, v * 5.0, 10, seed);
        let clay = mix([0.66, 0.33, 0.2], [0.86, 0.72, 0.6], (lime - 0.5) * 2.2);
        let zigzag = ((u * 16.0).fract() - 0.5).abs() * 0.16 + 0.45;
        let painted = (v - zigzag).abs() < 0.035 || (v - 0.78).abs() < 0.02;
        scaled(
            if painted { mix(ring, clay, 0.25 * lime) } else { clay },
            0.85 + 0.3 * noise::smooth(u * 90.0, v * 45.0, 90, seed + 1),
        )
    }));
    let soil = b.material(painted("soil", (256, 256), |u, v| {
        scaled([0.3, 0.21, 0.14], 0.4 + 1.3 * noise::fractal(u * 20.0, v * 9.0, 20, seed + 2).powi(2) * 2.0)
    }));
    let leaf = b.material(painted_with_holes("leaf", (256, 512), |u, v| {
        let across = (u - 0.5).abs() * 2.0;
        // v = 0 is the tip; a serrated outline.
        let t = 1.0 - v;
        let width = (t.powf(0.6) * (1.0 - t).powf(0.45) * 1.75).min(1.0) * (0.93 + 0.07 * (t * 90.0).sin());
        if across > width {
            return None;
        }
        let vein = across < 0.035 || ((t - across * 0.35) * 9.0).fract() < 0.09;
        let c = scaled(green, 0.65 + 0.7 * noise::fractal(u * 8.0, v * 16.0, 8, seed + 3));
        Some(if vein {
            mix(c, [0.85, 0.92, 0.6], 0.6)
        } else {
            mix(c, [0.75, 0.75, 0.25], (across - 0.75) * 1.5)
        })
    }));
    let stem = b.material(painted("stem", (64, 128), |u, v| {
        scaled(green, 0.5 + 0.4 * noise::smooth(u * 8.0, v * 30.0, 8, seed + 4))
    }));
    let pot = rounded(&[
        [0.042, 0.082],
        [0.048, 0.086],
        [0.05, 0.084],
        [0.05, 0.068],
        [0.045, 0.066],
        [0.034, 0.0],
        [0.0, 0.0],
    ]);
    b.lathe(72, &pot, WHOLE, clay);
    b.lathe(48, &[[0.0, 0.079], [0.02, 0.0775], [0.0425, 0.074], [0.042, 0.083]], WHOLE, soil);
    let leaves = 17;
    for i in 0..leaves {
        let share = i as f32 / leaves as f32;
        // Golden angle between leaves; inner ones stand steeper and are longer.
        let turn = i as f32 * 2.4 + rng.random_range(-0.15..0.15);
        let (steep, length) = (1.25 - 0.95 * share + rng.random_range(-0.08..0.08), 0.13 - 0.04 * share);
        let droop = 0.5 + 1.1 * share;
        let wide = 0.021 + rng.random_range(0.0..0.006);
        let foot = 0.006 + 0.012 * share;
        let (out, up) = (steep.cos(), steep.sin());
        let spine = |t: f32| {
            let s = t * length;
            [foot + s * out, 0.0, 0.07 + s * up - droop * s * s * 3.2]
        };
        b.at = placed(0.0, 0.0, 0.0, turn);
        b.tube((8, 8), stem, |t| spine(t * 0.4), |t| 0.0022 - 0.0012 * t);
        b.grid((8, 16), WHOLE, leaf, |i, j| {
            let (s, t) = (i as f32 / 8.0 * 2.0 - 1.0, 1.0 - j as f32 / 16.0);
            let [x, _, z] = spine(0.3 + 0.7 * t);
            let fold = 0.35 * s.abs() * wide;
            [x, s * wide, z + fold + 0.002 * (t * TAU * 2.0 + s * 2.0).sin()]
        });
    }
    b.finish()
}

//! A globe of an invented planet on a wooden stand.

use std::f32::consts::TAU;

use rand::Rng;
use rand_chacha::ChaCha8Rng;

use super::build::{Builder, WHOLE, rounded};
use super::noise;
use super::paint::{mix, of_hue, painted, scaled, wood};
use crate::render::Mesh;

pub(super) fn make(rng: &mut ChaCha8Rng) -> Mesh {
    let seed: u32 = rng.random();
    let sea = of_hue(rng.random_range(0.5..0.66), 0.65, 0.6);
    let mut b = Builder::new();
    let map = b.material(painted("map", (1024, 512), |u, v| {
        let latitude = (v - 0.5).abs() * 2.0;
        let height = noise::fractal(u * 5.0, v * 3.5, 5, seed)
            + 0.08 * noise::fractal(u * 40.0, v * 20.0, 40, seed + 6);
        let line = [u * 24.0, v * 12.0].iter().any(|c| (c.fract() - 0.5).abs() > 0.475);
        let country = noise::cell(u * 30.0 + 3.0 * height, v * 15.0, seed + 7);
        let c = if latitude > 0.8 + 0.25 * (height - 0.5) {
            [0.95, 0.96, 0.97]
        } else if height > 0.56 {
            scaled(of_hue(country * 0.45, 0.55, 0.85), 1.25 - height * 0.6)
        } else {
            mix(scaled(sea, 0.6), mix(sea, [1.0; 3], 0.3), (height - 0.25) * 3.0)
        };
        if line { scaled(c, 0.6) } else { c }
    }));
    let stand = b.material(painted("stand", (512, 256), |u, v| wood(v, u, seed + 8)));
    let brass = b.material(painted("brass", (512, 64), |u, v| {
        let mark = (u * 72.0).fract() < 0.2 && v < 0.5;
        scaled(
            [0.8, 0.62, 0.25],
            if mark { 0.3 } else { 0.8 + 0.3 * noise::smooth(u * 60.0, v * 8.0, 60, seed) },
        )
    }));
    b.ball([0.0, 0.0, 0.11], 0.06, 40, map);
    let foot = rounded(&[
        [0.006, 0.046],
        [0.008, 0.03],
        [0.012, 0.022],
        [0.036, 0.014],
        [0.042, 0.008],
        [0.042, 0.0],
        [0.0, 0.0],
    ]);
    b.lathe(64, &foot, WHOLE, stand);
    // The meridian: half a flat ring about the ball.
    b.grid((48, 4), WHOLE, brass, |i, j| {
        let angle = TAU * (0.5 * i as f32 / 48.0) - TAU / 4.0;
        let corner = [(0.0625, -0.003), (0.0665, -0.003), (0.0665, 0.003), (0.0625, 0.003)][(j % 4) as usize];
        [corner.0 * angle.cos(), corner.1, 0.11 + corner.0 * angle.sin()]
    });
    for end in [-1.0f32, 1.0] {
        b.tube((12, 2), brass, |t| [0.0, 0.0, 0.11 + end * (0.059 + 0.009 * t)], |_| 0.003);
    }
    b.finish()
}

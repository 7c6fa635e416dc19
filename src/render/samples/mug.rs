//! A mug with a painted band and a handle.

use std::f32::consts::TAU;

use rand::Rng;
use rand_chacha::ChaCha8Rng;

use super::build::{Builder, WHOLE, rounded};
use super::noise;
use super::paint::{any_hue, mix, painted, scaled};
use crate::render::Mesh;

pub(super) fn make(rng: &mut ChaCha8Rng) -> Mesh {
    let (glaze, band, dots) = (any_hue(rng, 0.5, 0.75), any_hue(rng, 0.15, 0.95), any_hue(rng, 0.85, 0.6));
    let seed: u32 = rng.random();
    let count = rng.random_range(7..12) as f32;
    let mut b = Builder::new();
    let outside = b.material(painted("mug glaze", (1024, 512), |u, v| {
        let speckle = noise::smooth(u * 180.0, v * 90.0, 180, seed);
        let base = scaled(mix(glaze, [1.0; 3], 0.25 * noise::fractal(u * 8.0, v * 4.0, 8, seed + 1)), 0.9);
        let base = if speckle > 0.86 { scaled(base, 0.55) } else { base };
        let wave = 0.03 * (u * TAU * count).sin();
        if !(0.3..0.78).contains(&(v + wave)) {
            return base;
        }
        let (du, dv) = ((u * count).fract() - 0.5, (v - 0.54) * 0.42 * count);
        let from_middle = (du * du + dv * dv).sqrt();
        let angle = dv.atan2(du);
        let petal = 0.22 + 0.12 * (angle * 5.0 + (u * count).floor()).cos();
        if from_middle < 0.09 {
            [0.95, 0.78, 0.2]
        } else if from_middle < petal {
            mix(dots, band, from_middle * 1.2)
        } else {
            scaled(band, 0.94 + 0.06 * speckle)
        }
    }));
    let inside = b.material(painted("mug inside", (256, 256), |u, v| {
        scaled([0.93, 0.9, 0.82], 0.85 + 0.15 * noise::fractal(u * 6.0, v * 6.0, 6, seed + 2))
    }));
    let handle = b.material(painted("mug handle", (128, 256), |u, v| {
        let ring = (v * 14.0).fract() < 0.3;
        scaled(if ring { band } else { glaze }, 0.8 + 0.2 * noise::smooth(u * 20.0, v * 40.0, 20, seed + 3))
    }));
    let wall = rounded(&[
        [0.0385, 0.0955],
        [0.0405, 0.0960],
        [0.0412, 0.0940],
        [0.0415, 0.05],
        [0.0410, 0.012],
        [0.0370, 0.0],
        [0.032, 0.0],
    ]);
    b.lathe(96, &wall, WHOLE, outside);
    b.lathe(48, &[[0.032, 0.0], [0.03, 0.003], [0.0, 0.003]], WHOLE, inside);
    b.lathe(
        64,
        &rounded(&[[0.0, 0.006], [0.03, 0.006], [0.037, 0.012], [0.0375, 0.05], [0.0385, 0.0955]]),
        WHOLE,
        inside,
    );
    b.tube(
        (20, 40),
        handle,
        |t| {
            let angle = (t - 0.5) * 3.6;
            [0.036 + 0.034 * angle.cos(), 0.0, 0.05 + 0.031 * angle.sin()]
        },
        |t| 0.0052 + 0.0018 * (2.0 * t - 1.0).powi(2),
    );
    b.finish()
}

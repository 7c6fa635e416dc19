//! A bottle with a printed label and a cap.

use rand::Rng;
use rand_chacha::ChaCha8Rng;

use super::build::{Builder, WHOLE, rounded};
use super::noise;
use super::paint::{any_hue, bars, mix, painted, print, scaled};
use crate::render::Mesh;

pub(super) fn make(rng: &mut ChaCha8Rng) -> Mesh {
    let (body, paper, ink) = (any_hue(rng, 0.55, 0.55), any_hue(rng, 0.12, 0.95), any_hue(rng, 0.9, 0.45));
    let seed: u32 = rng.random();
    let slim: f32 = rng.random_range(0.85..1.15);
    let mut b = Builder::new();
    let glass = b.material(painted("bottle body", (512, 1024), |u, v| {
        let drip = noise::fractal(u * 10.0, v * 3.0, 10, seed);
        scaled(mix(body, [0.9, 0.95, 0.9], 0.5 * (drip - 0.4)), 0.75 + 0.4 * (1.0 - v))
    }));
    let label = b.material(painted("bottle label", (1024, 512), |u, v| {
        if !(0.04..0.96).contains(&v) || ((0.1..0.13).contains(&v) || (0.87..0.9).contains(&v)) {
            return ink;
        }
        let worn = 0.9 + 0.1 * noise::fractal(u * 20.0, v * 10.0, 20, seed + 2);
        let (du, dv) = (((u + 0.25) * 2.0).fract() - 0.5, (v - 0.42) * 0.6);
        let r = (du * du + dv * dv).sqrt();
        let ray = (dv.atan2(du) * 8.0).cos();
        if r < 0.07 {
            scaled([0.9, 0.25, 0.15], worn)
        } else if r < 0.13 && ray > 0.0 {
            scaled([0.95, 0.7, 0.15], worn)
        } else if (0.7..0.85).contains(&v) && du.abs() < 0.35 {
            scaled(if print(u * 60.0, v * 26.0, seed) { ink } else { paper }, worn)
        } else if du.abs() > 0.38 && (0.25..0.6).contains(&v) {
            scaled(if bars(u * 5.0, seed + 1) { [0.08; 3] } else { [0.97; 3] }, worn)
        } else if (0.17..0.25).contains(&v) && du.abs() < 0.3 {
            scaled(if print(u * 28.0, (v - 0.17) * 12.4, seed + 5) { ink } else { paper }, worn)
        } else {
            scaled(mix(paper, ink, 0.25 * (noise::smooth(u * 12.0, v * 6.0, 12, seed) - 0.3)), worn)
        }
    }));
    let cap = b.material(painted("bottle cap", (512, 64), |u, v| {
        let ridge = (u * 48.0).fract() < 0.5 && v > 0.45;
        scaled(ink, if ridge { 0.7 } else { 1.1 } + 0.15 * noise::smooth(u * 30.0, v * 6.0, 30, seed + 3))
    }));
    let r = |v: f32| v * slim;
    let shape = rounded(&[
        [0.013, 0.235],
        [0.013, 0.205],
        [r(0.016), 0.185],
        [r(0.034), 0.155],
        [r(0.036), 0.13],
        [r(0.036), 0.012],
        [r(0.033), 0.0],
        [r(0.024), 0.0],
        [0.0, 0.006],
    ]);
    b.lathe(80, &shape, WHOLE, glass);
    b.lathe(96, &[[r(0.0364), 0.122], [r(0.0364), 0.07], [r(0.0364), 0.022]], WHOLE, label);
    b.lathe(
        64,
        &[[0.0, 0.246], [0.0135, 0.246], [0.0152, 0.2445], [0.0152, 0.226], [0.013, 0.226]],
        WHOLE,
        cap,
    );
    b.finish()
}

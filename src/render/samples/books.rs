//! A pile of books.

use rand::Rng;
use rand_chacha::ChaCha8Rng;

use super::build::{Builder, placed};
use super::noise;
use super::paint::{any_hue, mix, painted, print, scaled};
use crate::render::Mesh;

/// Left: cover; right: spine above page edges.
const COVER: [f32; 4] = [0.0, 0.0, 0.5, 1.0];
const SPINE: [f32; 4] = [0.5, 0.0, 1.0, 0.5];
const PAGES: [f32; 4] = [0.5, 0.5, 1.0, 1.0];

pub(super) fn make(rng: &mut ChaCha8Rng) -> Mesh {
    let mut b = Builder::new();
    let mut z = 0.0f32;
    let (mut w, mut d) = (0.15f32, 0.105f32);
    for i in 0..5u32 {
        let (cloth, ink, seed) = (any_hue(rng, 0.65, 0.6), any_hue(rng, 0.3, 0.95), rng.random::<u32>());
        let book = b.material(painted("book", (1024, 512), |u, v| {
            let weave = 0.88 + 0.12 * noise::smooth(u * 300.0, v * 150.0, 4096, seed);
            if u < 0.5 {
                let (x, y) = (u * 2.0, v);
                let frame = x.min(1.0 - x).min(y).min(1.0 - y);
                let star =
                    (x - 0.5).hypot(y - 0.62) * (4.0 + ((y - 0.62).atan2(x - 0.5) * (5 + i) as f32).cos());
                let title =
                    (0.14..0.36).contains(&y) && (0.12..0.88).contains(&x) && print(x * 12.0, y * 9.0, seed);
                let drawn = title || (0.04..0.055).contains(&frame) || (0.55..0.95).contains(&star);
                scaled(if drawn { ink } else { cloth }, weave)
            } else if v < 0.5 {
                let (x, y) = ((u - 0.5) * 2.0, v * 2.0);
                let band = (x - 0.08).abs() < 0.015 || (x - 0.92).abs() < 0.015;
                let title = (0.15..0.85).contains(&x)
                    && print(x * 22.0, y * 1.6 - 0.3, seed + 1)
                    && (0.2..0.8).contains(&y);
                scaled(if band || title { ink } else { cloth }, weave)
            } else {
                let y = (v - 0.5) * 2.0;
                if !(0.08..0.92).contains(&y) {
                    return scaled(cloth, weave);
                }
                scaled([0.93, 0.89, 0.78], 0.7 + 0.35 * noise::smooth(u * 8.0, v * 160.0, 64, seed + 2))
            }
        }));
        let thick = rng.random_range(0.014..0.03);
        b.at = placed(
            rng.random_range(-0.008..0.008),
            rng.random_range(-0.006..0.006),
            z,
            rng.random_range(-0.4..0.4),
        );
        b.cuboid(
            [-w / 2.0, -d / 2.0, 0.0],
            [w / 2.0, d / 2.0, thick],
            [SPINE, PAGES, PAGES, PAGES, COVER, COVER],
            book,
        );
        z += thick;
        w *= rng.random_range(0.86..0.97);
        d *= rng.random_range(0.86..0.97);
    }
    b.at = placed(0.0, 0.0, 0.0, 0.0);
    let shade = |c: [f32; 3]| mix(c, [0.1; 3], 0.2);
    let pencil = b.material(painted("pencil", (64, 512), |u, v| {
        if v < 0.08 {
            [0.2; 3]
        } else if v < 0.16 {
            [0.85, 0.7, 0.5]
        } else if v > 0.93 {
            [0.9, 0.5, 0.5]
        } else if (u * 6.0).fract() < 0.5 {
            [0.95, 0.75, 0.1]
        } else {
            shade([0.95, 0.75, 0.1])
        }
    }));
    b.tube(
        (12, 24),
        pencil,
        |t| [-0.045 + 0.09 * t, 0.01 - 0.02 * t, z + 0.0036],
        |t| 0.0036 * (t / 0.12).clamp(0.02, 1.0),
    );
    b.finish()
}

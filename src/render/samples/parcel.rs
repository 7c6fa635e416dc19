//! A printed cardboard box with tape.

use rand::Rng;
use rand_chacha::ChaCha8Rng;

use super::build::Builder;
use super::noise;
use super::paint::{any_hue, bars, mix, painted, print, scaled};
use crate::render::Mesh;

/// The texture holds the six faces in two rows of three.
fn part(i: usize) -> [f32; 4] {
    let (x, y) = ((i % 3) as f32 / 3.0, (i / 3) as f32 / 2.0);
    [x, y, x + 1.0 / 3.0, y + 0.5]
}

pub(super) fn make(rng: &mut ChaCha8Rng) -> Mesh {
    let (first, second) = (any_hue(rng, 0.75, 0.65), any_hue(rng, 0.6, 0.9));
    let seed: u32 = rng.random();
    let [w, d, h]: [f32; 3] =
        [rng.random_range(0.07..0.1), rng.random_range(0.045..0.07), rng.random_range(0.1..0.14)];
    let mut b = Builder::new();
    let board = b.material(painted("printed board", (1536, 1024), |u, v| {
        let face = (u * 3.0) as usize + 3 * (v * 2.0) as usize;
        let (x, y) = ((u * 3.0).fract(), (v * 2.0).fract());
        let fibre = 0.86 + 0.2 * noise::fractal(u * 40.0, v * 30.0, 64, seed);
        let board = scaled([0.72, 0.56, 0.38], fibre);
        let c = match face {
            // Front and back: a picture of hills under a sun, and a title.
            0 | 2 => {
                let hills = 0.62 + 0.2 * noise::fractal(x * 3.0 + face as f32 * 7.0, 0.0, 64, seed + 1);
                let sun = ((x - 0.68).powi(2) + (y - 0.36).powi(2)).sqrt();
                if y < 0.2 {
                    if print(x * 9.0, y * 5.0, seed + face as u32) { [0.98; 3] } else { first }
                } else if y > hills {
                    mix(
                        second,
                        scaled(second, 0.35),
                        (y - hills) * 3.0 * noise::smooth(x * 30.0, y * 30.0, 64, seed),
                    )
                } else if sun < 0.12 {
                    [1.0, 0.86, 0.3]
                } else {
                    mix([0.55, 0.78, 0.95], [0.98, 0.88, 0.75], y * 1.4)
                }
            }
            // Right and left: small print, a table and a bar code.
            1 | 3 => {
                if y > 0.8 && (0.2..0.8).contains(&x) {
                    if bars((x - 0.2) / 0.6, seed + 2) && y < 0.95 { [0.05; 3] } else { [0.97; 3] }
                } else if y < 0.12 {
                    first
                } else if print(x * 24.0, y * 30.0, seed + 3 + face as u32) && (0.08..0.92).contains(&x) {
                    [0.12, 0.1, 0.1]
                } else {
                    mix([0.96, 0.94, 0.88], second, f32::from((y * 8.0).fract() < 0.12))
                }
            }
            // Top and bottom: bare board with tape along the flaps.
            _ => {
                let tape = (y - 0.5).abs() < 0.16;
                let flap = (y - 0.5).abs() < 0.006;
                let c = if tape { mix(board, [0.85, 0.75, 0.5], 0.6) } else { board };
                let stamp = print(x * 10.0, y * 9.0, seed + 8) && (0.1..0.27).contains(&y);
                if flap {
                    scaled(c, 0.4)
                } else if stamp {
                    first
                } else {
                    c
                }
            }
        };
        let edge = x.min(1.0 - x).min(y.min(1.0 - y));
        mix(board, scaled(c, fibre.max(0.9)), edge * 60.0)
    }));
    let (x, y) = (w / 2.0, d / 2.0);
    b.cuboid([-x, -y, 0.0], [x, y, h], [part(0), part(1), part(2), part(3), part(4), part(5)], board);
    b.finish()
}

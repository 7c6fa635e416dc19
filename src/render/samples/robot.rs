//! A toy robot.

use std::f32::consts::TAU;

use nalgebra::Isometry3;
use rand::Rng;
use rand_chacha::ChaCha8Rng;

use super::build::{Builder, WHOLE, placed};
use super::noise;
use super::paint::{any_hue, bars, mix, painted, print, scaled};
use crate::render::Mesh;

pub(super) fn make(rng: &mut ChaCha8Rng) -> Mesh {
    let seed: u32 = rng.random();
    let (tin, accent) = (any_hue(rng, 0.55, 0.7), any_hue(rng, 0.8, 0.9));
    let mut b = Builder::new();
    let plain = |u: f32, v: f32| {
        let rust = noise::fractal(u * 7.0, v * 7.0, 64, seed);
        let seam = [u, v].iter().any(|c| ((c * 4.0).fract() - 0.5).abs() > 0.485);
        let rivet = ((u * 8.0).fract() - 0.5).hypot((v * 8.0).fract() - 0.5) < 0.09;
        let c = mix(tin, [0.45, 0.25, 0.13], (rust - 0.58) * 5.0);
        if rivet {
            mix(c, [0.9; 3], 0.6)
        } else if seam {
            scaled(c, 0.5)
        } else {
            c
        }
    };
    let sheet = b.material(painted("tin", (512, 512), plain));
    let chest = b.material(painted("chest", (512, 512), |u, v| {
        let gauge = (u - 0.3).hypot(v - 0.35);
        let needle = ((v - 0.35) - (u - 0.3) * -1.6).abs() < 0.014 && gauge < 0.13 && v < 0.36;
        if gauge < 0.17 {
            if needle {
                [0.8, 0.1, 0.1]
            } else if gauge > 0.15 {
                [0.15; 3]
            } else if gauge > 0.12 && bars(v * 0.7, seed) {
                [0.2; 3]
            } else {
                [0.95, 0.93, 0.85]
            }
        } else if (0.58..0.9).contains(&u) && (0.2..0.5).contains(&v) {
            let lamp = ((u * 12.0).fract() - 0.5).hypot((v * 12.0).fract() - 0.5) < 0.36;
            let hue = noise::cell(u * 12.0, v * 12.0, seed + 1);
            if lamp { super::paint::of_hue(hue, 0.85, 0.95) } else { [0.14, 0.15, 0.18] }
        } else if (0.62..0.88).contains(&v) && (0.12..0.88).contains(&u) {
            if print(u * 18.0, v * 16.0, seed + 2) { accent } else { [0.1, 0.12, 0.14] }
        } else {
            plain(u, v)
        }
    }));
    let face = b.material(painted("face", (512, 512), |u, v| {
        let eye = ((u - 0.5).abs() - 0.22).hypot(v - 0.38);
        if eye < 0.05 {
            [0.05; 3]
        } else if eye < 0.12 {
            mix([1.0, 0.95, 0.5], accent, (eye - 0.05) * 9.0)
        } else if eye < 0.145 {
            [0.12; 3]
        } else if (0.68..0.84).contains(&v) && (0.22..0.78).contains(&u) {
            if (u * 24.0).fract() < 0.4 || ((v - 0.76).abs() < 0.012) { [0.1; 3] } else { [0.85; 3] }
        } else {
            plain(u * 0.7, v * 0.7)
        }
    }));
    let rubber = b.material(painted("hose", (128, 512), |u, v| {
        scaled(
            if (v * 18.0).fract() < 0.5 { accent } else { [0.16, 0.16, 0.17] },
            0.8 + 0.3 * noise::smooth(u * 12.0, v * 60.0, 12, seed),
        )
    }));
    let all = |front| [front, WHOLE, WHOLE, WHOLE, WHOLE, WHOLE];
    for side in [-1.0f32, 1.0] {
        b.cuboid([side * 0.02 - 0.014, -0.026, 0.0], [side * 0.02 + 0.014, 0.016, 0.012], all(WHOLE), sheet);
        b.tube((20, 10), rubber, |t| [side * 0.02, -0.002, 0.012 + 0.032 * t], |_| 0.0085);
        b.tube(
            (18, 24),
            rubber,
            |t| [side * (0.033 + 0.022 * (t * TAU / 3.2).sin()), -0.03 * t * t, 0.088 - 0.05 * t],
            |_| 0.0065,
        );
        b.ball([side * 0.0535, -0.03, 0.036], 0.0105, 14, sheet);
        b.tube((14, 4), rubber, |t| [side * (0.028 + 0.008 * t), 0.0, 0.13], |t| 0.009 - 0.004 * t);
    }
    let body = |b: &mut Builder, low, high, front: u32| {
        b.cuboid(low, high, all(WHOLE), sheet);
        // The printed front lies a hair before the sheet metal.
        let [x0, y0, z0]: [f32; 3] = low;
        let [x1, _, z1]: [f32; 3] = high;
        let (w, h) = (x1 - x0 - 0.002, z1 - z0 - 0.002);
        b.grid((4, 4), WHOLE, front, |i, j| {
            [x0 + 0.001 + w * i as f32 / 4.0, y0 - 0.0006, z1 - 0.001 - h * j as f32 / 4.0]
        });
    };
    body(&mut b, [-0.036, -0.022, 0.044], [0.036, 0.022, 0.1], chest);
    b.tube((20, 4), rubber, |t| [0.0, 0.0, 0.1 + 0.008 * t], |_| 0.012);
    body(&mut b, [-0.028, -0.021, 0.108], [0.028, 0.021, 0.152], face);
    b.at = placed(0.006, 0.002, 0.152, 0.3);
    b.lean(-0.15);
    b.tube((10, 10), rubber, |t| [0.0, 0.0, 0.028 * t], |_| 0.0014);
    b.ball([0.0, 0.0, 0.031], 0.005, 10, chest);
    b.at = Isometry3::identity();
    b.finish()
}

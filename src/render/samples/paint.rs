//! Procedural textures.

use std::sync::Arc;

use image::{Rgba, RgbaImage};
use rand::Rng;
use rand_chacha::ChaCha8Rng;

use super::noise;
use crate::render::Material;

/// sRGB, 0 to 1.
pub(super) type Color = [f32; 3];

/// A material whose texture is `color(u, v)` at each texel; v runs down.
pub(super) fn painted(
    name: &str,
    (width, height): (u32, u32),
    color: impl Fn(f32, f32) -> Color,
) -> Material {
    painted_with_holes(name, (width, height), |u, v| Some(color(u, v)))
}

/// As [`painted`]; `None` is a hole.
pub(super) fn painted_with_holes(
    name: &str,
    (width, height): (u32, u32),
    color: impl Fn(f32, f32) -> Option<Color>,
) -> Material {
    let image = RgbaImage::from_fn(width, height, |x, y| {
        let uv = ((x as f32 + 0.5) / width as f32, (y as f32 + 0.5) / height as f32);
        let byte = |v: f32| (v.clamp(0.0, 1.0) * 255.0 + 0.5) as u8;
        match color(uv.0, uv.1) {
            Some([r, g, b]) => Rgba([byte(r), byte(g), byte(b), 255]),
            None => Rgba([0, 0, 0, 0]),
        }
    });
    Material { name: name.to_owned(), color: [1.0; 3], texture: Some(Arc::new(image)), ..Material::default() }
}

pub(super) fn mix(a: Color, b: Color, t: f32) -> Color {
    let t = t.clamp(0.0, 1.0);
    std::array::from_fn(|k| a[k] + (b[k] - a[k]) * t)
}

pub(super) fn scaled(c: Color, s: f32) -> Color {
    c.map(|v| v * s)
}

/// A colour of the given saturation and value and any hue.
pub(super) fn any_hue(rng: &mut ChaCha8Rng, saturation: f32, value: f32) -> Color {
    of_hue(rng.random_range(0.0..1.0), saturation, value)
}

/// A colour by hue (0 to 1, repeating), saturation and value.
pub(super) fn of_hue(hue: f32, saturation: f32, value: f32) -> Color {
    let channel = |n: f32| {
        let k = (n + hue * 6.0).rem_euclid(6.0);
        value * (1.0 - saturation * k.min(4.0 - k).clamp(0.0, 1.0))
    };
    [channel(5.0), channel(3.0), channel(1.0)]
}

/// Wood: rings stretched along v.
pub(super) fn wood(u: f32, v: f32, seed: u32) -> Color {
    let warp = noise::fractal(u * 6.0, v * 2.0, 64, seed);
    let ring = ((u * 9.0 + warp * 3.0) * std::f32::consts::TAU).sin() * 0.5 + 0.5;
    let grain = noise::smooth(u * 160.0, v * 6.0, 4096, seed + 9);
    scaled(mix([0.47, 0.29, 0.15], [0.76, 0.55, 0.33], ring * 0.7 + warp * 0.3), 0.8 + 0.25 * grain)
}

/// Lines of something that looks like print: true where there is ink. `u` and `v` count letters and lines.
pub(super) fn print(u: f32, v: f32, seed: u32) -> bool {
    let (line, letter) = (v.floor(), u.floor());
    if noise::cell(letter, line, seed) < 0.16 {
        return false; // a space between words
    }
    let (x, y) = ((u - letter) * 4.0, (v - line) * 8.0);
    if x >= 3.0 || !(1.0..6.0).contains(&y) {
        return false;
    }
    noise::cell(letter * 3.0 + x.floor(), line * 5.0 + y.floor(), seed + 1) < 0.58
}

/// A bar code; `u` 0 to 1 across it.
pub(super) fn bars(u: f32, seed: u32) -> bool {
    noise::cell(u * 60.0, 0.0, seed) < 0.5
}

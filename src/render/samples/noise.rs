//! Value noise for textures.

/// A pseudo-random number in 0..1 for a lattice point.
fn lattice(x: i32, y: i32, seed: u32) -> f32 {
    let mut h = (x as u32).wrapping_mul(0x9e37_79b1)
        ^ (y as u32).wrapping_mul(0x85eb_ca77)
        ^ seed.wrapping_mul(0xc2b2_ae3d);
    h = (h ^ (h >> 15)).wrapping_mul(0x2c1b_3c6d);
    h = (h ^ (h >> 12)).wrapping_mul(0x297a_2d39);
    ((h ^ (h >> 15)) >> 8) as f32 / (1 << 24) as f32
}

/// Smooth noise in 0..1 with features of size 1, repeating after `period` in x.
pub(super) fn smooth(x: f32, y: f32, period: i32, seed: u32) -> f32 {
    let (ix, iy) = (x.floor(), y.floor());
    let ease = |t: f32| t * t * (3.0 - 2.0 * t);
    let (fx, fy) = (ease(x - ix), ease(y - iy));
    let at = |dx: i32, dy: i32| lattice((ix as i32 + dx).rem_euclid(period.max(1)), iy as i32 + dy, seed);
    let mix = |a: f32, b: f32, t: f32| a + (b - a) * t;
    mix(mix(at(0, 0), at(1, 0), fx), mix(at(0, 1), at(1, 1), fx), fy)
}

/// Five octaves of [`smooth`], mean one half, repeating after `period` in x.
pub(super) fn fractal(x: f32, y: f32, period: i32, seed: u32) -> f32 {
    let (mut sum, mut scale, mut amplitude) = (0.0, 1, 0.5);
    for octave in 0..5 {
        let s = scale as f32;
        sum += amplitude * smooth(x * s, y * s, period * scale, seed + octave);
        scale *= 2;
        amplitude *= 0.5;
    }
    sum / 0.968_75
}

/// White noise of a cell, 0..1.
pub(super) fn cell(x: f32, y: f32, seed: u32) -> f32 {
    lattice(x.floor() as i32, y.floor() as i32, seed)
}

//! What looks like writing.

use super::noise::{hash, unit};

/// Ink at a place of a page whose letters and lines have size 1: invented letters of strokes, words and gaps,
/// lines of different length of up to `letters`.
pub(super) fn writing(u: f32, v: f32, letters: f32, seed: u32) -> bool {
    let (line, letter) = (v.floor(), u.floor());
    let (row, column) = (line as i32, letter as i32);
    let length = letters * (0.55 + 0.45 * unit(row, -7, seed));
    if u < 0.0 || letter >= length.max(3.0) || unit(column, row, seed) < 0.15 {
        return false;
    }
    letter_ink((u - letter) / 0.8, (v - line - 0.12) / 0.68, hash(column, row, seed ^ 0x1a2b))
}

/// Ink of one letter in its box of 1 by 1.
pub(super) fn letter_ink(x: f32, y: f32, shape: u32) -> bool {
    const WIDTH: f32 = 0.17;
    if !(0.0..1.0).contains(&x) || !(0.0..1.0).contains(&y) {
        return false;
    }
    let has = |bit: u32| shape >> bit & 1 == 1;
    let upright = |at: f32| (x - at).abs() < WIDTH * 0.6;
    let level = |at: f32| (y - at).abs() < WIDTH * 0.5;
    let (upper, lower) = (y < 0.55, y > 0.45);
    let slope = |from: f32, to: f32| (x - (from + (to - from) * y)).abs() < WIDTH * 0.7;
    // Most letters stand on a stem at the left.
    (upright(0.1) && !(has(0) && has(1)))
        || (upright(0.9) && ((has(2) && upper) || (has(3) && lower)))
        || (level(0.09) && has(4))
        || (level(0.5) && has(5))
        || (level(0.91) && has(6))
        || (has(7) && has(8) && slope(0.1, 0.9))
        || (has(9) && has(10) && !has(2) && slope(0.9, 0.1))
        || (has(11) && has(12) && upright(0.5))
}

/// Ink of a bar code, `u` 0 to 1 across it.
pub(super) fn bars(u: f32, seed: u32) -> bool {
    unit((u * 60.0).floor() as i32, 0, seed) < 0.5
}

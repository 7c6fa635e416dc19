//! A pattern at random, as plain or as fine as asked for.

use super::Painter;
use super::color::{mix, scaled};
use super::material::wood;
use super::noise::{fractal, smooth};
use super::palette::Palette;
use super::patches::{figures, maze, mosaic, tiles};
use super::printed::page;
use super::woven::{knitted, veined, woven};
use crate::objects::dice::Dice;
use crate::objects::exact::wave;

/// How often a feature of `feature` metres fits on each side: patterns repeat without a seam.
fn counts(size_m: [f64; 2], feature: f64) -> [i32; 2] {
    size_m.map(|s| ((s / feature).round() as i32).clamp(1, 160))
}

/// One colour, perhaps with a shade of noise, or a pattern: the likelier the nearer `detail` (0 to 1) is to 1.
pub(in crate::objects) fn plain_or_pattern(
    dice: &mut Dice,
    size_m: [f64; 2],
    palette: &Palette,
    detail: f64,
) -> Painter {
    if dice.chance(detail) {
        pattern(dice, size_m, palette, detail)
    } else {
        nearly_plain(dice, size_m, palette, detail)
    }
}

/// The palette's main colour, perhaps with clouds, grain or a fade.
pub(in crate::objects) fn nearly_plain(
    dice: &mut Dice,
    size_m: [f64; 2],
    palette: &Palette,
    detail: f64,
) -> Painter {
    let seed = dice.seed();
    let count = counts(size_m, dice.log_range(0.006, 0.04));
    let fine = counts(size_m, dice.log_range(0.0008, 0.002));
    let cloud = dice.range(0.0, 0.25) as f32;
    let grain = if dice.chance(detail) { dice.range(0.05, 0.35) as f32 } else { 0.0 };
    let (a, b) = (palette.main, palette.second);
    let fade = if dice.chance(0.3) { dice.range(0.3, 1.0) as f32 } else { 0.0 };
    Box::new(move |u, v| {
        let clouds = fractal(u * count[0] as f32, v * count[1] as f32, count, 4, seed) - 0.5;
        let speck = smooth(u * fine[0] as f32, v * fine[1] as f32, fine, seed + 8) - 0.5;
        scaled(mix(a, b, fade * v), 1.0 + cloud * clouds + grain * speck)
    })
}

/// A pattern over a surface of `size_m` (width along u, height along v, metres) that meets itself at the texture's
/// edges; features get finer as `detail` goes from 0 to 1.
pub(in crate::objects) fn pattern(
    dice: &mut Dice,
    size_m: [f64; 2],
    palette: &Palette,
    detail: f64,
) -> Painter {
    let feature = dice.log_range(0.004, 0.016) * (3.0 - 2.4 * detail);
    let count = counts(size_m, feature);
    let seed = dice.seed();
    let turned = palette.turned(dice.int(0, 4));
    let [a, b, c, light, dark] = turned.all();
    let ground = dice.pick(&[palette.main, palette.light, a]);
    match dice.int(0, 15) {
        0 | 1 => stripes(dice, count, &turned),
        2 => checks(dice, count, &turned),
        3 | 4 => {
            let jitter = dice.pick(&[0.0, 0.0, 0.3, 0.6]);
            figures(count, dice.int(0, 6), jitter, ground, [b, c, dark], seed)
        }
        5 => figures(count, dice.pick(&[2, 2, 6, 3]), 0.7, ground, [b, c, light], seed),
        6 => mosaic(count, [a, b, c, light, dark], dice.pick(&[0.0, 0.06, 0.12]), seed),
        7 => {
            let wide = [(count[0] / 2).max(1), count[1]];
            tiles(wide, dice.chance(0.7), [a, b, c], dice.pick(&[light, dark]), dice.unit() as f32, seed)
        }
        8 => maze(count, a, b, dice.chance(0.5), seed),
        9 => veined(counts(size_m, feature * 4.0), [a, light, dark], dice.range(0.5, 4.0) as f32, seed),
        10 => woven(counts(size_m, feature * 0.35), [a, b], dice.range(0.0, 0.6) as f32, seed),
        11 => knitted(counts(size_m, feature * 0.4), [a, b, light], dice.int(4, 12) as i32, seed),
        12 => wood(dice, size_m),
        13 => camouflage(counts(size_m, feature * 2.5), &turned, seed),
        14 => page(dice, size_m, ground, [dark, c]),
        _ => zigzag(dice, count, &turned),
    }
}

fn stripes(dice: &mut Dice, count: [i32; 2], palette: &Palette) -> Painter {
    let [a, b, c, light, _] = palette.all();
    // Whole numbers of stripes along both sides: they meet at the edges at any slant.
    let (across, down) = match dice.int(0, 3) {
        0 => (count[0], 0),
        1 => (0, count[1]),
        _ => (count[0], if dice.chance(0.5) { count[1] } else { -count[1] }),
    };
    let (across, down) = (across as f32 * 0.5, down as f32 * 0.5);
    let (across, down) = (across.round().max(if down == 0.0 { 1.0 } else { 0.0 }), down.round());
    let width = dice.range(0.2, 0.75) as f32;
    let (thin, soft) = (dice.chance(0.4), dice.chance(0.15));
    Box::new(move |u, v| {
        let t = (u * across + v * down).rem_euclid(1.0);
        if soft {
            return mix(a, b, 0.5 + 0.5 * wave(t));
        }
        if t < width {
            a
        } else if thin && (t - 0.5 * (1.0 + width)).abs() < 0.06 {
            c
        } else if thin {
            light
        } else {
            b
        }
    })
}

fn checks(dice: &mut Dice, count: [i32; 2], palette: &Palette) -> Painter {
    let [a, b, c, light, dark] = palette.all();
    let even = count.map(|n| ((n + 1) / 2).max(1) as f32);
    let (kind, line) = (dice.int(0, 2), dice.range(0.04, 0.12) as f32);
    Box::new(move |u, v| {
        let (x, y) = ((u * even[0]).rem_euclid(1.0), (v * even[1]).rem_euclid(1.0));
        match kind {
            0 => {
                if (x < 0.5) == (y < 0.5) {
                    a
                } else {
                    b
                }
            }
            // Gingham: two sets of bands, darker where they cross.
            1 => mix(light, a, 0.5 * f32::from(u8::from(x < 0.5)) + 0.5 * f32::from(u8::from(y < 0.5))),
            _ => {
                // Tartan.
                let band = |t: f32| {
                    if t < 0.4 {
                        a
                    } else if t < 0.55 {
                        dark
                    } else {
                        b
                    }
                };
                let thread = |t: f32| (t - 0.8).abs() < line;
                if thread(x) || thread(y) { c } else { mix(band(x), band(y), 0.5) }
            }
        }
    })
}

fn zigzag(dice: &mut Dice, count: [i32; 2], palette: &Palette) -> Painter {
    let [a, b, c, ..] = palette.all();
    let rows = ((count[1] + 1) / 2).max(1) as f32;
    let columns = ((count[0] + 1) / 2).max(1) as f32;
    let (height, smooth_line, third) = (dice.range(0.2, 0.9) as f32, dice.chance(0.4), dice.chance(0.5));
    Box::new(move |u, v| {
        let x = (u * columns).rem_euclid(1.0);
        let lift = if smooth_line { 0.5 + 0.5 * wave(x) } else { (2.0 * x - 1.0).abs() };
        let t = (v * rows + height * lift).rem_euclid(1.0);
        if t < 0.4 {
            a
        } else if third && t > 0.85 {
            c
        } else {
            b
        }
    })
}

fn camouflage(count: [i32; 2], palette: &Palette, seed: u32) -> Painter {
    let [a, b, c, _, dark] = palette.all();
    Box::new(move |u, v| {
        let (x, y) = (u * count[0] as f32, v * count[1] as f32);
        let layer = |k: u32| fractal(x, y, count, 4, seed + 11 * k);
        if layer(0) > 0.56 {
            dark
        } else if layer(1) > 0.54 {
            b
        } else if layer(2) > 0.54 {
            c
        } else {
            a
        }
    })
}

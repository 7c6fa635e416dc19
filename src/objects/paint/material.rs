//! Textures of substances.

use super::Painter;
use super::color::{Color, mix, scaled};
use super::noise::{cells, fractal, smooth};
use crate::objects::dice::Dice;
use crate::objects::exact::wave;

/// Wood with the grain along v; `size_m` as everywhere width and height of what the texture covers.
pub(in crate::objects) fn wood(dice: &mut Dice, size_m: [f64; 2]) -> Painter {
    let seed = dice.seed();
    let (pale, deep): (Color, Color) = dice.pick(&[
        ([0.76, 0.55, 0.33], [0.47, 0.29, 0.15]),
        ([0.88, 0.74, 0.52], [0.68, 0.5, 0.3]),
        ([0.45, 0.27, 0.16], [0.22, 0.12, 0.07]),
        ([0.62, 0.36, 0.2], [0.36, 0.16, 0.09]),
        ([0.7, 0.66, 0.6], [0.42, 0.39, 0.35]),
    ]);
    let rings = (size_m[0] / dice.log_range(0.004, 0.03)).round().clamp(1.0, 40.0) as f32;
    let wavy = dice.range(0.5, 4.0) as f32;
    let slow = [((size_m[0] / 0.03) as i32).max(1), ((size_m[1] / 0.1) as i32).max(1)];
    let fibre = [((size_m[0] / 6e-4) as i32).clamp(8, 400), ((size_m[1] / 0.02) as i32).max(1)];
    let contrast = dice.range(0.4, 1.0) as f32;
    Box::new(move |u, v| {
        let warp = fractal(u * slow[0] as f32, v * slow[1] as f32, slow, 4, seed);
        let ring = wave(u * rings + warp * wavy) * 0.5 + 0.5;
        let grain = smooth(u * fibre[0] as f32, v * fibre[1] as f32, fibre, seed + 9);
        scaled(mix(pale, deep, contrast * (ring * 0.7 + warp * 0.3)), 0.82 + 0.25 * grain)
    })
}

/// Metal with fine lines along u.
pub(in crate::objects) fn brushed_metal(dice: &mut Dice, size_m: [f64; 2]) -> Painter {
    let seed = dice.seed();
    let tone: Color = dice.pick(&[
        [0.72, 0.73, 0.75],
        [0.5, 0.51, 0.54],
        [0.82, 0.66, 0.34],
        [0.74, 0.48, 0.34],
        [0.3, 0.31, 0.33],
    ]);
    let lines = [((size_m[0] / 0.03) as i32).max(1), ((size_m[1] / 4e-4) as i32).clamp(8, 400)];
    let cloud = size_m.map(|s| ((s / 0.02) as i32).max(1));
    let strength = dice.range(0.05, 0.35) as f32;
    Box::new(move |u, v| {
        let line = smooth(u * lines[0] as f32, v * lines[1] as f32, lines, seed);
        let spot = fractal(u * cloud[0] as f32, v * cloud[1] as f32, cloud, 4, seed + 3);
        scaled(tone, 1.0 + strength * (line - 0.5) + 0.3 * strength * (spot - 0.5))
    })
}

/// Leather or rubber: a grain of small cells.
pub(in crate::objects) fn leather(dice: &mut Dice, size_m: [f64; 2], color: Color) -> Painter {
    let seed = dice.seed();
    let grain = dice.log_range(0.0012, 0.004);
    let fine = size_m.map(|s| ((s / grain) as i32).clamp(2, 300));
    let slow = size_m.map(|s| ((s / 0.03) as i32).max(1));
    let depth = dice.range(0.1, 0.45) as f32;
    Box::new(move |u, v| {
        let cell = cells(u * fine[0] as f32, v * fine[1] as f32, fine, 0.9, seed);
        let worn = fractal(u * slow[0] as f32, v * slow[1] as f32, slow, 3, seed + 1);
        scaled(color, 1.0 - depth * (1.0 - (cell.border * 4.0).min(1.0)) + 0.2 * (worn - 0.5))
    })
}

/// Ridges along v, `count` across u, as on caps and grips.
pub(in crate::objects) fn ribbed(color: Color, count: u32, depth: f64) -> Painter {
    let (count, depth) = (count as f32, depth as f32);
    Box::new(move |u, _| scaled(color, 1.0 - depth * (0.5 + 0.5 * wave(u * count))))
}

/// Fruit's skin: patches from one colour to another, dots, streaks from pole to pole.
pub(in crate::objects) fn skin_of_fruit(dice: &mut Dice, from: Color, to: Color) -> Painter {
    let seed = dice.seed();
    let patches = [dice.int(2, 5) as i32, dice.int(1, 3) as i32];
    let streaks = [dice.int(20, 60) as i32, 2];
    let dots = [dice.int(25, 70) as i32, dice.int(14, 40) as i32];
    let (streaky, dotty) = (dice.range(0.0, 0.5) as f32, dice.range(0.0, 0.5) as f32);
    let turned = dice.range(0.0, 0.8) as f32;
    Box::new(move |u, v| {
        let patch = fractal(u * patches[0] as f32, v * patches[1] as f32, patches, 4, seed);
        let streak = smooth(u * streaks[0] as f32, v * 2.0, streaks, seed + 5);
        let dot = cells(u * dots[0] as f32, v * dots[1] as f32, dots, 0.8, seed + 6);
        let share = (patch - 0.35) * 2.0 + turned * (v - 0.5) + streaky * (streak - 0.5);
        let mark = if dot.near < 0.16 { dotty } else { 0.0 };
        mix(mix(from, to, share), [0.95, 0.9, 0.75], mark)
    })
}

//! Patterns made of one figure a cell.

use super::Painter;
use super::color::{Color, mix, scaled};
use super::glyphs::letter_ink;
use super::noise::{cells, hash, unit};
use super::palette::Palette;
use crate::objects::dice::Dice;
use crate::objects::exact::{angle_turns, wave};

/// Dots, rings, flowers, stars, hearts, letters or leaves in a jittered grid of `count` cells on a ground.
pub(super) fn figures(
    count: [i32; 2],
    figure: u32,
    jitter: f32,
    ground: Color,
    inks: [Color; 3],
    seed: u32,
) -> Painter {
    Box::new(move |u, v| {
        let cell = cells(u * count[0] as f32, v * count[1] as f32, count, jitter, seed);
        let ink = inks[(cell.id >> 3) as usize % 3];
        let size = 0.24 + 0.14 * ((cell.id >> 5 & 255) as f32 / 255.0);
        let turn = (cell.id >> 13 & 255) as f32 / 255.0;
        let [x, y] = cell.from_point;
        match inside(figure, [x / size, y / size], turn, cell.id) {
            Some(shade) => scaled(mix(ink, inks[(cell.id >> 4) as usize % 3], shade), 1.0),
            None => ground,
        }
    })
}

/// Where within a figure of radius 1: 0 outside's colour, 1 the middle's; `None` beside it.
fn inside(figure: u32, [x, y]: [f32; 2], turn: f32, id: u32) -> Option<f32> {
    let r = (x * x + y * y).sqrt();
    match figure {
        0 => (r < 0.8).then_some(0.0),
        1 => (0.45..0.95).contains(&r).then_some(0.0),
        2 => {
            let petals = (4 + id % 4) as f32;
            let reach = 0.65 + 0.33 * wave(angle_turns(y, x) * petals + turn);
            (r < reach).then_some(if r < 0.3 { 1.0 } else { 0.25 * r })
        }
        3 => {
            let tips = (5 + id % 3) as f32;
            let t = ((angle_turns(y, x) + turn) * tips).rem_euclid(1.0);
            (r < 0.4 + 0.6 * (2.0 * t - 1.0).abs()).then_some(0.0)
        }
        4 => {
            let lift = y - 0.55 * x.abs();
            let heart = x * x + (lift + 0.1) * (lift + 0.1) * 1.4;
            (heart < 0.7).then_some(0.0)
        }
        5 => letter_ink(x * 0.6 + 0.5, y * 0.6 + 0.5, id).then_some(0.0),
        _ => {
            let (s, c) = (wave(turn), wave(turn + 0.25));
            let (a, b) = (x * c - y * s, x * s + y * c);
            let half = 0.42 * (1.0 - a * a).max(0.0);
            (b.abs() < half).then_some(if b.abs() < 0.06 { 1.0 } else { 0.0 })
        }
    }
}

/// Tiles or bricks with joints; each tile of its own shade and, with `mixed`, colour.
pub(super) fn tiles(
    count: [i32; 2],
    shifted: bool,
    colors: [Color; 3],
    joint: Color,
    mixed: f32,
    seed: u32,
) -> Painter {
    // Shifted rows only meet around a full turn when there is an even number of them.
    let rows = if shifted { count[1] + count[1] % 2 } else { count[1] };
    Box::new(move |u, v| {
        let y = v * rows as f32;
        let row = y.floor() as i32;
        let x = u * count[0] as f32 + if shifted && row.rem_euclid(2) == 1 { 0.5 } else { 0.0 };
        let column = (x.floor() as i32).rem_euclid(count[0]);
        let edge = |c: f32| (c - c.floor() - 0.5).abs();
        if edge(x) > 0.46 || edge(y) > 0.44 {
            return joint;
        }
        let color = if unit(column, row, seed) < mixed {
            colors[1 + hash(column, row, seed) as usize % 2]
        } else {
            colors[0]
        };
        scaled(color, 0.85 + 0.3 * unit(column, row, seed + 5))
    })
}

/// Diagonals at random in square cells: a maze of lines.
pub(super) fn maze(count: [i32; 2], ground: Color, ink: Color, round: bool, seed: u32) -> Painter {
    Box::new(move |u, v| {
        let (x, y) = (u * count[0] as f32, v * count[1] as f32);
        let (i, j) = (x.floor(), y.floor());
        let (mut a, b) = (x - i, y - j);
        if unit((i as i32).rem_euclid(count[0]), (j as i32).rem_euclid(count[1]), seed) < 0.5 {
            a = 1.0 - a;
        }
        let line = if round {
            let arc = |x: f32, y: f32| ((x * x + y * y).sqrt() - 0.5).abs() < 0.13;
            arc(a, b) || arc(1.0 - a, 1.0 - b)
        } else {
            (a - b).abs() < 0.2 || (a + b - 1.0).abs() > 0.88
        };
        if line { ink } else { ground }
    })
}

/// Patches of colour with soft or hard borders, as camouflage, cow hide or terrazzo.
pub(super) fn mosaic(count: [i32; 2], colors: [Color; 5], gap: f32, seed: u32) -> Painter {
    Box::new(move |u, v| {
        let cell = cells(u * count[0] as f32, v * count[1] as f32, count, 1.0, seed);
        if cell.border < gap {
            colors[4]
        } else {
            scaled(colors[cell.id as usize % 4], 0.9 + 0.2 * (cell.id >> 8 & 255) as f32 / 255.0)
        }
    })
}

/// A hide of patches, as a cow's or a giraffe's.
pub(in crate::objects) fn mosaic_skin(dice: &mut Dice, size_m: [f64; 2], palette: &Palette) -> Painter {
    let patch = dice.log_range(0.006, 0.025);
    let count = size_m.map(|s| ((s / patch).round() as i32).clamp(1, 60));
    let [a, b, c, light, dark] = palette.all();
    let colors = if dice.chance(0.5) { [a, a, b, b, light] } else { [a, b, c, a, dark] };
    mosaic(count, colors, dice.pick(&[0.0, 0.08, 0.16]), dice.seed())
}

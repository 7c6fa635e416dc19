//! Constructions of building bricks, with studs.

use super::style::Style;
use crate::objects::dice::Dice;
use crate::objects::frame::v;
use crate::objects::paint::{Color, of_hue, printed};
use crate::objects::shape::{Assembly, SAME_EACH, Section};

/// Side of a stud's square and height of a brick, metres, as those of the well known ones.
const PITCH_M: f64 = 0.008;
const HEIGHT_M: f64 = 0.0096;
/// Squares on each side of what can be built on.
const SIDE: usize = 12;

pub(super) fn make(dice: &mut Dice) -> Assembly {
    let mut a = Assembly::new();
    let style = Style::draw(dice);
    let mut colors: Vec<Color> = (0..dice.int(1, 7))
        .map(|_| of_hue(dice.unit(), dice.range(0.7, 1.0), dice.range(0.5, 0.95)))
        .collect();
    colors.push([0.93, 0.93, 0.9]);
    colors.push([0.1, 0.1, 0.11]);
    let mut paints: Vec<u32> = Vec::new();
    for color in colors {
        paints.push(if dice.chance(style.detail * 0.4) {
            let painter = printed(dice, [0.016, 0.0096], &style.palette, style.detail);
            a.paint((256, 128), painter)
        } else {
            a.plain(color)
        });
    }
    let (wide, deep) = (dice.int(2, SIDE as u32) as usize, dice.int(2, SIDE as u32) as usize);
    let layers = dice.int(2, 11);
    // How much of the layer below the next one keeps, and whether it has a hollow middle.
    let (keep, hollow, by_layer) = (dice.range(0.55, 1.0), dice.chance(0.35), dice.chance(0.4));
    let mut below = [[true; SIDE]; SIDE];
    for layer in 0..layers {
        let mut taken = [[false; SIDE]; SIDE];
        let mut placed = [[false; SIDE]; SIDE];
        for y in 0..deep {
            for x in 0..wide {
                if taken[y][x] {
                    continue;
                }
                let edge = x == 0 || y == 0 || x + 1 == wide || y + 1 == deep;
                let wanted = !hollow || edge || layer == 0;
                if !below[y][x] || !wanted || !dice.chance(if layer == 0 { 0.95 } else { keep }) {
                    continue;
                }
                let (mut w, mut d) =
                    dice.pick(&[(1, 1), (2, 1), (1, 2), (2, 2), (4, 2), (2, 4), (3, 1), (4, 1), (1, 4)]);
                w = w.min(wide - x);
                d = d.min(deep - y);
                // As far as there is room.
                while (y..y + d).any(|j| (x..x + w).any(|i| taken[j][i])) {
                    if w >= d { w -= 1 } else { d -= 1 }
                }
                for j in y..y + d {
                    for i in x..x + w {
                        taken[j][i] = true;
                        placed[j][i] = true;
                    }
                }
                let paint = if by_layer { paints[layer as usize % paints.len()] } else { dice.pick(&paints) };
                let at = [x as f64 - wide as f64 / 2.0, y as f64 - deep as f64 / 2.0, f64::from(layer)];
                brick(&mut a, at, (w, d), paint);
            }
        }
        below = placed;
    }
    a
}

/// A brick of `w` by `d` studs with its low corner at a place counted in studs and layers.
fn brick(a: &mut Assembly, at: [f64; 3], (w, d): (usize, usize), paint: u32) {
    const GAP_M: f64 = 0.0001;
    let size = v(w as f64 * PITCH_M - GAP_M, d as f64 * PITCH_M - GAP_M, HEIGHT_M - GAP_M);
    let low = v(at[0] * PITCH_M, at[1] * PITCH_M, at[2] * HEIGHT_M);
    let middle = low + size * 0.5;
    let frame = a.at.moved(middle.x, middle.y, middle.z);
    a.within(frame, |a| a.rounded_box(size, 0.0003, 1, SAME_EACH, paint));
    for j in 0..d {
        for i in 0..w {
            let frame = a.at.moved(
                low.x + (i as f64 + 0.5) * PITCH_M,
                low.y + (j as f64 + 0.5) * PITCH_M,
                low.z + HEIGHT_M - GAP_M,
            );
            let stud = [[0.0, 0.0017], [0.0024, 0.0017], [0.0024, -0.0005], [0.0, -0.0005]];
            a.within(frame, |a| a.lathe(10, &[Section::new(&stud, paint)]));
        }
    }
}

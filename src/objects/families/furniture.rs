//! Model furniture: chairs, stools, tables, shelves; thin legs and open spaces.

use super::style::Style;
use crate::objects::dice::Dice;
use crate::objects::frame::{V, v};
use crate::objects::paint::wood;
use crate::objects::shape::{Assembly, SAME_EACH, circle, path_through, rounded_rectangle};

pub(super) fn make(dice: &mut Dice) -> Assembly {
    let mut a = Assembly::new();
    let style = Style::draw(dice);
    let frame = if dice.chance(0.5) {
        let painter = wood(dice, [0.05, 0.15]);
        style.worn(&mut a, dice, [0.05, 0.15], painter)
    } else {
        style.plain(&mut a, dice, [0.05, 0.15])
    };
    match dice.int(0, 4) {
        0 | 1 => chair(&mut a, dice, &style, frame),
        2 => table(&mut a, dice, &style, frame),
        3 => shelf(&mut a, dice, &style, frame),
        _ => rack(&mut a, dice, &style, frame),
    }
    a
}

/// Four or three legs from below a seat to the floor, with bars between them.
fn legs(a: &mut Assembly, dice: &mut Dice, [x, y]: [f64; 2], height: f64, paint: u32) {
    let (r, splay) = (dice.range(0.0018, 0.006), dice.range(0.85, 1.35));
    let square = dice.chance(0.4);
    let feet: Vec<(V, V)> = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]
        .map(|(sx, sy)| (v(sx * x, sy * y, height + 0.001), v(sx * x * splay, sy * y * splay, 0.0)))
        .to_vec();
    for (top, foot) in &feet {
        if square && splay < 1.1 {
            a.block(v(foot.x - r, foot.y - r, 0.0), v(foot.x + r, foot.y + r, top.z), paint);
        } else {
            let path = path_through(&[*top, (top + foot) * 0.5, *foot], 10);
            a.tube_along(&path, 12, V::x(), paint, |t| [r * (1.2 - 0.5 * t); 2]);
        }
    }
    if dice.chance(0.5) {
        let share = dice.range(0.3, 0.7);
        for k in 0..4 {
            let at = |(top, foot): &(V, V)| foot + (top - foot) * share;
            a.tube(&[at(&feet[k]), at(&feet[(k + 1) % 4])], 8, r * 0.6, paint);
        }
    }
}

fn seat(a: &mut Assembly, dice: &mut Dice, style: &Style, [x, y]: [f64; 2], z: f64, frame: u32) {
    let thick = dice.range(0.004, 0.012);
    let cover = if dice.chance(0.6) { style.turned(1).surface(a, dice, [2.0 * x, 2.0 * y]) } else { frame };
    let outline = if dice.chance(0.35) {
        circle([x * 1.48, y * 1.48], 48)
    } else {
        rounded_rectangle([x * 1.1, y * 1.1], x * dice.range(0.05, 0.5), 5)
    };
    let place = a.at.moved(0.0, 0.0, z);
    a.within(place, |a| a.extrude(&outline, thick, thick * 0.3, cover, frame));
}

fn chair(a: &mut Assembly, dice: &mut Dice, style: &Style, frame: u32) {
    let size = [dice.range(0.026, 0.036), dice.range(0.026, 0.036)];
    let height = dice.range(0.04, 0.07);
    legs(a, dice, size, height, frame);
    seat(a, dice, style, size, height, frame);
    if dice.chance(0.15) {
        return;
    }
    let (tall, lean) = (dice.range(0.04, 0.08), dice.range(0.0, 0.02));
    let [x, y] = size;
    let top = height + tall;
    for side in [1.0, -1.0] {
        a.tube(&[v(side * x, y * 0.9, height), v(side * x, y * 0.9 + lean, top)], 10, 0.0028, frame);
    }
    let slats = dice.int(1, 7);
    let cover = style.turned(1).surface(a, dice, [2.0 * x, tall]);
    match dice.int(0, 2) {
        0 => {
            for k in 0..slats {
                let t = (f64::from(k) + 0.7) / f64::from(slats);
                let (z, shift) = (height + tall * t, y * 0.9 + lean * t);
                a.tube_along(
                    &[v(-x, shift, z), v(0.0, shift + 0.003, z), v(x, shift, z)],
                    10,
                    V::z(),
                    frame,
                    |_| [0.0032, 0.0012],
                );
            }
        }
        1 => {
            for k in 0..=slats {
                let sx = x * (2.0 * f64::from(k) / f64::from(slats) - 1.0);
                a.tube(&[v(sx, y * 0.9, height), v(sx, y * 0.9 + lean, top)], 8, 0.0015, frame);
            }
            a.tube(&[v(-x, y * 0.9 + lean, top), v(x, y * 0.9 + lean, top)], 12, 0.0038, frame);
        }
        _ => {
            let place = a.at.moved(0.0, y * 0.9 + lean * 0.6, height + tall * 0.62);
            a.within(place, |a| a.rounded_box(v(2.0 * x, 0.006, tall * 0.65), 0.0028, 3, SAME_EACH, cover));
        }
    }
    if dice.chance(0.35) {
        for side in [1.0, -1.0] {
            let z = height + tall * 0.45;
            let path = path_through(
                &[
                    v(side * x, y * 0.9, z),
                    v(side * x * 1.15, 0.0, z),
                    v(side * x * 1.1, -y * 0.8, z - 0.002),
                    v(side * x, -y * 0.85, height),
                ],
                24,
            );
            a.tube(&path, 10, 0.0025, frame);
        }
    }
}

fn table(a: &mut Assembly, dice: &mut Dice, style: &Style, frame: u32) {
    let size = [dice.range(0.04, 0.08), dice.range(0.03, 0.05)];
    let height = dice.range(0.03, 0.07);
    legs(a, dice, size, height, frame);
    seat(a, dice, style, size, height, frame);
    for _ in 0..dice.int(0, 5) {
        let r = dice.range(0.004, 0.01);
        let at = v(dice.around_zero(size[0] * 0.4), dice.around_zero(size[1] * 0.4), height + 0.012);
        let paint = style.turned(dice.int(0, 4)).surface(a, dice, [r * 4.0, r * 4.0]);
        if dice.chance(0.5) {
            a.ellipsoid(at, V::repeat(r), 12, paint);
        } else {
            a.block(at - v(r, r, r), at + v(r, r, r * dice.range(0.2, 2.0)), paint);
        }
    }
}

fn shelf(a: &mut Assembly, dice: &mut Dice, style: &Style, frame: u32) {
    let (x, y, tall) = (dice.range(0.025, 0.06), dice.range(0.012, 0.025), dice.range(0.06, 0.15));
    let wall = dice.range(0.0015, 0.004);
    for side in [1.0, -1.0] {
        a.block(v(side * x - wall, -y, 0.0), v(side * x + wall, y, tall), frame);
    }
    if dice.chance(0.6) {
        let back = style.surface(a, dice, [2.0 * x, tall]);
        a.block(v(-x, y - 0.001, 0.0), v(x, y + 0.001, tall), back);
    }
    let levels = dice.int(2, 6);
    let full = dice.range(0.0, 1.0);
    let covers: Vec<u32> = (0..5).map(|k| style.turned(k).print(a, dice, [0.01, 0.03])).collect();
    for k in 0..=levels {
        let z = (tall - wall) * f64::from(k) / f64::from(levels);
        a.block(v(-x, -y, z), v(x, y * 0.98, z + wall), frame);
        if k == levels {
            break;
        }
        // Books and boxes, from the left until the board is full.
        let room = (tall - wall) / f64::from(levels) - wall * 1.5;
        let mut at = -x + wall * 1.5;
        while dice.chance(full) {
            let wide = dice.range(0.003, 0.012);
            if at + wide > x - wall * 1.5 {
                break;
            }
            let high = room * dice.range(0.5, 0.95);
            let paint = dice.pick(&covers);
            a.block(
                v(at, -y * dice.range(0.4, 0.9), z + wall * 1.02),
                v(at + wide, y * 0.9, z + wall + high),
                paint,
            );
            at += wide + 0.0004;
        }
    }
}

/// A clothes rack or ladder: rods alone.
fn rack(a: &mut Assembly, dice: &mut Dice, style: &Style, frame: u32) {
    let (x, y, tall) = (dice.range(0.03, 0.05), dice.range(0.015, 0.04), dice.range(0.08, 0.15));
    let (r, rungs) = (dice.range(0.0015, 0.0035), dice.int(2, 9));
    for (sx, sy) in [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)] {
        a.tube(&[v(sx * x, sy * y, 0.0), v(sx * x, 0.0, tall)], 10, r, frame);
    }
    for k in 0..rungs {
        let t = (f64::from(k) + 0.6) / (f64::from(rungs) + 0.4);
        for side in if dice.chance(0.8) { vec![-1.0, 1.0] } else { vec![-1.0] } {
            let z = tall * t;
            a.tube(&[v(-x, side * y * (1.0 - t), z), v(x, side * y * (1.0 - t), z)], 8, r * 0.8, frame);
        }
    }
    if dice.chance(0.6) {
        let cloth = style.turned(1).patterned(a, dice, [0.08, 0.1]);
        let (hang, wide) = (tall * dice.range(0.3, 0.7), x * dice.range(0.4, 0.9));
        let folds = f64::from(dice.int(1, 5));
        a.sheet((24, 24), cloth, |s, t| {
            let down = (2.0 * t - 1.0).abs() * hang;
            let side = if t < 0.5 { -1.0 } else { 1.0 };
            let wave = 0.003 * crate::objects::exact::sin_turns(s * folds) * (down / hang);
            v(s * wide, side * (down / hang * 0.012 + 0.002) + wave, tall + 0.003 - down)
        });
    }
}

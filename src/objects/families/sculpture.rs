//! Abstract pieces: knots, twisted columns, stones, shells with holes, stars; from convex to deeply concave.

use super::style::Style;
use crate::objects::dice::Dice;
use crate::objects::exact::{angle_turns, cos_turns, sin_turns};
use crate::objects::frame::{V, v};
use crate::objects::shape::{Assembly, Blob, Lump, Section, circle, path_through, star, superellipse};

pub(super) fn make(dice: &mut Dice) -> Assembly {
    let mut a = Assembly::new();
    let style = Style::draw(dice);
    let paint = style.surface(&mut a, dice, [0.2, 0.15]);
    let other = style.turned(1).surface(&mut a, dice, [0.1, 0.1]);
    match dice.int(0, 8) {
        0 => knot(&mut a, dice, paint),
        1 => column(&mut a, dice, paint),
        2 => stone(&mut a, dice, paint),
        3 => lattice(&mut a, dice, paint),
        4 => crystal(&mut a, dice, paint, other),
        5 => rings(&mut a, dice, paint, other),
        6 => lumps(&mut a, dice, paint, other),
        7 => tower(&mut a, dice, paint, other),
        _ => spirals(&mut a, dice, paint, other),
    }
    if dice.chance(0.5) {
        plinth(&mut a, dice, &style);
    }
    a
}

fn plinth(a: &mut Assembly, dice: &mut Dice, style: &Style) {
    let paint = style.turned(3).surface(a, dice, [0.1, 0.1]);
    let [low, high] = a.bounds();
    let r = 0.35 * (high.x - low.x).max(high.y - low.y).max(0.03);
    let tall = dice.range(0.008, 0.03);
    let (x, y) = (0.5 * (low.x + high.x), 0.5 * (low.y + high.y));
    let frame = a.at.moved(x, y, low.z - tall * 0.8);
    if dice.chance(0.5) {
        a.within(frame, |a| a.block(v(-r, -r, 0.0), v(r, r, tall), paint));
    } else {
        a.within(frame, |a| {
            a.lathe(
                48,
                &[Section::new(
                    &[[0.0, tall], [r * 0.9, tall], [r, tall * 0.8], [r, 0.0], [0.0, 0.0]],
                    paint,
                )],
            )
        });
    }
}

fn knot(a: &mut Assembly, dice: &mut Dice, paint: u32) {
    let (p, q) = dice.pick(&[(2, 3), (3, 2), (2, 5), (3, 4), (1, 4), (5, 2), (1, 0), (3, 5)]);
    let (p, q) = (f64::from(p), f64::from(q));
    let (ring, tube) = (dice.range(0.04, 0.06), dice.range(0.015, 0.03));
    let thick = dice.range(0.004, 0.012);
    let path: Vec<V> = (0..360)
        .map(|i| {
            let t = f64::from(i) / 360.0;
            let out = ring + tube * cos_turns(q * t);
            v(out * cos_turns(p * t), tube * sin_turns(q * t), out * sin_turns(p * t))
        })
        .collect();
    let flat = if dice.chance(0.4) { dice.range(0.3, 0.8) } else { 1.0 };
    a.ring_along(&path, 20, [thick, thick * flat], f64::from(dice.int(0, 6)), paint);
}

/// A column whose cross-section turns and breathes.
fn column(a: &mut Assembly, dice: &mut Dice, paint: u32) {
    let (r, tall) = (dice.range(0.02, 0.04), dice.range(0.08, 0.18));
    let outline = match dice.int(0, 3) {
        0 => star(r, r * dice.range(0.4, 0.85), dice.int(3, 9) as usize),
        1 => superellipse([r, r * dice.range(0.4, 1.0)], dice.range(0.25, 1.6), 48),
        2 => circle([r, r], dice.int(3, 8) as usize),
        _ => crate::objects::shape::gear(r, r * 0.8, dice.int(6, 16) as usize),
    };
    let twist = dice.range(-1.0, 1.0);
    let (waves, depth, taper) = (dice.range(0.5, 3.0), dice.range(0.0, 0.4), dice.range(-0.2, 0.7));
    let lean = dice.around_zero(0.02);
    let rings: Vec<Vec<V>> = (0..=80)
        .map(|k| {
            let t = 1.0 - f64::from(k) / 80.0;
            let (s, c) = (sin_turns(twist * t), cos_turns(twist * t));
            let scale = (1.0 - taper * t) * (1.0 + depth * sin_turns(waves * t));
            let shift = lean * sin_turns(t * 1.2);
            outline
                .iter()
                .map(|[x, y]| v((x * c - y * s) * scale + shift, (x * s + y * c) * scale, tall * t))
                .collect()
        })
        .collect();
    a.loft(&rings, paint, paint);
}

fn stone(a: &mut Assembly, dice: &mut Dice, paint: u32) {
    let count = dice.int(1, 4);
    let many = dice.int(4, 24);
    let waves: Vec<(V, f64, f64)> = (0..many)
        .map(|k| {
            let sharp = 1.0 + 0.3 * f64::from(k);
            let direction = v(dice.around_zero(1.0), dice.around_zero(1.0), dice.around_zero(1.0)) * sharp;
            (direction, dice.unit(), dice.range(0.05, 0.5) / (sharp * f64::from(many).sqrt()))
        })
        .collect();
    let mut z = 0.0;
    for k in 0..count {
        let size = dice.range(0.03, 0.05) * (1.0 - 0.2 * f64::from(k));
        let flat = dice.range(0.35, 1.0);
        let turn = dice.unit();
        z += size * flat;
        a.ball_like(44, paint, |p| {
            let bump: f64 =
                waves.iter().map(|(d, phase, amount)| amount * sin_turns(p.dot(d) + phase + turn)).sum();
            v(p.x, p.y, p.z * flat) * (size * (1.0 + bump)) + v(0.0, 0.0, z)
        });
        z += size * flat * 0.85;
    }
}

/// A body cut by a periodic minimal surface: holes through and through.
fn lattice(a: &mut Assembly, dice: &mut Dice, paint: u32) {
    let (size, cell) = (0.05, dice.range(0.026, 0.07));
    let thick = dice.range(0.25, 0.8);
    let (boxy, gyroid) = (dice.chance(0.5), dice.chance(0.6));
    let field = |p: V| {
        let q = p / cell;
        let wave = if gyroid {
            sin_turns(q.x) * cos_turns(q.y)
                + sin_turns(q.y) * cos_turns(q.z)
                + sin_turns(q.z) * cos_turns(q.x)
        } else {
            cos_turns(q.x) + cos_turns(q.y) + cos_turns(q.z)
        };
        let sheet = (wave.abs() - thick) * cell * 0.16;
        let body = if boxy { p.abs().max() - size } else { p.norm() - size * 1.2 };
        sheet.max(body)
    };
    let reach = size * 1.2 + 0.004;
    a.field(V::repeat(-reach), V::repeat(reach), reach * 2.0 / 33.0, 0.1, field, |_| paint);
}

fn crystal(a: &mut Assembly, dice: &mut Dice, paint: u32, other: u32) {
    for k in 0..dice.int(3, 16) {
        let (r, tall) = (dice.range(0.006, 0.018), dice.range(0.02, 0.1));
        let sides = dice.int(4, 7) as usize;
        let away = v(dice.around_zero(0.5), dice.around_zero(0.5), 1.0);
        let frame =
            a.at.along(v(dice.around_zero(0.012), dice.around_zero(0.012), 0.0), away).turned(2, dice.unit());
        let ring =
            |r: f64, z: f64| circle([r, r], sides).iter().map(|[x, y]| v(*x, *y, z)).collect::<Vec<V>>();
        let paint = if k % 3 == 0 { other } else { paint };
        a.within(frame, |a| {
            a.loft(&[ring(r * 0.15, tall), ring(r, tall - r * 1.3), ring(r * 0.8, -0.01)], paint, paint)
        });
    }
}

fn rings(a: &mut Assembly, dice: &mut Dice, paint: u32, other: u32) {
    for k in 0..dice.int(2, 7) {
        let (r, thick) = (dice.range(0.02, 0.06), dice.range(0.002, 0.007));
        let frame =
            a.at.moved(dice.around_zero(0.012), dice.around_zero(0.012), dice.around_zero(0.015))
                .turned(0, dice.unit())
                .turned(1, dice.unit());
        let path: Vec<V> =
            circle([r, r * dice.range(0.6, 1.0)], 96).iter().map(|[x, y]| v(*x, *y, 0.0)).collect();
        let paint = if k % 2 == 0 { paint } else { other };
        a.within(frame, |a| a.ring_along(&path, 14, [thick, thick * 0.7], 0.0, paint));
    }
}

fn lumps(a: &mut Assembly, dice: &mut Dice, paint: u32, other: u32) {
    let lumps: Vec<Lump> = (0..dice.int(3, 9))
        .map(|k| {
            let at =
                |dice: &mut Dice| v(dice.around_zero(0.03), dice.around_zero(0.03), dice.around_zero(0.03));
            let (from, to) = (at(dice), at(dice));
            Lump::rod(
                from,
                to,
                [dice.range(0.006, 0.022), dice.range(0.004, 0.016)],
                if k % 3 == 2 { other } else { paint },
            )
        })
        .collect();
    let holes: Vec<(V, f64)> = (0..dice.int(0, 5))
        .map(|_| {
            (
                v(dice.around_zero(0.025), dice.around_zero(0.025), dice.around_zero(0.025)),
                dice.range(0.006, 0.016),
            )
        })
        .collect();
    let blob = Blob { lumps, softness: dice.range(0.005, 0.025), tile: 0.1 };
    a.blob(&blob, 52, |p, d| holes.iter().fold(d, |d, (at, r)| d.max(r - (p - at).norm())));
}

/// Arms that wind around an axis.
fn spirals(a: &mut Assembly, dice: &mut Dice, paint: u32, other: u32) {
    let (arms, tall, turns) = (dice.int(1, 6), dice.range(0.06, 0.14), dice.range(0.3, 2.5));
    let (low, high) = (dice.range(0.015, 0.04), dice.range(0.005, 0.045));
    let thick = dice.range(0.002, 0.007);
    for k in 0..arms {
        let start = f64::from(k) / f64::from(arms);
        let knots: Vec<V> = (0..=40)
            .map(|i| {
                let t = f64::from(i) / 40.0;
                let turn = start + turns * t;
                let out = low + (high - low) * t;
                v(out * cos_turns(turn), out * sin_turns(turn), tall * t)
            })
            .collect();
        let path = path_through(&knots, 120);
        let paint = if k % 2 == 0 { paint } else { other };
        a.tube_along(&path, 12, V::x(), paint, |t| [thick * (1.2 - 0.6 * t); 2]);
    }
    if dice.chance(0.5) {
        a.ball_like(24, other, |p| {
            let wave = 1.0 + 0.05 * sin_turns(f64::from(angle_turns(p.y as f32, p.x as f32)) * 6.0);
            v(0.0, 0.0, tall * 0.5) + p * (low.min(high) * 0.7 * wave)
        });
    }
}

/// Pillows, balls and octahedra on top of each other.
fn tower(a: &mut Assembly, dice: &mut Dice, paint: u32, other: u32) {
    let mut z = 0.0;
    for k in 0..dice.int(2, 6) {
        let half = v(dice.range(0.015, 0.045), dice.range(0.015, 0.045), dice.range(0.008, 0.03));
        let squareness = dice.range(0.15, 1.9);
        let frame =
            a.at.moved(dice.around_zero(0.004), dice.around_zero(0.004), z + half.z).turned(2, dice.unit());
        a.within(frame, |a| a.superquadric(half, squareness, 32, if k % 2 == 0 { paint } else { other }));
        z += half.z * 1.85;
    }
}

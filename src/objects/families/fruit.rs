//! Fruit and vegetables.

use crate::objects::dice::Dice;
use crate::objects::exact::{angle_turns, cos_turns, exp, sin_turns};
use crate::objects::frame::{V, v};
use crate::objects::paint::{Color, of_hue, skin_of_fruit};
use crate::objects::shape::{Assembly, path_through};

pub(super) fn make(dice: &mut Dice) -> Assembly {
    let size = dice.range(0.025, 0.05);
    if dice.chance(0.75) {
        return one_fruit(dice, size);
    }
    bunch(dice, size)
}

/// One of `size` metres' radius about the origin, stem up.
pub(super) fn one_fruit(dice: &mut Dice, size: f64) -> Assembly {
    let mut a = Assembly::new();
    match dice.int(0, 8) {
        0 | 1 => apple(&mut a, dice, size),
        2 => pear(&mut a, dice, size),
        3 => banana(&mut a, dice, size),
        4 => pumpkin(&mut a, dice, size),
        5 => citrus(&mut a, dice, size),
        6 => pineapple(&mut a, dice, size),
        7 => pepper(&mut a, dice, size),
        _ => strawberry(&mut a, dice, size),
    }
    a
}

fn skin(a: &mut Assembly, dice: &mut Dice, hues: [f64; 2]) -> u32 {
    let ripe = of_hue(hues[0] + dice.around_zero(0.02), dice.range(0.6, 0.95), dice.range(0.55, 0.95));
    let green = of_hue(hues[1] + dice.around_zero(0.02), dice.range(0.5, 0.8), dice.range(0.5, 0.85));
    let painter = skin_of_fruit(dice, ripe, green);
    a.paint((768, 384), painter)
}

fn stem(a: &mut Assembly, dice: &mut Dice, from: V, length: f64, radius: f64) {
    let wood: Color = of_hue(0.1, 0.5, dice.range(0.2, 0.4));
    let wood = a.plain(wood);
    let lean = v(dice.around_zero(0.3) * length, dice.around_zero(0.3) * length, length);
    let path = path_through(&[from, from + lean * 0.5 + v(0.1 * length, 0.0, 0.0), from + lean], 10);
    a.tube_along(&path, 8, V::x(), wood, |t| [radius * (0.8 + 0.5 * t); 2]);
}

/// Turns of a point about z and its distance from the axis, for ribs.
fn around(p: V) -> (f64, f64) {
    (f64::from(angle_turns(p.y as f32, p.x as f32)), (p.x * p.x + p.y * p.y).sqrt())
}

fn apple(a: &mut Assembly, dice: &mut Dice, size: f64) {
    let hues = dice.pick(&[[0.0, 0.2], [0.98, 0.15], [0.25, 0.22], [0.05, 0.12], [0.85, 0.95]]);
    let paint = skin(a, dice, hues);
    let (dip, tall, taper) = (dice.range(0.15, 0.35), dice.range(0.8, 1.1), dice.range(0.0, 0.2));
    a.ball_like(28, paint, |p| {
        let (_, r) = around(p);
        let hollow = dip * exp(-14.0 * r * r) * if p.z > 0.0 { 1.0 } else { 0.6 };
        let wide = 1.0 + taper * p.z;
        v(p.x * wide, p.y * wide, p.z * tall * (1.0 - hollow)) * size
    });
    let length = size * dice.range(0.3, 0.6);
    stem(a, dice, v(0.0, 0.0, size * tall * (0.9 - dip)), length, size * 0.035);
    if dice.chance(0.4) {
        let leaf = a.plain(of_hue(0.28, 0.7, 0.5));
        let z = size * tall * 0.95;
        a.sheet((4, 8), leaf, |s, t| {
            v(size * 0.9 * t, s * size * 0.22 * sin_turns(0.5 * t), z + size * 0.2 * sin_turns(0.4 * t))
        });
    }
}

fn pear(a: &mut Assembly, dice: &mut Dice, size: f64) {
    let hues = dice.pick(&[[0.18, 0.25], [0.12, 0.2], [0.02, 0.22], [0.78, 0.85]]);
    let paint = skin(a, dice, hues);
    let (neck, tall) = (dice.range(0.35, 0.7), dice.range(1.2, 1.7));
    let bend = dice.around_zero(0.1);
    a.ball_like(28, paint, |p| {
        let t = 0.5 + 0.5 * p.z;
        let wide = 1.0 - (1.0 - neck) * t * t * (3.0 - 2.0 * t);
        v(p.x * wide + bend * t * t, p.y * wide, p.z * tall) * size
    });
    stem(a, dice, v(bend * size, 0.0, size * tall * 0.97), size * 0.5, size * 0.04);
}

fn banana(a: &mut Assembly, dice: &mut Dice, size: f64) {
    let paint = skin(a, dice, [0.14, 0.2]);
    let (bend, length) = (dice.range(0.12, 0.3), size * dice.range(3.0, 4.2));
    for k in 0..dice.int(1, 5) {
        let side = f64::from(k) * size * 0.5;
        let path: Vec<V> = (0..=28)
            .map(|i| {
                let t = f64::from(i) / 28.0 - 0.5;
                let r = length / (bend * std::f64::consts::TAU);
                let fan = 1.0 + 0.5 * (t + 0.5);
                v(r * sin_turns(bend * t), side * fan, r * (1.0 - cos_turns(bend * t)))
            })
            .collect();
        let thick = size * 0.42;
        a.tube_along(&path, 10, V::y(), paint, |t| {
            let ends = (t * 9.0).min((1.0 - t) * 7.0).min(1.0);
            [thick * (0.25 + 0.75 * ends); 2]
        });
    }
}

fn pumpkin(a: &mut Assembly, dice: &mut Dice, size: f64) {
    let hues = dice.pick(&[[0.07, 0.1], [0.08, 0.25], [0.3, 0.2], [0.12, 0.11]]);
    let paint = skin(a, dice, hues);
    let (ribs, depth, flat) = (f64::from(dice.int(6, 14)), dice.range(0.05, 0.2), dice.range(0.55, 0.95));
    a.ball_like(44, paint, |p| {
        let (turns, r) = around(p);
        let rib = cos_turns((turns * ribs).rem_euclid(1.0) * 0.5 - 0.25);
        let wide = 1.0 - depth * (1.0 - rib) * r;
        let dip = 1.0 - 0.3 * exp(-10.0 * r * r);
        v(p.x * wide, p.y * wide, p.z * flat * dip) * size
    });
    stem(a, dice, v(0.0, 0.0, size * flat * 0.65), size * 0.5, size * 0.1);
}

fn citrus(a: &mut Assembly, dice: &mut Dice, size: f64) {
    let hues = dice.pick(&[[0.08, 0.1], [0.15, 0.16], [0.26, 0.22], [0.03, 0.1]]);
    let paint = skin(a, dice, hues);
    let (tip, tall) = (dice.range(0.0, 0.25), dice.range(0.9, 1.2));
    a.ball_like(28, paint, |p| {
        let (_, r) = around(p);
        v(p.x, p.y, p.z * tall + tip * exp(-20.0 * r * r) * p.z) * size
    });
}

fn pineapple(a: &mut Assembly, dice: &mut Dice, size: f64) {
    let paint = skin(a, dice, [0.1, 0.2]);
    let (rows, tall) = (f64::from(dice.int(8, 13)), dice.range(1.3, 1.7));
    a.ball_like(48, paint, |p| {
        let (turns, r) = around(p);
        let z = p.z * 0.5 * rows;
        let bump = cos_turns(turns * rows + z * 0.5) * cos_turns(turns * rows - z * 0.5);
        let out = 0.8 + 0.08 * bump * r;
        v(p.x * out, p.y * out, p.z * tall) * size
    });
    let leaf = a.plain(of_hue(0.3, 0.5, 0.45));
    for i in 0..dice.int(14, 30) {
        let (t, up) = (f64::from(i) * 0.382, 0.4 + 0.02 * f64::from(i));
        let frame = a.at.moved(0.0, 0.0, size * tall * 0.92).turned(2, t).turned(1, -0.25 * up);
        a.within(frame, |a| {
            a.sheet((2, 8), leaf, |s, t| {
                v(size * 1.1 * t, s * size * 0.13 * (1.0 - t), -size * 0.4 * t * t + s.abs() * size * 0.04)
            });
        });
    }
}

fn pepper(a: &mut Assembly, dice: &mut Dice, size: f64) {
    let hues = dice.pick(&[[0.0, 0.02], [0.12, 0.15], [0.32, 0.28], [0.07, 0.3]]);
    let paint = skin(a, dice, hues);
    let (lobes, tall, taper) = (f64::from(dice.int(3, 4)), dice.range(1.0, 2.2), dice.range(0.1, 0.6));
    let twist = dice.around_zero(0.1);
    a.ball_like(36, paint, |p| {
        let (turns, r) = around(p);
        let lobe = 1.0 + 0.14 * cos_turns((turns + twist * p.z) * lobes) * r;
        let wide = lobe * (1.0 + taper * 0.5 * p.z - taper * 0.3);
        let dip = 1.0 - 0.25 * exp(-12.0 * r * r);
        v(p.x * wide, p.y * wide, p.z * tall * dip) * size
    });
    stem(a, dice, v(0.0, 0.0, size * tall * 0.7), size * 0.6, size * 0.08);
}

fn strawberry(a: &mut Assembly, dice: &mut Dice, size: f64) {
    let (columns, rows) = (dice.int(8, 18) as f32, dice.int(6, 12) as f32);
    let (red, seed): (Color, Color) = (
        of_hue(0.98 + dice.around_zero(0.02), dice.range(0.6, 0.9), dice.range(0.55, 0.9)),
        [0.95, 0.85, 0.45],
    );
    let paint = a.paint(
        (512, 256),
        Box::new(move |u, v| {
            let row = (v * rows).floor();
            let x = (u * columns + 0.5 * (row % 2.0)).rem_euclid(1.0) - 0.5;
            let y = (v * rows).rem_euclid(1.0) - 0.5;
            if x * x * 2.5 + y * y < 0.03 { seed } else { red }
        }),
    );
    let tip = dice.range(0.3, 0.7);
    a.ball_like(28, paint, |p| {
        let wide = 0.85 + tip * 0.35 * p.z;
        v(p.x * wide, p.y * wide, p.z * 1.1) * size
    });
    let leaf = a.plain(of_hue(0.3, 0.6, 0.5));
    for i in 0..dice.int(5, 9) {
        let frame = a.at.moved(0.0, 0.0, size * 1.08).turned(2, f64::from(i) * 0.382);
        a.within(frame, |a| {
            a.sheet((2, 6), leaf, |s, t| {
                v(size * 0.8 * t, s * size * 0.18 * (1.0 - t), size * (0.12 * t - 0.3 * t * t))
            })
        });
    }
    stem(a, dice, v(0.0, 0.0, size), size * 0.4, size * 0.04);
}

/// Grapes or cherries: many small ones on a stem.
fn bunch(dice: &mut Dice, size: f64) -> Assembly {
    let mut a = Assembly::new();
    let hues = dice.pick(&[[0.78, 0.82], [0.24, 0.2], [0.97, 0.0], [0.65, 0.75]]);
    let paint = skin(&mut a, dice, hues);
    let count = dice.int(20, 60);
    let r = size * dice.range(1.0, 1.25) / crate::objects::exact::power(f64::from(count), 0.36);
    for i in 0..count {
        let t = f64::from(i) / f64::from(count);
        let out = size * (1.0 - t) * 0.9 + r * 0.3;
        let turns = f64::from(i) * 0.381_966;
        let at = v(
            out * cos_turns(turns),
            out * sin_turns(turns),
            size * 2.4 * (1.0 - t) + dice.around_zero(r * 0.3),
        );
        a.ellipsoid(at, v(r, r, r * 1.1), 12, paint);
    }
    stem(&mut a, dice, v(0.0, 0.0, size * 2.2), size * 0.8, size * 0.06);
    a
}

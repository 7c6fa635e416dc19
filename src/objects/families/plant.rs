//! Plants in pots: stems, leaves of many kinds, flowers, cacti.

use super::style::Style;
use super::vessel::{CrossSection, Vessel};
use crate::objects::dice::Dice;
use crate::objects::exact::{arch, circumference, cos_turns, sin_turns};
use crate::objects::frame::{V, v};
use crate::objects::paint::{Color, Painter, fractal, mix, of_hue, scaled};
use crate::objects::shape::{Assembly, path_through};

pub(super) fn make(dice: &mut Dice) -> Assembly {
    let mut a = Assembly::new();
    let style = Style::draw(dice);
    let (r, height) = (dice.range(0.02, 0.045), dice.range(0.03, 0.075));
    let foot = r * dice.range(0.6, 1.0);
    let pot = Vessel::through(
        &[
            [r, height],
            [r * 0.98, height * 0.8],
            [0.5 * (r + foot) * dice.range(0.9, 1.25), height * 0.4],
            [foot, 0.004],
            [foot, 0.0],
        ],
        0.003,
        CrossSection::draw(dice),
    );
    let outside = style.surface(&mut a, dice, [circumference(r), height]);
    let inside = a.plain(scaled(style.palette.main, 0.6));
    pot.add(&mut a, outside, inside);
    let seed = dice.seed();
    let earth = a.paint(
        (256, 128),
        Box::new(move |u, v| {
            scaled(
                mix([0.16, 0.1, 0.06], [0.36, 0.26, 0.18], fractal(u * 60.0, v * 12.0, [60, 12], 3, seed)),
                1.0,
            )
        }),
    );
    let ground = height * 0.86;
    pot.fill(&mut a, ground, 0.003, earth);
    let before = a.at;
    a.at = before.moved(0.0, 0.0, ground);
    match dice.int(0, 7) {
        0 | 1 => bush(&mut a, dice, r),
        2 | 3 => rosette(&mut a, dice, r),
        4 => cactus(&mut a, dice, r),
        5 => grass(&mut a, dice, r),
        _ => flowers(&mut a, dice, r),
    }
    a.at = before;
    a
}

/// Green of some kind, with veins.
fn leaf_painter(dice: &mut Dice) -> Painter {
    let hue = dice.range(0.2, 0.42);
    let dark: Color = of_hue(hue, dice.range(0.4, 0.85), dice.range(0.25, 0.55));
    let rare = dice.chance(0.2);
    let bright: Color = if rare { of_hue(dice.unit(), 0.5, 0.8) } else { of_hue(hue - 0.05, 0.45, 0.75) };
    let (seed, veins, strength) = (dice.seed(), dice.range(4.0, 12.0) as f32, dice.range(0.2, 1.0) as f32);
    Box::new(move |u, v| {
        let across = (u - 0.5).abs();
        let side = ((v * veins + across * 5.0).rem_euclid(1.0) - 0.5).abs() < 0.08;
        let vein = if across < 0.025 || side { strength } else { 0.0 };
        let spots = fractal(u * 8.0, v * 16.0, [64, 64], 4, seed);
        mix(scaled(dark, 0.75 + 0.5 * spots), bright, vein + 1.4 * strength * (across - 0.33).max(0.0))
    })
}

struct LeafShape {
    length: f64,
    width: f64,
    droop: f64,
    fold: f64,
    lobes: f64,
    tip: f64,
}

impl LeafShape {
    fn draw(dice: &mut Dice, length: f64) -> Self {
        Self {
            length,
            width: length * dice.log_range(0.06, 0.4),
            droop: dice.range(-0.2, 0.9),
            fold: dice.range(-0.3, 0.5),
            lobes: if dice.chance(0.3) { f64::from(dice.int(2, 6)) } else { 0.0 },
            tip: dice.range(0.3, 0.7),
        }
    }

    /// A leaf that starts at the place's origin and grows along x, its upper side towards z.
    fn add(&self, a: &mut Assembly, paint: u32) {
        a.sheet((4, 10), paint, |s, t| {
            // Widest at `tip`, pointed at both ends.
            let outline = if t < self.tip {
                arch(0.5 * t / self.tip)
            } else {
                arch(0.5 + 0.5 * (t - self.tip) / (1.0 - self.tip))
            };
            let wave = if self.lobes > 0.0 { 0.75 + 0.25 * cos_turns(t * self.lobes) } else { 1.0 };
            let half = (self.width * outline * wave).max(self.width * 0.04);
            let bend = self.droop * 0.25 * t;
            let (x, z) = (self.length * t * cos_turns(bend * 0.5), -self.length * t * sin_turns(bend * 0.5));
            v(x, s * half, z + s.abs() * half * self.fold)
        });
    }
}

fn bush(a: &mut Assembly, dice: &mut Dice, r: f64) {
    let leaf = leaf_painter(dice);
    let leaf = a.paint((128, 256), leaf);
    let bark = a.plain(of_hue(dice.range(0.06, 0.3), dice.range(0.2, 0.6), dice.range(0.2, 0.5)));
    let shape = {
        let length = dice.range(0.015, 0.05);
        LeafShape::draw(dice, length)
    };
    let stems = dice.int(1, 5);
    let (tall, per_stem) = (dice.range(0.05, 0.16), dice.int(5, 22));
    for k in 0..stems {
        let lean = if stems == 1 { 0.1 } else { dice.range(0.1, 0.7) };
        let turns = f64::from(k) / f64::from(stems) + dice.around_zero(0.05);
        let out = tall * lean;
        let knots = [
            v(0.3 * r * cos_turns(turns), 0.3 * r * sin_turns(turns), -0.004),
            v((r * 0.3 + out * 0.2) * cos_turns(turns), (r * 0.3 + out * 0.2) * sin_turns(turns), tall * 0.5),
            v(out * cos_turns(turns + 0.03), out * sin_turns(turns + 0.03), tall * dice.range(0.8, 1.1)),
        ];
        let path = path_through(&knots, 16);
        a.tube_along(&path, 8, V::y(), bark, |t| [0.0028 - 0.0016 * t; 2]);
        for i in 0..per_stem {
            let t = 0.25 + 0.75 * f64::from(i) / f64::from(per_stem - 1).max(1.0);
            let at = path[((t * 15.0) as usize).min(15)];
            let frame =
                a.at.moved(at.x, at.y, at.z)
                    .turned(2, 0.382 * f64::from(i) + turns)
                    .turned(1, -dice.range(-0.04, 0.14));
            a.within(frame, |a| shape.add(a, leaf));
        }
    }
}

fn rosette(a: &mut Assembly, dice: &mut Dice, r: f64) {
    let leaf = leaf_painter(dice);
    let leaf = a.paint((128, 256), leaf);
    let count = dice.int(6, 34);
    let length = dice.range(0.03, 0.11);
    let shape = LeafShape::draw(dice, length);
    let flat = dice.range(0.02, 0.12);
    for i in 0..count {
        let t = f64::from(i) / f64::from(count);
        let size = 1.0 - 0.55 * t;
        let frame =
            a.at.moved(0.0, 0.0, 0.004 * t)
                .turned(2, 0.381_966 * f64::from(i))
                .moved(r * 0.15 * (1.0 - t), 0.0, 0.0)
                .turned(1, -(flat + (0.22 - flat) * t) + dice.around_zero(0.01))
                .stretched(size, size, size);
        a.within(frame, |a| shape.add(a, leaf));
    }
}

fn grass(a: &mut Assembly, dice: &mut Dice, r: f64) {
    let leaf = leaf_painter(dice);
    let leaf = a.paint((64, 256), leaf);
    let (count, tall) = (dice.int(15, 70), dice.range(0.05, 0.14));
    for _ in 0..count {
        let (turns, spread) = (dice.unit(), dice.unit());
        let shape = LeafShape {
            length: tall * dice.range(0.5, 1.0),
            width: dice.range(0.0012, 0.003),
            droop: dice.range(0.0, 1.4),
            fold: 0.3,
            lobes: 0.0,
            tip: 0.25,
        };
        let frame =
            a.at.turned(2, turns)
                .moved(r * 0.7 * spread, 0.0, -0.002)
                .turned(2, dice.around_zero(0.2))
                .turned(1, -0.25 + 0.13 * spread);
        a.within(frame, |a| shape.add(a, leaf));
    }
}

fn cactus(a: &mut Assembly, dice: &mut Dice, r: f64) {
    let ribs = f64::from(dice.int(6, 16));
    let (hue, seed) = (dice.range(0.25, 0.42), dice.seed());
    let dots = dice.int(6, 24) as f32;
    let skin = a.paint(
        (512, 256),
        Box::new(move |u, v| {
            let rib = (u * ribs as f32).rem_euclid(1.0);
            let spine = (rib - 0.5).abs() < 0.13 && ((v * dots).rem_euclid(1.0) - 0.5).abs() < 0.2;
            let green = of_hue(hue, 0.55, 0.5);
            let shade = 0.7 + 0.4 * fractal(u * 20.0, v * 20.0, [20, 20], 3, seed) - 0.3 * (rib - 0.5).abs();
            if spine { [0.92, 0.88, 0.7] } else { scaled(green, shade) }
        }),
    );
    let bodies = dice.int(1, 5);
    let mut top = V::zeros();
    for k in 0..bodies {
        let size = if k == 0 { 1.0 } else { dice.range(0.3, 0.75) };
        let (wide, tall) = (r * 0.7 * size, dice.range(0.02, 0.065) * size);
        let turns = f64::from(k) / f64::from(bodies);
        let off = if bodies == 1 { 0.0 } else { r * 0.5 };
        let (x, y) = (off * cos_turns(turns), off * sin_turns(turns));
        if k == 0 {
            top = v(x, y, tall * 1.7);
        }
        a.ball_like(24, skin, |p| {
            let flat = (p.x * p.x + p.y * p.y).sqrt();
            let turns = f64::from(crate::objects::exact::angle_turns(p.y as f32, p.x as f32));
            let rib = 1.0 + 0.1 * cos_turns((turns + 0.25) * ribs + 0.5) * flat;
            v(x + p.x * wide * rib, y + p.y * wide * rib, tall * 0.7 + p.z * tall)
        });
    }
    if dice.chance(0.5) {
        let petal = style_petal(a, dice);
        let frame = a.at.moved(top.x, top.y, top.z - 0.001);
        a.within(frame, |a| flower(a, dice, 0.012, petal));
    }
}

fn style_petal(a: &mut Assembly, dice: &mut Dice) -> u32 {
    let (hue, second) = (dice.unit(), dice.unit());
    let (inner, outer) = (of_hue(hue, 0.8, 0.9), of_hue(hue + 0.1 * second, 0.5, 0.95));
    a.paint(
        (64, 64),
        Box::new(move |u, v| scaled(mix(inner, outer, v), 0.85 + 0.3 * (1.0 - (2.0 * u - 1.0).abs()))),
    )
}

fn flower(a: &mut Assembly, dice: &mut Dice, size: f64, petal: u32) {
    let count = dice.int(5, 16);
    let shape = LeafShape {
        length: size,
        width: size * dice.range(0.15, 0.4),
        droop: dice.range(-0.4, 0.6),
        fold: 0.2,
        lobes: 0.0,
        tip: 0.65,
    };
    let open = dice.range(0.0, 0.18);
    for i in 0..count {
        let frame =
            a.at.turned(2, f64::from(i) / f64::from(count)).moved(size * 0.15, 0.0, 0.0).turned(1, -open);
        a.within(frame, |a| shape.add(a, petal));
    }
    let middle = a.plain(of_hue(dice.range(0.08, 0.16), 0.8, 0.85));
    a.ellipsoid(v(0.0, 0.0, size * 0.05), v(size * 0.3, size * 0.3, size * 0.2), 8, middle);
}

fn flowers(a: &mut Assembly, dice: &mut Dice, r: f64) {
    let green = leaf_painter(dice);
    let leaf = a.paint((128, 256), green);
    let petal = style_petal(a, dice);
    let (count, tall, size) = (dice.int(2, 9), dice.range(0.06, 0.15), dice.range(0.012, 0.03));
    let shape = LeafShape::draw(dice, tall * 0.4);
    for k in 0..count {
        let (turns, lean) = (f64::from(k) * 0.382, dice.range(0.1, 0.45));
        let top = tall * dice.range(0.7, 1.0);
        let end = v(top * lean * cos_turns(turns), top * lean * sin_turns(turns), top);
        let path = path_through(
            &[
                v(0.2 * r * cos_turns(turns), 0.2 * r * sin_turns(turns), -0.003),
                end * 0.5 + v(0.0, 0.0, top * 0.1),
                end,
            ],
            14,
        );
        a.tube(&path, 6, 0.0011, leaf);
        let frame = a.at.along(end, v(end.x, end.y, end.z * 0.7));
        a.within(frame, |a| flower(a, dice, size, petal));
        let frame = a.at.turned(2, turns + 0.1).turned(1, -dice.range(0.03, 0.2));
        a.within(frame, |a| shape.add(a, leaf));
    }
}

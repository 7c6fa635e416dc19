//! Shoes and boots: lofts over a sole.

use super::style::Style;
use crate::objects::dice::Dice;
use crate::objects::exact::{cos_turns, power, sin_turns};
use crate::objects::frame::{V, v};
use crate::objects::paint::leather;
use crate::objects::shape::{Assembly, WHOLE, path_through};

/// Points around a cross-section.
const AROUND: usize = 40;

pub(super) fn make(dice: &mut Dice) -> Assembly {
    let mut a = Assembly::new();
    let style = Style::draw(dice);
    let last = Last::draw(dice);
    let upper = if dice.chance(0.4) {
        let painter = leather(dice, [0.25, 0.12], style.palette.main);
        style.worn(&mut a, dice, [0.25, 0.12], painter)
    } else {
        style.surface(&mut a, dice, [0.25, 0.12])
    };
    let lining = style.turned(3).plain(&mut a, dice, [0.1, 0.1]);
    let sole = style.turned(dice.int(1, 4)).plain(&mut a, dice, [0.25, 0.02]);
    let laces = a.plain(style.palette.light);
    let pair = dice.chance(0.5);
    for side in if pair { vec![1.0, -1.0] } else { vec![1.0] } {
        let apart = if pair { last.width * dice.range(0.6, 0.8) } else { 0.0 };
        let frame =
            a.at.moved(side * apart, dice.around_zero(0.01), 0.0)
                .turned(2, side * dice.range(0.0, 0.02))
                .stretched(side, 1.0, 1.0);
        a.within(frame, |a| {
            last.sole(a, sole);
            last.upper(a, upper, lining);
            last.laces(a, laces);
        });
    }
    a
}

/// A shoe's measures: toe towards -y, metres.
struct Last {
    length: f64,
    width: f64,
    instep: f64,
    shaft: f64,
    opening: f64,
    toe: f64,
    heel: f64,
    sole: f64,
    rows: u32,
}

impl Last {
    fn draw(dice: &mut Dice) -> Self {
        let boot = dice.chance(0.35);
        Self {
            length: dice.range(0.12, 0.2),
            width: dice.range(0.045, 0.065),
            instep: dice.range(0.035, 0.055),
            shaft: if boot { dice.range(0.07, 0.13) } else { dice.range(0.04, 0.065) },
            opening: dice.range(0.32, 0.45),
            toe: dice.range(0.35, 0.8),
            heel: if dice.chance(0.3) { dice.range(0.012, 0.05) } else { 0.0 },
            sole: dice.range(0.005, 0.016),
            rows: dice.int(0, 7),
        }
    }

    /// Half width and the middle's x at `t` from heel (0) to toe (1).
    fn plan(&self, t: f64) -> (f64, f64) {
        let end = power((1.0 - t).max(0.0), 0.5 * self.toe) * power(t.max(0.0), 0.3);
        let waist = 1.0 - 0.22 * sin_turns(0.5 * (t * 1.6).min(1.0)) * (1.0 - t);
        (self.width * 0.62 * end.min(1.0) * waist, 0.006 * sin_turns(t * 0.5))
    }

    /// How high the foot stands at `t`: up at a heel.
    fn lift(&self, t: f64) -> f64 {
        let s = (1.0 - t * 1.5).max(0.0);
        self.heel * s * s * (3.0 - 2.0 * s) + 0.006 * power((t - 0.75).max(0.0) * 4.0, 2.0)
    }

    fn y(&self, t: f64) -> f64 {
        self.length * (0.5 - t)
    }

    fn sole(&self, a: &mut Assembly, paint: u32) {
        let outline = |z: &dyn Fn(f64) -> f64, grow: f64| -> Vec<V> {
            (0..AROUND)
                .map(|i| {
                    let turns = i as f64 / AROUND as f64;
                    let t = 0.5 - 0.5 * cos_turns(turns);
                    let (half, middle) = self.plan(t.clamp(0.004, 0.996));
                    let side = if turns < 0.5 { -1.0 } else { 1.0 };
                    v(middle + side * (half + grow), self.y(t) + grow * cos_turns(turns), z(t))
                })
                .collect()
        };
        let (up, down) = (|t: f64| self.lift(t) + self.sole, |t: f64| self.lift(t));
        // The ring runs from the heel along the right side to the toe: clockwise from above.
        let rings: Vec<Vec<V>> = [outline(&up, 0.001), outline(&down, 0.002)]
            .into_iter()
            .map(|ring| ring.into_iter().rev().collect())
            .collect();
        let anticlockwise = area(&rings[0]) > 0.0;
        let rings: Vec<Vec<V>> = if anticlockwise {
            rings
        } else {
            rings.into_iter().map(|r| r.into_iter().rev().collect()).collect()
        };
        a.loft(&rings, paint, paint);
        if self.heel > 0.0 {
            let (y0, y1) = (self.y(0.26), self.y(0.02));
            a.block(v(-self.width * 0.3, y0, 0.0), v(self.width * 0.3, y1, self.heel * 0.98), paint);
        }
    }

    /// Rings from the toe back to the heel, each from the sole over the foot; then the shaft up and back inside.
    fn upper(&self, a: &mut Assembly, outside: u32, inside: u32) {
        // The opening lies between heel and instep; below it rings are whole.
        let steps = 26;
        let ring_at = |t: f64| -> Vec<V> {
            let (half, middle) = self.plan(t);
            let floor = self.lift(t) + self.sole * 0.6;
            let top =
                self.instep * (1.0 - 0.55 * power(t, 1.5)) * power((1.0 - t).max(0.0), 0.18).min(1.0) + 0.002;
            let top = top * power((t * 6.0).min(1.0), 0.4);
            (0..AROUND)
                .map(|i| {
                    let turns = i as f64 / AROUND as f64;
                    let (c, s) = (cos_turns(turns), sin_turns(turns));
                    let z = if s > 0.0 { power(s, 0.8) * top } else { 0.0 };
                    let x = half * if c < 0.0 { -power(-c, 0.7) } else { power(c, 0.7) };
                    v(middle + x, self.y(t), floor + z)
                })
                .collect()
        };
        let rings: Vec<Vec<V>> =
            (0..=steps).rev().map(|k| ring_at(0.012 + 0.976 * f64::from(k) / f64::from(steps))).collect();
        a.loft(&rings, outside, outside);
        self.shaft(a, outside, inside);
    }

    fn shaft(&self, a: &mut Assembly, outside: u32, inside: u32) {
        let (from, to) = (0.03, self.opening);
        let middle = self.y(0.5 * (from + to));
        let deep = 0.5 * (to - from) * self.length;
        let ground = self.lift(0.15) + self.sole;
        let ring = |wide: f64, deep: f64, z: f64, lean: f64| -> Vec<V> {
            (0..AROUND)
                .map(|i| {
                    let turns = i as f64 / AROUND as f64;
                    let back = sin_turns(turns);
                    v(
                        wide * cos_turns(turns),
                        middle + lean + deep * back,
                        z + 0.008 * back * (z / self.shaft).min(1.0),
                    )
                })
                .collect()
        };
        let half = self.plan(0.2).0;
        let top = ground + self.shaft;
        let wall = 0.0035;
        let outer = [
            ring(half * 0.86, deep, top, 0.0),
            ring(half * 0.9, deep * 1.02, ground + self.shaft * 0.6, 0.0),
            ring(half * 0.97, deep * 0.98, ground + self.instep * 0.3, 0.0),
        ];
        let inner = [
            ring(half * 0.86 - wall, deep - wall, top, 0.0),
            ring(half * 0.85 - wall, deep * 0.95 - wall, ground + self.instep * 0.5, 0.0),
        ];
        a.part(true, |a| {
            a.skin(&[inner[1].clone(), inner[0].clone()], true, WHOLE, inside);
            a.fan(&inner[1], true, WHOLE, inside);
            a.skin(&[inner[0].clone(), outer[0].clone()], true, WHOLE, inside);
            a.skin(&outer, true, WHOLE, outside);
            a.fan(&outer[2], false, WHOLE, outside);
        });
    }

    fn laces(&self, a: &mut Assembly, paint: u32) {
        for k in 0..self.rows {
            let t = self.opening + 0.03 + 0.045 * f64::from(k);
            let (half, middle) = self.plan(t);
            let z = |share: f64| {
                let top = self.instep * (1.0 - 0.55 * power(t, 1.5)) * power(1.0 - t, 0.18) + 0.002;
                self.lift(t) + self.sole * 0.6 + top * share + 0.0008
            };
            let (wide, slant) = (half * 0.5, if k % 2 == 0 { 0.003 } else { -0.003 });
            let path = path_through(
                &[
                    v(middle - wide, self.y(t) - slant, z(0.88)),
                    v(middle, self.y(t), z(1.0)),
                    v(middle + wide, self.y(t) + slant, z(0.88)),
                ],
                10,
            );
            a.tube(&path, 6, 0.0014, paint);
        }
    }
}

/// Twice the ring's area as seen from above.
fn area(ring: &[V]) -> f64 {
    ring.iter().zip(ring.iter().cycle().skip(1)).map(|(a, b)| a.x * b.y - b.x * a.y).sum()
}

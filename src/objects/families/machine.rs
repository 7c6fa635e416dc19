//! Machine parts: gears on shafts, flanges with bolts, pipe fittings, springs, heat sinks.

use super::style::Style;
use crate::objects::dice::Dice;
use crate::objects::exact::{cos_turns, sin_turns};
use crate::objects::frame::{V, v};
use crate::objects::paint::{brushed_metal, texels};
use crate::objects::shape::{Assembly, SAME_EACH, Section, circle, gear, path_through};

pub(super) fn make(dice: &mut Dice) -> Assembly {
    let mut a = Assembly::new();
    let style = Style::draw(dice);
    let metal = brushed_metal(dice, [0.1, 0.1]);
    let metal = style.worn(&mut a, dice, [0.1, 0.1], metal);
    let other = if dice.chance(0.5) { metal } else { style.surface(&mut a, dice, [0.1, 0.1]) };
    let parts = Parts { metal, other };
    match dice.int(0, 5) {
        0 | 1 => parts.gears(&mut a, dice),
        2 => parts.flange(&mut a, dice),
        3 => parts.pipes(&mut a, dice),
        4 => parts.heat_sink(&mut a, dice),
        _ => parts.engine(&mut a, dice, &style),
    }
    a
}

struct Parts {
    metal: u32,
    other: u32,
}

impl Parts {
    /// A disc about z from z = 0 up.
    fn disc(a: &mut Assembly, r: f64, height: f64, paint: u32) {
        let edge = (height * 0.2).min(r * 0.1);
        a.lathe(
            40,
            &[Section::new(
                &[
                    [0.0, height],
                    [r - edge, height],
                    [r, height - edge],
                    [r, edge],
                    [r - edge, 0.0],
                    [0.0, 0.0],
                ],
                paint,
            )],
        );
    }

    /// A bolt's head standing on z = 0.
    fn bolt(&self, a: &mut Assembly, r: f64) {
        a.extrude(&circle([r, r], 6), r * 0.9, r * 0.1, self.metal, self.metal);
        Self::disc(a, r * 0.45, r * 1.5, self.metal);
    }

    fn gears(&self, a: &mut Assembly, dice: &mut Dice) {
        let mut z = 0.0;
        let shaft = dice.range(0.004, 0.009);
        for k in 0..dice.int(1, 5) {
            let (r, height) = (dice.range(0.018, 0.055), dice.range(0.004, 0.016));
            let teeth = ((r / dice.range(0.0012, 0.003)) as usize).clamp(8, 48);
            let outline = gear(r, r * dice.range(0.8, 0.92), teeth);
            let hole = circle([shaft * 1.01, shaft * 1.01], 24);
            let paint = if k % 2 == 0 { self.metal } else { self.other };
            let frame = a.at.moved(0.0, 0.0, z).turned(2, dice.unit());
            a.within(frame, |a| {
                a.extrude_with_hole(&outline, Some(&hole), height, height * 0.05, paint, paint);
                if r > 0.03 {
                    // Weights on the face, instead of spokes.
                    let count = dice.int(0, 8);
                    for i in 0..count {
                        let frame = a.at.turned(2, f64::from(i) / f64::from(count)).moved(
                            r * 0.55,
                            0.0,
                            height - 0.001,
                        );
                        a.within(frame, |a| Self::disc(a, r * 0.13, 0.004, self.metal));
                    }
                }
            });
            z += height + dice.range(0.0, 0.012);
        }
        let frame = a.at.moved(0.0, 0.0, -0.012);
        a.within(frame, |a| Self::disc(a, shaft, z + 0.03, self.metal));
    }

    fn flange(&self, a: &mut Assembly, dice: &mut Dice) {
        let (r, height, bolts) = (dice.range(0.035, 0.06), dice.range(0.006, 0.014), dice.int(3, 12));
        let bore = r * dice.range(0.25, 0.55);
        let square = dice.chance(0.3);
        let outline = if square {
            crate::objects::shape::rounded_rectangle([r, r], r * 0.2, 5)
        } else {
            circle([r, r], 64)
        };
        a.extrude_with_hole(&outline, Some(&circle([bore, bore], 48)), height, 0.001, self.other, self.other);
        let tall = dice.range(0.01, 0.06);
        let (inner, outer) = (bore, bore + dice.range(0.003, 0.008));
        let tube = [
            [inner, height - 0.001],
            [inner, height + tall],
            [outer, height + tall],
            [outer, height - 0.001],
            [inner, height - 0.001],
        ];
        a.lathe(48, &[Section::new(&tube, self.metal)]);
        for k in 0..bolts {
            let frame = a.at.turned(2, f64::from(k) / f64::from(bolts)).moved(0.5 * (outer + r), 0.0, height);
            a.within(frame, |a| self.bolt(a, (r - outer) * 0.2));
        }
        let ribs = dice.int(0, 6);
        for k in 0..ribs {
            let frame = a.at.turned(2, (f64::from(k) + 0.5) / f64::from(ribs)).turned(0, 0.25).moved(
                outer * 0.9,
                0.0,
                -0.0015,
            );
            let rib = [[0.0, height], [(r - outer) * 0.9, height], [0.0, height + tall * 0.8]];
            a.within(frame, |a| a.extrude(&rib, 0.003, 0.0, self.other, self.other));
        }
    }

    fn pipes(&self, a: &mut Assembly, dice: &mut Dice) {
        let r = dice.range(0.006, 0.014);
        let mut at = V::zeros();
        let mut direction = V::z();
        let mut knots = vec![at];
        for _ in 0..dice.int(2, 6) {
            let length = dice.range(0.03, 0.06);
            at += direction * length;
            knots.push(at);
            let turn = dice.pick(&[V::x(), V::y(), -V::x(), -V::y(), V::z()]);
            if turn.dot(&direction).abs() < 0.5 {
                direction = turn;
            }
        }
        // Straight runs with round elbows: each corner is cut.
        let mut path = vec![knots[0]];
        for three in knots.windows(3) {
            let (before, after) = ((three[1] - three[0]).normalize(), (three[2] - three[1]).normalize());
            let cut = r * 1.6;
            for i in 0..=8 {
                let t = f64::from(i) / 8.0;
                let (p, q) = (three[1] - before * cut, three[1] + after * cut);
                path.push(p * (1.0 - t) * (1.0 - t) + three[1] * 2.0 * t * (1.0 - t) + q * t * t);
            }
        }
        path.extend(knots.last());
        path.dedup_by(|a, b| (*a - *b).norm() < 1e-6);
        a.tube(&path, 24, r, self.other);
        for pair in knots.windows(2) {
            let along = pair[1] - pair[0];
            for share in [0.0, 1.0] {
                let frame = a.at.along(pair[0] + along * share - along.normalize() * (r * 0.45), along);
                a.within(frame, |a| Self::disc(a, r * 1.4, r * 0.9, self.metal));
            }
        }
        if dice.chance(0.6) {
            // A hand wheel.
            let (middle, wide) = ((knots[0] + knots[1]) * 0.5, r * dice.range(2.0, 3.5));
            let frame = a.at.along(middle, V::x() - V::y());
            a.within(frame, |a| {
                Self::disc(a, r * 0.5, r * 3.0, self.metal);
                let ring: Vec<V> = circle([wide, wide], 64).iter().map(|[x, y]| v(*x, *y, r * 2.8)).collect();
                a.ring_along(&ring, 12, [r * 0.3, r * 0.3], 0.0, self.other);
                for k in 0..dice.int(3, 6) {
                    let t = f64::from(k) / 5.0;
                    a.tube(
                        &[v(0.0, 0.0, r * 2.8), v(wide * cos_turns(t), wide * sin_turns(t), r * 2.8)],
                        8,
                        r * 0.2,
                        self.metal,
                    );
                }
            });
        }
    }

    fn heat_sink(&self, a: &mut Assembly, dice: &mut Dice) {
        let (x, y, tall) = (dice.range(0.03, 0.05), dice.range(0.03, 0.05), dice.range(0.015, 0.05));
        a.block(v(-x, -y, 0.0), v(x, y, 0.006), self.metal);
        let pins = dice.chance(0.4);
        let (columns, rows) = (dice.int(4, 14), if pins { dice.int(4, 10) } else { 1 });
        for i in 0..columns {
            for j in 0..rows {
                let at =
                    |k: u32, of: u32, half: f64| half * (2.0 * (f64::from(k) + 0.5) / f64::from(of) - 1.0);
                let (cx, wide) = (at(i, columns, x), x / f64::from(columns) * 0.4);
                let (cy, deep) = if pins { (at(j, rows, y), y / f64::from(rows) * 0.4) } else { (0.0, y) };
                a.block(v(cx - wide, cy - deep, 0.005), v(cx + wide, cy + deep, tall), self.metal);
            }
        }
        if dice.chance(0.5) {
            let frame = a.at.moved(0.0, 0.0, tall + 0.001);
            let (r, hub) = (x.min(y) * 0.85, x.min(y) * 0.3);
            a.within(frame, |a| {
                Self::disc(a, hub, 0.009, self.other);
                let blades = dice.int(4, 9);
                for k in 0..blades {
                    let frame =
                        a.at.moved(0.0, 0.0, 0.005)
                            .turned(2, f64::from(k) / f64::from(blades))
                            .moved(0.5 * (r + hub), 0.0, 0.0)
                            .turned(0, 0.08);
                    a.within(frame, |a| {
                        a.rounded_box(v(r - hub + 0.004, r * 0.5, 0.0012), 0.0004, 1, SAME_EACH, self.other)
                    });
                }
                let rim: Vec<V> =
                    circle([r * 1.05, r * 1.05], 64).iter().map(|[x, y]| v(*x, *y, 0.004)).collect();
                a.ring_along(&rim, 8, [0.0015, 0.005], 0.0, self.other);
            });
        }
    }

    /// A block with cylinders, bolts, a spring and a hose.
    fn engine(&self, a: &mut Assembly, dice: &mut Dice, style: &Style) {
        let (x, y, z) = (dice.range(0.03, 0.05), dice.range(0.02, 0.035), dice.range(0.02, 0.035));
        let frame = a.at.moved(0.0, 0.0, z * 0.5);
        a.within(frame, |a| a.rounded_box(v(2.0 * x, 2.0 * y, z), 0.003, 3, SAME_EACH, self.other));
        let cylinders = dice.int(1, 4);
        let r = (x / f64::from(cylinders) * 0.85).min(y * 0.8);
        let lean = dice.range(-0.06, 0.06);
        for k in 0..cylinders {
            let cx = x * (2.0 * (f64::from(k) + 0.5) / f64::from(cylinders) - 1.0);
            let frame = a.at.moved(cx, 0.0, z - 0.002).turned(0, lean * if k % 2 == 0 { 1.0 } else { -1.0 });
            let (fins, tall) = (dice.int(4, 9), dice.range(0.02, 0.045));
            a.within(frame, |a| {
                Self::disc(a, r * 0.7, tall, self.metal);
                for i in 0..fins {
                    let frame = a.at.moved(0.0, 0.0, tall * (f64::from(i) + 0.4) / f64::from(fins));
                    a.within(frame, |a| Self::disc(a, r, tall / f64::from(fins) * 0.45, self.metal));
                }
                let frame = a.at.moved(0.0, 0.0, tall);
                a.within(frame, |a| self.bolt(a, r * 0.3));
            });
        }
        for k in 0..dice.int(0, 3) {
            let hose = style.turned(k).plain(a, dice, [0.01, 0.1]);
            let side = if k % 2 == 0 { 1.0 } else { -1.0 };
            let knots = [
                v(side * x, 0.0, z * 0.5),
                v(side * (x + 0.02), -y, z),
                v(0.0, -y - 0.02, z * dice.range(0.5, 2.0)),
                v(-side * x * 0.5, -y * 0.9, z * 0.6),
            ];
            a.tube(&path_through(&knots, 40), 12, dice.range(0.002, 0.005), hose);
        }
        let spring: Vec<V> = (0..=200)
            .map(|i| {
                let t = f64::from(i) / 200.0;
                v(
                    x * 0.8 + 0.005 * cos_turns(t * 9.0),
                    y + 0.007 + 0.005 * sin_turns(t * 9.0),
                    0.002 + z * 1.5 * t,
                )
            })
            .collect();
        let steel = brushed_metal(dice, [0.01, 0.1]);
        let steel = a.paint(texels([0.01, 0.05]), steel);
        a.tube(&spring, 7, 0.0012, steel);
        for (sx, sy) in [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)] {
            let frame = a.at.moved(sx * x * 0.85, sy * y * 0.8, z);
            a.within(frame, |a| self.bolt(a, 0.003));
        }
    }
}

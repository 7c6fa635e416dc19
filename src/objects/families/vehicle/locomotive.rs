//! Toy locomotives.

use super::{wheel, wheel_paints};
use crate::objects::dice::Dice;
use crate::objects::families::style::Style;
use crate::objects::frame::{V, v};
use crate::objects::shape::{Assembly, Section};

pub(super) fn locomotive(a: &mut Assembly, dice: &mut Dice, style: &Style) {
    let (long, r) = (dice.range(0.07, 0.1), dice.range(0.012, 0.018));
    let wheel_r = r * dice.range(0.5, 0.75);
    let z = wheel_r * 1.6 + r;
    let body = style.surface(a, dice, [0.09, long]);
    let trim = style.turned(1).plain(a, dice, [0.03, 0.03]);
    let path: Vec<V> = (0..=10).map(|i| v(0.0, -long * 0.5 + long * 0.75 * f64::from(i) / 10.0, z)).collect();
    a.tube(&path, 32, r, body);
    for k in 0..dice.int(1, 5) {
        let y = -long * 0.45 + long * 0.14 * f64::from(k);
        let ring: Vec<V> = crate::objects::shape::circle([r * 1.01, r * 1.01], 40)
            .iter()
            .map(|[x, h]| v(*x, y, z + *h))
            .collect();
        a.ring_along(&ring, 8, [0.001, 0.001], 0.0, trim);
    }
    a.block(v(-r * 1.1, -long * 0.5, z - r * 1.2), v(r * 1.1, long * 0.55, z - r * 0.8), trim);
    let cab = style.turned(2).surface(a, dice, [0.04, 0.04]);
    let (y0, y1, top) = (long * 0.2, long * 0.55, z + r * 2.0);
    for (sx, sy) in [(-1.0, y0), (1.0, y0), (1.0, y1), (-1.0, y1)] {
        a.block(v(sx * r - 0.002, sy - 0.002, z), v(sx * r + 0.002, sy + 0.002, top), cab);
    }
    a.block(v(-r * 1.1, y0, z - r), v(r * 1.1, y1, z + r * 0.6), cab);
    a.block(v(-r * 1.25, y0 - 0.004, top), v(r * 1.25, y1 + 0.004, top + 0.003), trim);
    let stack = r * dice.range(0.3, 0.5);
    let frame = a.at.moved(0.0, -long * 0.4, z + r * 0.8);
    let profile = [
        [0.0, r * 1.1],
        [stack * 1.2, r * 1.2],
        [stack * 1.6, r * 1.2],
        [stack, r * 0.7],
        [stack, 0.0],
        [0.0, 0.0],
    ];
    a.within(frame, |a| a.lathe(28, &[Section::new(&profile, trim)]));
    for k in 0..dice.int(1, 3) {
        a.ellipsoid(
            v(0.0, -long * 0.2 + 0.02 * f64::from(k), z + r * 0.95),
            v(0.006, 0.006, 0.007),
            14,
            trim,
        );
    }
    let (tyre, hub) = wheel_paints(a, dice, style);
    for k in 0..dice.int(2, 5) {
        let y = -long * 0.4 + wheel_r * 2.2 * f64::from(k);
        for side in [1.0, -1.0] {
            wheel(a, v(side * r, y, wheel_r), wheel_r, 0.004, tyre, hub);
        }
    }
}

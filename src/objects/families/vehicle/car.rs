//! Toy cars.

use super::{wheel, wheel_paints};
use crate::objects::dice::Dice;
use crate::objects::families::style::Style;
use crate::objects::frame::{V, v};
use crate::objects::shape::{Assembly, superellipse};

pub(super) fn car(a: &mut Assembly, dice: &mut Dice, style: &Style) {
    let (long, wide) = (dice.range(0.07, 0.11), dice.range(0.018, 0.025));
    let (r, low) = (dice.range(0.009, 0.015), dice.range(0.006, 0.012));
    let (bonnet, roof) = (dice.range(0.018, 0.03), dice.range(0.032, 0.052));
    let paint = style.surface(a, dice, [0.12, 0.1]);
    let glass = a.plain([0.12, 0.16, 0.2]);
    let square = dice.range(0.25, 0.7);
    // Cross-sections from the nose (-y) to the tail.
    let body = |t: f64, half: f64, top: f64| -> Vec<V> {
        superellipse([half, 0.5 * (top - low)], square, 32)
            .iter()
            .map(|[x, z]| v(*x, long * (t - 0.5), 0.5 * (top + low) + z))
            .collect()
    };
    let boot = dice.range(0.8, 1.15) * bonnet;
    let rings: Vec<Vec<V>> = [
        (0.0, 0.6, 0.75),
        (0.03, 0.9, 0.85),
        (0.15, 1.0, 0.95),
        (0.5, 1.02, 1.05),
        (0.85, 1.0, boot / bonnet),
        (0.97, 0.92, 0.9 * boot / bonnet),
        (1.0, 0.7, 0.8),
    ]
    .iter()
    .map(|(t, half, top)| body(*t, wide * half, bonnet * top))
    .collect();
    a.loft(&rings, paint, paint);
    // The cabin, glass all round, and a roof over it.
    let (front, back) = (dice.range(0.22, 0.4), dice.range(0.7, 0.97));
    let section = |half: f64, z: f64, from: f64, to: f64| -> Vec<V> {
        superellipse([half, 0.5 * (to - from) * long], 0.35, 32)
            .iter()
            .map(|[x, y]| v(*x, (0.5 * (from + to) - 0.5) * long + y, z))
            .collect()
    };
    let slope = dice.range(0.04, 0.12);
    let closed = dice.chance(0.85);
    if closed {
        let belt = bonnet * 0.9;
        a.loft(
            &[
                section(wide * 0.8, roof - 0.002, front + slope, back - slope * 0.7),
                section(wide * 0.95, belt, front, back),
            ],
            glass,
            glass,
        );
        a.loft(
            &[
                section(wide * 0.7, roof, front + slope * 1.3, back - slope),
                section(wide * 0.82, roof - 0.003, front + slope, back - slope * 0.7),
            ],
            paint,
            paint,
        );
    }
    let (tyre, hub) = wheel_paints(a, dice, style);
    for y in [-0.31, 0.31] {
        for side in [1.0, -1.0] {
            wheel(a, v(side * wide * 0.95, y * long, r), r, r * 0.8, tyre, hub);
        }
    }
    let light = a.plain([0.98, 0.95, 0.8]);
    let red = a.plain([0.8, 0.05, 0.05]);
    for side in [1.0, -1.0] {
        a.ellipsoid(v(side * wide * 0.62, -long * 0.49, bonnet * 0.62), v(0.0035, 0.003, 0.003), 10, light);
        a.ellipsoid(v(side * wide * 0.62, long * 0.49, bonnet * 0.65), v(0.004, 0.003, 0.002), 10, red);
    }
    match dice.int(0, 4) {
        0 => {
            let wing = style.turned(2).plain(a, dice, [0.05, 0.01]);
            let z = bonnet * 1.35;
            a.block(v(-wide * 0.95, long * 0.42, z), v(wide * 0.95, long * 0.5, z + 0.0015), wing);
            for side in [1.0, -1.0] {
                a.block(
                    v(side * wide * 0.7 - 0.001, long * 0.43, bonnet * 0.8),
                    v(side * wide * 0.7 + 0.001, long * 0.48, z + 0.001),
                    wing,
                );
            }
        }
        1 if closed => {
            // Luggage on the roof.
            for k in 0..dice.int(1, 4) {
                let y = long * (0.45 * (front + back) - 0.4 + 0.1 * f64::from(k));
                let bag = style.turned(k).surface(a, dice, [0.03, 0.02]);
                let tall = dice.range(0.004, 0.012);
                a.block(
                    v(-wide * dice.range(0.2, 0.6), y, roof - 0.001),
                    v(wide * dice.range(0.2, 0.6), y + long * 0.09, roof + tall),
                    bag,
                );
            }
        }
        _ => {}
    }
}

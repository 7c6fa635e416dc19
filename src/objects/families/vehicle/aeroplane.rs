//! Toy aeroplanes.

use super::{wheel, wheel_paints};
use crate::objects::dice::Dice;
use crate::objects::families::style::Style;
use crate::objects::frame::{V, v};
use crate::objects::shape::{Assembly, SAME_EACH, superellipse};

pub(super) fn aeroplane(a: &mut Assembly, dice: &mut Dice, style: &Style) {
    let (long, r) = (dice.range(0.09, 0.14), dice.range(0.008, 0.015));
    let body = style.surface(a, dice, [0.08, long]);
    let wing = style.turned(1).surface(a, dice, [0.1, 0.03]);
    let z = 0.03;
    let path: Vec<V> = (0..=28).map(|i| v(0.0, long * (f64::from(i) / 28.0 - 0.5), z)).collect();
    let tail = dice.range(0.15, 0.5);
    a.tube_along(&path, 24, V::x(), body, |t| {
        let nose = (t * 5.0).min(1.0);
        let end = 1.0 - (1.0 - tail) * ((t - 0.4) / 0.6).max(0.0);
        [r * (0.55 + 0.45 * nose) * end, r * (0.55 + 0.45 * nose) * end]
    });
    let (span, chord, sweep) = (dice.range(0.05, 0.08), dice.range(0.02, 0.035), dice.range(-0.01, 0.05));
    let lift = dice.range(-0.005, 0.012);
    let plane = |a: &mut Assembly, y: f64, z: f64, span: f64, chord: f64, upright: bool| {
        for side in if upright { vec![1.0] } else { vec![1.0, -1.0] } {
            let ring = |t: f64| -> Vec<V> {
                superellipse([chord * 0.5 * (1.0 - 0.45 * t), chord * 0.055], 1.0, 20)
                    .iter()
                    .map(|[c, h]| {
                        let (out, back) = (span * t, y + c + sweep * t);
                        if upright { v(*h, back, z + out) } else { v(side * out, back, z + h + lift * t) }
                    })
                    .collect()
            };
            let mut rings: Vec<Vec<V>> = (0..=6).map(|k| ring(f64::from(k) / 6.0)).collect();
            // The rings must run anticlockwise as seen from the first.
            if !upright && side > 0.0 {
                rings.iter_mut().for_each(|ring| ring.reverse());
            }
            a.loft(&rings, wing, wing);
        }
    };
    let decks = if dice.chance(0.35) { 2 } else { 1 };
    for k in 0..decks {
        plane(a, -long * 0.1, z - r * 0.3 + 0.022 * f64::from(k), span, chord, false);
    }
    if decks == 2 {
        for side in [1.0, -1.0] {
            for share in [0.4, 0.8] {
                let (x, up) = (side * span * share, lift * share);
                a.tube(
                    &[
                        v(x, -long * 0.1 + sweep * share, z - r * 0.3 + up),
                        v(x, -long * 0.1 + sweep * share, z - r * 0.3 + 0.022 + up),
                    ],
                    6,
                    0.0011,
                    wing,
                );
            }
        }
    }
    plane(a, long * 0.42, z, span * 0.4, chord * 0.6, false);
    plane(a, long * 0.42, z, span * 0.35, chord * 0.7, true);
    let trim = style.turned(2).plain(a, dice, [0.03, 0.03]);
    if dice.chance(0.6) {
        a.ellipsoid(v(0.0, -long * 0.53, z), v(0.004, 0.007, 0.004), 12, trim);
        for k in 0..dice.int(2, 4) {
            let frame = a.at.moved(0.0, -long * 0.53, z).turned(1, f64::from(k) / 3.0);
            a.within(frame, |a| a.rounded_box(v(0.003, 0.0012, 0.045), 0.0005, 1, SAME_EACH, trim));
        }
    } else {
        for side in [1.0, -1.0] {
            let (x, y) = (side * span * 0.4, -long * 0.1 + sweep * 0.4);
            a.tube(&[v(x, y - 0.012, z - r * 0.7), v(x, y + 0.01, z - r * 0.7)], 18, 0.005, trim);
        }
    }
    let glass = a.plain([0.1, 0.14, 0.2]);
    a.ellipsoid(v(0.0, -long * 0.25, z + r * 0.7), v(r * 0.6, r * 1.3, r * 0.6), 14, glass);
    let (tyre, hub) = wheel_paints(a, dice, style);
    for (x, y) in [(0.018, -0.12), (-0.018, -0.12), (0.0, 0.35)] {
        a.tube(&[v(x * 0.6, y * long, z - r * 0.4), v(x, y * long, 0.006)], 6, 0.0012, trim);
        wheel(a, v(x, y * long, 0.006), 0.006, 0.004, tyre, hub);
    }
}

//! Toy boats.

use crate::objects::dice::Dice;
use crate::objects::families::style::Style;
use crate::objects::frame::{V, v};
use crate::objects::shape::{Assembly, Section, WHOLE};

pub(super) fn boat(a: &mut Assembly, dice: &mut Dice, style: &Style) {
    let (long, wide, deep) = (dice.range(0.09, 0.14), dice.range(0.018, 0.03), dice.range(0.015, 0.03));
    let hull = style.surface(a, dice, [0.14, 0.03]);
    let deck = style.turned(1).surface(a, dice, [0.05, 0.1]);
    let stern = dice.range(0.5, 0.95);
    // Rings at heights, pointed at the bow (-y).
    let outline = |share: f64, z: f64| -> Vec<V> {
        (0..48)
            .map(|i| {
                let t = f64::from(i) / 48.0;
                let (c, s) = (crate::objects::exact::cos_turns(t), crate::objects::exact::sin_turns(t));
                let bow = if s < 0.0 { 1.0 - 0.75 * s * s } else { 1.0 - (1.0 - stern) * s };
                v(
                    wide * share * c * bow,
                    0.5 * long * s * (0.75 + 0.25 * share),
                    z - 0.15 * deep * (1.0 - share) + if s < 0.0 { 0.25 * deep * s * s * share } else { 0.0 },
                )
            })
            .collect()
    };
    let wall = 0.9;
    a.part(true, |a| {
        let floor = outline(0.72, deep * 0.6);
        a.fan(&floor, true, WHOLE, deck);
        a.skin(&[floor.clone(), outline(wall, deep)], true, WHOLE, deck);
        a.skin(
            &[outline(wall, deep), outline(1.0, deep), outline(0.8, deep * 0.4), outline(0.4, 0.0)],
            true,
            WHOLE,
            hull,
        );
        a.fan(&outline(0.4, 0.0), false, WHOLE, hull);
    });
    let cabin = style.turned(2).surface(a, dice, [0.06, 0.03]);
    match dice.int(0, 2) {
        0 => {
            let mast = dice.range(0.08, 0.13);
            a.tube(&[v(0.0, -long * 0.05, deep * 0.5), v(0.0, -long * 0.05, deep + mast)], 10, 0.002, deck);
            let sail = style.turned(3).surface(a, dice, [0.08, 0.1]);
            let (belly, foot) = (dice.range(0.005, 0.02), long * dice.range(0.3, 0.5));
            for (front, size) in [(1.0, 1.0), (-1.0, 0.7)] {
                a.sheet((12, 16), sail, |s, t| {
                    let u = 0.5 + 0.5 * s;
                    let y = -long * 0.05 + front * (0.003 + foot * size * u * (1.0 - t));
                    v(
                        belly * crate::objects::exact::sin_turns(u * 0.5) * (1.0 - t),
                        y,
                        deep + 0.006 + mast * 0.9 * size * t,
                    )
                });
            }
        }
        1 => {
            let mut z = deep * 0.6;
            for k in 0..dice.int(1, 4) {
                let scale = 1.0 - 0.25 * f64::from(k);
                let (x, y, tall) = (wide * 0.55 * scale, long * 0.2 * scale, dice.range(0.008, 0.014));
                a.block(v(-x, -y * 0.6, z - 0.001), v(x, y * 1.3, z + tall), cabin);
                z += tall;
            }
            for k in 0..dice.int(1, 4) {
                let y = long * (0.04 * f64::from(k));
                let frame = a.at.moved(0.0, y, z - 0.002);
                a.within(frame, |a| {
                    a.lathe(
                        20,
                        &[Section::new(&[[0.0, 0.016], [0.004, 0.016], [0.0045, 0.0], [0.0, 0.0]], deck)],
                    )
                });
            }
        }
        _ => {
            for k in 0..dice.int(2, 5) {
                let y = long * (0.14 * f64::from(k) - 0.25);
                a.block(v(-wide * 0.75, y, deep * 0.75), v(wide * 0.75, y + 0.008, deep * 0.85), cabin);
            }
            for side in [1.0, -1.0] {
                let oar = [v(side * wide * 0.5, 0.0, deep * 1.1), v(side * wide * 2.2, 0.012, deep * 0.4)];
                a.tube(&oar, 8, 0.0016, deck);
                a.ellipsoid(oar[1], v(0.012, 0.004, 0.0025), 10, deck);
            }
        }
    }
}

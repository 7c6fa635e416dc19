//! Toy trucks with what they carry.

use super::{wheel, wheel_paints};
use crate::objects::dice::Dice;
use crate::objects::families::style::Style;
use crate::objects::frame::{V, v};
use crate::objects::shape::{Assembly, SAME_EACH, path_through};

pub(super) fn truck(a: &mut Assembly, dice: &mut Dice, style: &Style) {
    let (long, wide, tall) = (dice.range(0.09, 0.14), dice.range(0.018, 0.026), dice.range(0.03, 0.05));
    let r = dice.range(0.008, 0.013);
    let chassis = a.plain(style.palette.dark);
    a.block(v(-wide * 0.6, -long * 0.5, r * 0.9), v(wide * 0.6, long * 0.5, r * 1.5), chassis);
    let cab_long = long * dice.range(0.2, 0.3);
    let cab = style.surface(a, dice, [0.05, 0.05]);
    let size = v(2.0 * wide, cab_long, tall);
    let rake = dice.range(0.0, 0.4);
    let frame = a.at.moved(0.0, -long * 0.5 + cab_long * 0.5, r * 1.5 + tall * 0.5);
    a.within(frame, |a| {
        a.box_bent(size, 0.004, 3, SAME_EACH, cab, |p| {
            let t = (p.z / size.z).max(0.0);
            v(p.x, p.y + rake * t * cab_long * (0.5 - p.y / cab_long), p.z)
        });
    });
    let glass = a.plain([0.15, 0.2, 0.26]);
    let z = r * 1.5 + tall * 0.55;
    a.block(
        v(-wide * 1.02, -long * 0.5 + cab_long * 0.35, z),
        v(wide * 1.02, -long * 0.5 + cab_long * 0.8, z + tall * 0.28),
        glass,
    );
    let start = -long * 0.5 + cab_long * 1.1;
    let floor = r * 1.5;
    match dice.int(0, 3) {
        0 => {
            let load = style.turned(1).print(a, dice, [long * 0.7, tall]);
            a.block(
                v(-wide * 1.05, start, floor),
                v(wide * 1.05, long * 0.52, floor + tall * dice.range(0.9, 1.5)),
                load,
            );
        }
        1 => {
            // A tank.
            let skin = style.turned(1).surface(a, dice, [0.08, 0.09]);
            let path = path_through(
                &[v(0.0, start + wide, floor + wide), v(0.0, long * 0.5 - wide * 0.8, floor + wide)],
                12,
            );
            a.tube(&path, 32, wide, skin);
        }
        2 => {
            // An open bed with logs or balls.
            let bed = style.turned(1).plain(a, dice, [0.08, 0.03]);
            a.block(v(-wide, start, floor), v(wide, long * 0.5, floor + 0.003), bed);
            for side in [1.0, -1.0] {
                a.block(
                    v(side * wide - 0.001, start, floor),
                    v(side * wide + 0.001, long * 0.5, floor + tall * 0.4),
                    bed,
                );
            }
            let load = style.turned(2).surface(a, dice, [0.05, 0.05]);
            for k in 0..dice.int(3, 9) {
                let lr = wide * 0.28;
                let x = wide * 0.6 * (f64::from(k % 3) - 1.0);
                let z = floor + 0.003 + lr * (1.0 + 1.8 * f64::from(k / 3));
                a.tube(&[v(x, start + 0.006, z), v(x, long * 0.48, z)], 14, lr, load);
            }
        }
        _ => {
            // A crane.
            let arm = style.turned(1).plain(a, dice, [0.02, 0.1]);
            let foot = v(0.0, start + 0.02, floor);
            let top = foot + v(0.0, long * dice.range(0.2, 0.6), long * dice.range(0.3, 0.6));
            a.block(foot - v(wide * 0.6, 0.012, 0.0), foot + v(wide * 0.6, 0.012, 0.014), arm);
            a.tube_along(&[foot + v(0.0, 0.0, 0.008), top], 8, V::x(), arm, |t| [0.005 - 0.003 * t; 2]);
            a.tube(&[top, v(top.x, top.y, floor + 0.012)], 6, 0.0007, chassis);
            a.ellipsoid(v(top.x, top.y, floor + 0.01), V::repeat(0.004), 10, chassis);
        }
    }
    let (tyre, hub) = wheel_paints(a, dice, style);
    let axles = dice.int(2, 5);
    for k in 0..axles {
        let y = long * (0.42 - 0.84 * if axles > 2 && k == axles - 1 { 1.0 } else { f64::from(k) * 0.17 });
        let y = if axles == 2 { long * (0.36 - 0.72 * f64::from(k)) } else { y };
        for side in [1.0, -1.0] {
            wheel(a, v(side * wide * 0.9, y, r), r, r * 0.7, tyre, hub);
        }
    }
}

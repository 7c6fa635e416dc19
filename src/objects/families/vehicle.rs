//! Toy vehicles: cars, trucks, locomotives, aeroplanes, boats.

use super::style::Style;
use crate::objects::dice::Dice;
use crate::objects::frame::{V, v};
use crate::objects::shape::{Assembly, SAME_EACH, Section, WHOLE, path_through, superellipse};

pub(super) fn make(dice: &mut Dice) -> Assembly {
    let mut a = Assembly::new();
    let style = Style::draw(dice);
    match dice.int(0, 5) {
        0 | 1 => car(&mut a, dice, &style),
        2 => truck(&mut a, dice, &style),
        3 => locomotive(&mut a, dice, &style),
        4 => aeroplane(&mut a, dice, &style),
        _ => boat(&mut a, dice, &style),
    }
    a
}

/// A wheel with a tread and a hub, its axle along x, at a place.
fn wheel(a: &mut Assembly, at: V, r: f64, wide: f64, tyre: u32, hub: u32) {
    let frame = a.at.moved(at.x, at.y, at.z).turned(1, 0.25);
    let h = wide * 0.5;
    a.within(frame, |a| {
        let outside = [[r * 0.6, h], [r * 0.9, h], [r, h * 0.7], [r, -h * 0.7], [r * 0.9, -h], [r * 0.6, -h]];
        let face =
            [[0.0, h * 1.1], [r * 0.15, h * 1.1], [r * 0.2, h * 0.6], [r * 0.5, h * 0.55], [r * 0.6, h]];
        let back = [[r * 0.6, -h], [r * 0.5, -h * 0.55], [0.0, -h * 0.6]];
        a.lathe(36, &[Section::new(&face, hub), Section::new(&outside, tyre), Section::new(&back, hub)]);
    });
}

/// Rubber with a tread, and a hub.
fn wheel_paints(a: &mut Assembly, dice: &mut Dice, style: &Style) -> (u32, u32) {
    let treads = dice.int(12, 40) as f32;
    let tyre = a.paint(
        (256, 64),
        Box::new(move |u, v| {
            let groove = ((u * treads + (v - 0.5).abs()).rem_euclid(1.0)) < 0.4 && (0.3..0.7).contains(&v);
            if groove { [0.04; 3] } else { [0.13; 3] }
        }),
    );
    let hub = style.turned(dice.int(1, 4)).surface(a, dice, [0.04, 0.01]);
    (tyre, hub)
}

fn car(a: &mut Assembly, dice: &mut Dice, style: &Style) {
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

fn truck(a: &mut Assembly, dice: &mut Dice, style: &Style) {
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

fn locomotive(a: &mut Assembly, dice: &mut Dice, style: &Style) {
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

fn aeroplane(a: &mut Assembly, dice: &mut Dice, style: &Style) {
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

fn boat(a: &mut Assembly, dice: &mut Dice, style: &Style) {
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

//! Electronics: remote controls, telephones, game controllers, cameras, radios.

use super::style::Style;
use crate::objects::dice::Dice;
use crate::objects::exact::circumference;
use crate::objects::frame::{V, v};
use crate::objects::paint::{Palette, mix, printed, texels};
use crate::objects::shape::{ATLAS, Assembly, Blob, Lump, SAME_EACH, Section, circle, rounded_rectangle};

pub(super) fn make(dice: &mut Dice) -> Assembly {
    let mut a = Assembly::new();
    let style = Style::draw(dice);
    match dice.int(0, 5) {
        0 => remote(&mut a, dice, &style),
        1 => telephone(&mut a, dice, &style),
        2 => controller(&mut a, dice, &style),
        3 | 4 => camera(&mut a, dice, &style),
        _ => radio(&mut a, dice, &style),
    }
    a
}

/// A lit screen full of print.
fn screen(a: &mut Assembly, dice: &mut Dice, size: [f64; 2], detail: f64) -> u32 {
    let palette = Palette::draw(dice);
    let painter = printed(dice, size, &palette, 0.3 + 0.7 * detail);
    let glow = dice.range(0.0, 0.5) as f32;
    a.paint(texels(size), Box::new(move |u, v| mix(painter(u, v), [0.05, 0.07, 0.1], glow * (1.0 - v))))
}

/// Rows of buttons on a plate whose upper face is at z = 0, between `low` and `high`.
fn buttons(a: &mut Assembly, dice: &mut Dice, style: &Style, low: [f64; 2], high: [f64; 2]) {
    let (columns, rows) = (dice.int(2, 5), dice.int(2, 9));
    let step = [(high[0] - low[0]) / f64::from(columns), (high[1] - low[1]) / f64::from(rows)];
    let half = step.map(|s| s * dice.range(0.28, 0.42));
    let tall = dice.range(0.0008, 0.0025);
    let caps: Vec<u32> = (0..dice.int(1, 4))
        .map(|_| {
            let palette = style.palette.turned(dice.int(0, 4));
            let painter = printed(dice, [half[0] * 2.0, half[1] * 2.0], &palette, 0.4);
            a.paint((96, 96), painter)
        })
        .collect();
    let round = dice.chance(0.5);
    let outline =
        if round { circle([half[0].min(half[1]); 2], 16) } else { rounded_rectangle(half, half[0] * 0.3, 2) };
    for j in 0..rows {
        for i in 0..columns {
            let x = low[0] + (f64::from(i) + 0.5) * step[0];
            let y = low[1] + (f64::from(j) + 0.5) * step[1];
            let cap = dice.pick(&caps);
            let frame = a.at.moved(x, y, -0.0004);
            a.within(frame, |a| a.extrude(&outline, tall, tall * 0.3, cap, cap));
        }
    }
}

fn remote(a: &mut Assembly, dice: &mut Dice, style: &Style) {
    let (half, long, thick) = (dice.range(0.014, 0.03), dice.range(0.05, 0.1), dice.range(0.008, 0.02));
    let body = style.turned(4).surface(a, dice, [2.0 * half, 2.0 * long]);
    let outline = rounded_rectangle([half, long], half * dice.range(0.2, 0.95), 6);
    a.extrude(&outline, thick, thick * dice.range(0.1, 0.4), body, body);
    let split = long * dice.range(-0.2, 0.5);
    let frame = a.at.moved(0.0, 0.0, thick);
    a.within(frame, |a| {
        buttons(a, dice, style, [-half * 0.8, -long * 0.85], [half * 0.8, split - 0.003]);
        if dice.chance(0.5) {
            let size = [half * 1.5, long * 0.8 - split];
            let glass = screen(a, dice, size, style.detail);
            let frame = a.at.moved(0.0, (split + long * 0.85) * 0.5, -0.0004);
            a.within(frame, |a| {
                a.extrude(
                    &rounded_rectangle([size[0] * 0.5, size[1] * 0.45], 0.001, 2),
                    0.001,
                    0.0002,
                    glass,
                    body,
                )
            });
        } else {
            buttons(a, dice, style, [-half * 0.8, split + 0.003], [half * 0.8, long * 0.85]);
        }
    });
}

fn telephone(a: &mut Assembly, dice: &mut Dice, style: &Style) {
    if dice.chance(0.5) {
        // A smartphone on a stand.
        let (half, long, thick) = (dice.range(0.03, 0.04), dice.range(0.06, 0.08), dice.range(0.006, 0.009));
        let back = style.surface(a, dice, [2.0 * half, 2.0 * long]);
        let glass = screen(a, dice, [1.9 * half, 1.9 * long], style.detail);
        let lean = dice.range(0.03, 0.1);
        let frame = a.at.moved(0.0, 0.0, 0.01).turned(0, 0.25 - lean).moved(0.0, long, 0.0);
        a.within(frame, |a| {
            a.extrude(&rounded_rectangle([half, long], half * 0.2, 5), thick, 0.001, back, back);
            let frame = a.at.moved(0.0, 0.0, thick - 0.0002);
            a.within(frame, |a| {
                a.extrude(
                    &rounded_rectangle([half * 0.93, long * 0.94], half * 0.15, 4),
                    0.0005,
                    0.0,
                    glass,
                    back,
                )
            });
            let frame = a.at.moved(half * 0.5, long * 0.7, -0.0015);
            a.within(frame, |a| {
                a.extrude(
                    &rounded_rectangle([half * 0.3, half * 0.35], half * 0.1, 3),
                    0.003,
                    0.0005,
                    back,
                    back,
                )
            });
        });
        let wood = style.turned(2).surface(a, dice, [0.08, 0.05]);
        a.block(v(-half * 0.8, -0.015, 0.0), v(half * 0.8, 0.045, 0.008), wood);
        a.block(v(-half * 0.8, -0.015, 0.007), v(half * 0.8, -0.01, 0.018), wood);
        return;
    }
    // A desk telephone: a wedge with keys and a handset across.
    let size = v(dice.range(0.1, 0.14), dice.range(0.1, 0.14), dice.range(0.03, 0.05));
    let body = style.surface(a, dice, [size.x, size.y]);
    let slope = dice.range(0.2, 0.7);
    let frame = a.at.moved(0.0, 0.0, size.z * 0.5);
    a.within(frame, |a| {
        a.box_bent(size, 0.006, 3, SAME_EACH, body, |p| {
            let z = p.z + 0.5 * size.z;
            v(p.x, p.y, z * (1.0 - slope * (0.5 - p.y / size.y)) - 0.5 * size.z)
        });
    });
    let rise = slope * size.z / size.y;
    let frame =
        a.at.moved(0.0, 0.0, size.z * (1.0 - 0.5 * slope))
            .turned(0, f64::from(crate::objects::exact::angle_turns(rise as f32, 1.0)));
    let top = -size.y * 0.42;
    a.within(frame, |a| buttons(a, dice, style, [-size.x * 0.35, top], [size.x * 0.35, top + size.y * 0.5]));
    let grip = style.turned(1).plain(a, dice, [0.05, 0.15]);
    let (z, y, reach) = (size.z + 0.018, size.y * 0.28, size.x * 0.55);
    let lumps = vec![
        Lump::rod(v(-reach, y, z), v(reach, y, z), [0.009, 0.009], grip),
        Lump::ellipsoid(v(-reach, y, z - 0.008), v(0.018, 0.02, 0.012), grip),
        Lump::ellipsoid(v(reach, y, z - 0.008), v(0.018, 0.02, 0.012), grip),
    ];
    a.blob(&Blob { lumps, softness: 0.01, tile: 0.08 }, 44, |_, d| d);
    coil(a, style, v(-reach, y, z - 0.01), v(-size.x * 0.5, -size.y * 0.1, 0.01));
}

/// A coiled cable.
fn coil(a: &mut Assembly, style: &Style, from: V, to: V) {
    let paint = a.plain(style.palette.dark);
    let path: Vec<V> = (0..=300)
        .map(|i| {
            let t = f64::from(i) / 300.0;
            let (s, c) =
                (crate::objects::exact::sin_turns(t * 24.0), crate::objects::exact::cos_turns(t * 24.0));
            let sag = v(-0.03, 0.0, -0.01) * crate::objects::exact::sin_turns(t * 0.5);
            from + (to - from) * t + sag + v(s, 0.0, c) * 0.004
        })
        .collect();
    a.tube(&path, 6, 0.001, paint);
}

fn controller(a: &mut Assembly, dice: &mut Dice, style: &Style) {
    let tile = 0.07;
    let body = style.surface(a, dice, [tile, tile]);
    let grips = if dice.chance(0.5) { style.turned(1).surface(a, dice, [tile, tile]) } else { body };
    let (wide, splay, long) = (dice.range(0.035, 0.05), dice.range(0.0, 0.025), dice.range(0.03, 0.055));
    let mut lumps = vec![Lump::ellipsoid(v(0.0, 0.0, 0.02), v(wide * 1.1, 0.024, 0.013), body)];
    for x in [1.0, -1.0] {
        lumps.push(Lump::ellipsoid(v(x * wide, 0.0, 0.02), v(0.024, 0.026, 0.015), body));
        lumps.push(Lump::rod(
            v(x * wide, 0.0, 0.02),
            v(x * (wide + splay), -long, 0.014),
            [0.018, 0.011],
            grips,
        ));
    }
    a.blob(&Blob { lumps, softness: 0.012, tile }, 56, |_, d| d);
    let dark = a.plain(style.palette.dark);
    let dish = dice.range(0.006, 0.009);
    for (x, y) in [(-wide * 0.45, -0.012), (wide * 0.45, -0.012)] {
        let stick = [
            [0.0, 0.0445],
            [dish * 0.7, 0.0445],
            [dish, 0.0455],
            [dish, 0.044],
            [0.0035, 0.042],
            [0.0035, 0.028],
            [0.0, 0.028],
        ];
        let frame = a.at.moved(x, y, -0.001);
        a.within(frame, |a| a.lathe(28, &[Section::new(&stick, dark)]));
    }
    for k in 0..4u32 {
        let color = a.plain(style.palette.all()[k as usize]);
        let frame = a.at.moved(wide, 0.002, 0.0).turned(2, 0.25 * f64::from(k)).moved(0.0095, 0.0, 0.035);
        a.within(frame, |a| {
            a.lathe(
                20,
                &[Section::new(
                    &[[0.0, 0.004], [0.0035, 0.0035], [0.004, 0.0025], [0.004, -0.003], [0.0, -0.003]],
                    color,
                )],
            )
        });
    }
    let frame = a.at.moved(-wide, 0.002, 0.036);
    a.within(frame, |a| {
        a.block(v(-0.0125, -0.004, -0.004), v(0.0125, 0.004, 0.003), dark);
        a.block(v(-0.004, -0.0125, -0.004), v(0.004, 0.0125, 0.0031), dark);
    });
}

fn camera(a: &mut Assembly, dice: &mut Dice, style: &Style) {
    let size = v(dice.range(0.08, 0.13), dice.range(0.025, 0.045), dice.range(0.055, 0.085));
    let painter = crate::objects::paint::leather(dice, [size.x, size.z], style.palette.dark);
    let body = style.worn(a, dice, [size.x, size.z], painter);
    let trim = style.turned(3).plain(a, dice, [size.x, 0.02]);
    let frame = a.at.moved(0.0, 0.0, size.z * 0.5);
    a.within(frame, |a| a.rounded_box(size, dice.range(0.003, 0.01), 4, SAME_EACH, body));
    let plate = v(size.x * 0.98, size.y * 0.98, size.z * 0.2);
    let frame = a.at.moved(0.0, 0.0, size.z + plate.z * 0.3);
    a.within(frame, |a| a.rounded_box(plate, 0.003, 3, SAME_EACH, trim));
    if dice.chance(0.7) {
        let hump = v(size.x * 0.3, size.y * 0.9, size.z * 0.3);
        let frame = a.at.moved(dice.pick(&[0.0, 0.0, -size.x * 0.2]), 0.0, size.z * 1.2);
        a.within(frame, |a| {
            a.box_bent(hump, 0.004, 3, SAME_EACH, trim, |p| {
                let t = 0.5 + p.z / hump.z;
                v(p.x * (1.0 - 0.35 * t), p.y * (1.0 - 0.2 * t), p.z)
            })
        });
    }
    // The lens, stepped, with print around it and glass in front.
    let (r, long) = (size.z * dice.range(0.3, 0.44), dice.range(0.015, 0.07));
    let ring = printed(dice, [circumference(r), long], &style.palette.turned(4), style.detail);
    let barrel = a.paint((1024, 128), ring);
    let glass = a.paint(
        (128, 128),
        Box::new(|u, v| {
            mix(
                [0.05, 0.04, 0.12],
                [0.5, 0.4, 0.75],
                ((u - 0.3) * (u - 0.3) + (v - 0.4) * (v - 0.4) < 0.02) as u8 as f32,
            )
        }),
    );
    let mut outside = vec![[r * 0.9, long], [r * 0.95, long]];
    for k in 1..=4 {
        let z = long * (1.0 - f64::from(k) / 5.0);
        let step = r * dice.range(0.85, 1.05);
        outside.extend([[step, z + 0.001], [step, z]]);
    }
    outside.extend([[r, 0.0], [r, -0.004]]);
    let frame =
        a.at.moved(dice.pick(&[0.0, 0.0, size.x * 0.1]), -size.y * 0.5, size.z * 0.48).turned(0, 0.25);
    a.within(frame, |a| {
        let front = [[0.0, long - 0.008], [r * 0.4, long - 0.0085], [r * 0.8, long - 0.01], [r * 0.9, long]];
        let back = [[r, -0.004], [0.0, -0.004]];
        a.lathe(
            56,
            &[Section::new(&front, glass), Section::new(&outside, barrel), Section::new(&back, barrel)],
        );
    });
    for k in 0..dice.int(1, 4) {
        let (r, tall) = (dice.range(0.004, 0.009), dice.range(0.002, 0.008));
        let x = size.x * (0.42 - 0.14 * f64::from(k)) * if k % 2 == 0 { 1.0 } else { -1.0 };
        let z = size.z + plate.z * 0.8;
        let frame = a.at.moved(x, 0.0, z);
        a.within(frame, |a| {
            a.lathe(
                24,
                &[Section::new(
                    &[[0.0, tall], [r * 0.9, tall], [r, tall - 0.0008], [r, -0.002], [0.0, -0.002]],
                    trim,
                )],
            )
        });
    }
    if dice.chance(0.4) {
        let strap = style.turned(1).patterned(a, dice, [0.01, 0.2]);
        let (x, z) = (size.x * 0.5, size.z * 0.9);
        let path = crate::objects::shape::path_through(
            &[
                v(-x, 0.0, z),
                v(-x * 1.2, 0.01, z * 1.3),
                v(-x * 0.4, 0.03, z * 1.9),
                v(x * 0.5, 0.02, z * 1.8),
                v(x * 1.25, 0.0, z * 1.4),
                v(x, 0.0, z),
            ],
            60,
        );
        a.tube_along(&path, 8, V::y(), strap, |_| [0.005, 0.0008]);
    }
}

fn radio(a: &mut Assembly, dice: &mut Dice, style: &Style) {
    let size = v(dice.range(0.09, 0.15), dice.range(0.03, 0.06), dice.range(0.06, 0.1));
    let faces: [crate::objects::paint::Painter; 6] = std::array::from_fn(|k| {
        let detail = if k == 0 { style.detail } else { style.detail * 0.3 };
        let size = if k % 2 == 0 { [size.x, size.z] } else { [size.y, size.z] };
        crate::objects::paint::plain_or_pattern(dice, size, &style.palette, detail)
    });
    let painter =
        crate::objects::paint::aged(dice, [size.x, size.z], style.wear, crate::objects::paint::atlas(faces));
    let body = a.paint((1536, 1024), painter);
    let frame = a.at.moved(0.0, 0.0, size.z * 0.5);
    a.within(frame, |a| a.rounded_box(size, dice.range(0.002, 0.015), 4, ATLAS, body));
    let front = a.at.turned(0, 0.25);
    let (x, r) = (size.x * dice.pick(&[-0.24, 0.24]), size.z * dice.range(0.25, 0.38));
    let before = std::mem::replace(&mut a.at, front);
    // Front: x to the right, y up, z out, from the front's plane.
    let mut speaker_at = a.at.moved(x, size.z * 0.45, size.y * 0.5);
    let dots = dice.range(14.0, 40.0) as f32;
    let (dark, light) = (style.palette.dark, style.palette.light);
    let grille = a.paint(
        (512, 512),
        Box::new(move |u, v| {
            let (x, y) = ((u * dots).rem_euclid(1.0) - 0.5, (v * dots).rem_euclid(1.0) - 0.5);
            if x * x + y * y < 0.1 { dark } else { light }
        }),
    );
    a.within(speaker_at, |a| a.extrude(&circle([r, r], 40), 0.003, 0.001, grille, grille));
    speaker_at = a.at.moved(-x * 0.9, size.z * 0.68, size.y * 0.5 - 0.0005);
    let dial = screen(a, dice, [size.x * 0.38, size.z * 0.22], style.detail);
    a.within(speaker_at, |a| {
        a.extrude(&rounded_rectangle([size.x * 0.19, size.z * 0.11], 0.002, 3), 0.0025, 0.0006, dial, dial)
    });
    let knob = style.turned(2).plain(a, dice, [0.03, 0.01]);
    for k in 0..dice.int(1, 5) {
        let kr = dice.range(0.004, 0.009);
        let frame =
            a.at.moved(-x * 0.9 - size.x * 0.15 + 0.02 * f64::from(k), size.z * 0.28, size.y * 0.5 - 0.001);
        a.within(frame, |a| {
            a.lathe(
                24,
                &[Section::new(
                    &[[0.0, 0.009], [kr * 0.85, 0.009], [kr, 0.007], [kr, 0.0], [0.0, 0.0]],
                    knob,
                )],
            )
        });
    }
    a.at = before;
    let metal = a.plain([0.75, 0.76, 0.78]);
    if dice.chance(0.6) {
        let lean = dice.range(-0.06, 0.06);
        let top = v(size.x * 0.4 + lean, size.y * 0.2, size.z + dice.range(0.05, 0.1));
        let foot = v(size.x * 0.4, size.y * 0.2, size.z - 0.003);
        a.tube(&[foot, top], 8, 0.0013, metal);
        a.ellipsoid(top, V::repeat(0.0025), 8, metal);
    }
    if dice.chance(0.5) {
        let path = crate::objects::shape::path_through(
            &[
                v(-size.x * 0.42, 0.0, size.z - 0.002),
                v(-size.x * 0.4, 0.0, size.z + 0.02),
                v(size.x * 0.36, 0.0, size.z + 0.02),
                v(size.x * 0.38, 0.0, size.z - 0.002),
            ],
            40,
        );
        a.tube_along(&path, 12, V::y(), knob, |_| [0.006, 0.0025]);
    }
}

//! Bottles, jars and flasks with caps and labels.

use super::style::Style;
use super::vessel::CrossSection;
use crate::objects::dice::Dice;
use crate::objects::exact::circumference;
use crate::objects::frame::{V, v};
use crate::objects::paint::ribbed;
use crate::objects::shape::{Assembly, Section, path_through, rounded};

pub(super) fn make(dice: &mut Dice) -> Assembly {
    let mut a = Assembly::new();
    let style = Style::draw(dice);
    let (r, height) = (dice.range(0.02, 0.045), dice.range(0.07, 0.24));
    let (neck, shoulder) = (r * dice.range(0.28, 0.9), height * dice.range(0.5, 0.88));
    let waist = r * if dice.chance(0.4) { dice.range(0.75, 0.98) } else { 1.0 };
    let section = CrossSection::draw(dice);
    let slope = dice.range(0.15, 0.9);
    let neck_z = shoulder + (height - shoulder) * slope;
    let foot = r * dice.range(0.8, 0.98);
    let body = rounded(
        &[
            [neck, height],
            [neck, neck_z],
            [r, shoulder],
            [waist, shoulder * 0.55],
            [r, shoulder * 0.15],
            [r, 0.006],
            [foot, 0.0],
        ],
        3,
    );
    let size = [circumference(r), height];
    let skin = Style { detail: style.detail * 0.5, ..style }.surface(&mut a, dice, size);
    let mut profile = vec![[0.0, height]];
    profile.extend(&body);
    profile.extend([[foot * 0.8, 0.003], [0.0, 0.004]]);
    a.lathe_bent(section.around(), &[Section::new(&profile, skin)], |p| section.bend(p));
    if dice.chance(0.85) {
        label(&mut a, dice, &style, &body, shoulder, section);
    }
    closure(&mut a, dice, &style, neck, height);
    if dice.chance(0.15) {
        grip(&mut a, dice, &style, r, shoulder, height, neck);
    }
    a
}

/// A label a hair outside the body, once around.
fn label(
    a: &mut Assembly,
    dice: &mut Dice,
    style: &Style,
    body: &[[f64; 2]],
    shoulder: f64,
    section: CrossSection,
) {
    let (low, high) = (shoulder * dice.range(0.08, 0.3), shoulder * dice.range(0.6, 0.95));
    let radius = |z: f64| {
        let below = body.windows(2).find(|pair| z <= pair[0][1] && z >= pair[1][1]);
        below.map_or(0.0, |pair| {
            let t = (pair[0][1] - z) / (pair[0][1] - pair[1][1]).max(1e-9);
            pair[0][0] + (pair[1][0] - pair[0][0]) * t
        })
    };
    let widest = body.iter().fold(0.0, |m: f64, p| m.max(p[0]));
    let paint = style.turned(dice.int(0, 4)).print(a, dice, [circumference(widest), high - low]);
    let mut profile: Vec<[f64; 2]> = (0..=16)
        .map(|i| {
            let z = high + (low - high) * f64::from(i) / 16.0;
            [radius(z) + 0.0004, z]
        })
        .collect();
    // Closed behind, inside the body, where nobody sees it.
    let (top, bottom) = ([radius(high) - 0.002, high], [radius(low) - 0.002, low]);
    let outside = profile.clone();
    profile = vec![outside[16], bottom, top, outside[0]];
    a.lathe_bent(section.around(), &[Section::new(&outside, paint), Section::new(&profile, paint)], |p| {
        section.bend(p)
    });
}

fn closure(a: &mut Assembly, dice: &mut Dice, style: &Style, neck: f64, height: f64) {
    let color = style.palette.any(dice);
    let tall = dice.range(0.008, 0.03);
    let wide = neck * dice.range(1.03, 1.3);
    let z = height - dice.range(0.2, 0.6) * tall;
    match dice.int(0, 5) {
        0 => {
            // A cork.
            let cork = style.turned(1).surface(a, dice, [circumference(neck), 0.03]);
            let r = neck * 0.8;
            a.lathe(
                40,
                &[Section::new(
                    &[
                        [0.0, height + 0.014],
                        [r, height + 0.013],
                        [r * 0.9, height - 0.008],
                        [0.0, height - 0.008],
                    ],
                    cork,
                )],
            );
        }
        1 => {
            // A pump with a spout.
            let paint = a.plain(color);
            a.lathe(40, &[Section::new(&[[0.0, z + tall], [wide, z + tall], [wide, z], [0.0, z]], paint)]);
            let top = z + tall + dice.range(0.012, 0.035);
            a.tube(&[v(0.0, 0.0, z), v(0.0, 0.0, top)], 12, 0.003, paint);
            let (reach, drop) = (neck + dice.range(0.01, 0.03), dice.range(0.0, 0.01));
            let spout = path_through(
                &[v(0.004, 0.0, top), v(-reach * 0.7, 0.0, top + 0.002), v(-reach, 0.0, top - drop)],
                20,
            );
            a.tube_along(&spout, 12, V::y(), paint, |t| [0.008 - 0.005 * t, 0.0035 - 0.001 * t]);
        }
        2 => {
            // A stopper ball.
            let paint = style.turned(2).surface(a, dice, [0.06, 0.03]);
            let r = neck * dice.range(0.9, 1.4);
            a.ellipsoid(v(0.0, 0.0, height + r * 0.8), V::repeat(r), 20, paint);
        }
        _ => {
            let ridges = dice.int(16, 60);
            let depth = if dice.chance(0.7) { 0.5 } else { 0.0 };
            let paint = a.paint((512, 32), ribbed(color, ridges, depth));
            let lid = style.print(a, dice, [2.0 * wide, 2.0 * wide]);
            let top = z + tall;
            a.part(true, |a| {
                let ring = |r: f64, z: f64| {
                    crate::objects::shape::circle([r, r], 48)
                        .iter()
                        .map(|[x, y]| v(*x, *y, z))
                        .collect::<Vec<V>>()
                };
                let rings = vec![
                    ring(wide * 0.94, top),
                    ring(wide, top - 0.0015),
                    ring(wide, z),
                    ring(neck * 0.9, z),
                ];
                a.skin(&rings, true, crate::objects::shape::WHOLE, paint);
                a.fan(&rings[0], true, crate::objects::shape::WHOLE, lid);
                a.fan(&rings[3], false, crate::objects::shape::WHOLE, paint);
            });
        }
    }
}

/// A handle from the shoulder to the body, as on jugs.
fn grip(a: &mut Assembly, dice: &mut Dice, style: &Style, r: f64, shoulder: f64, height: f64, neck: f64) {
    let paint = style.turned(1).plain(a, dice, [0.02, 0.1]);
    let out = r + dice.range(0.012, 0.03);
    let knots = [
        v(neck * 0.7, 0.0, height * 0.93),
        v(out, 0.0, height * 0.9),
        v(out, 0.0, shoulder * 0.7),
        v(r * 0.8, 0.0, shoulder * 0.45),
    ];
    let path = path_through(&knots, 32);
    let half = [dice.range(0.003, 0.007), dice.range(0.002, 0.004)];
    let frame = a.at.turned(2, dice.unit());
    a.within(frame, |a| a.tube_along(&path, 14, V::y(), paint, |_| half));
}

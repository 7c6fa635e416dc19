//! Cans: spray cans, food tins, drink cans, drums, paint pots.

use super::style::Style;
use crate::objects::dice::Dice;
use crate::objects::exact::{circumference, cos_turns, sin_turns};
use crate::objects::frame::{V, v};
use crate::objects::paint::{brushed_metal, texels};
use crate::objects::shape::{Assembly, SAME_EACH, Section, path_through, rounded};

pub(super) fn make(dice: &mut Dice) -> Assembly {
    let mut a = Assembly::new();
    let style = Style::draw(dice);
    let r = dice.range(0.018, 0.045);
    let height = r * dice.range(1.4, 5.0);
    let size = [circumference(r), height];
    let print = style.print(&mut a, dice, size);
    let metal = brushed_metal(dice, [r, r]);
    let metal = a.paint(texels([2.0 * r, 2.0 * r]), metal);
    match dice.int(0, 3) {
        0 => spray(&mut a, dice, &style, [r, height], print, metal),
        1 => tin(&mut a, dice, [r, height], print, metal),
        2 => drink(&mut a, dice, [r, height], print, metal),
        _ => bucket(&mut a, dice, &style, [r * 1.4, height.min(r * 3.0)], print, metal),
    }
    a
}

fn spray(a: &mut Assembly, dice: &mut Dice, style: &Style, [r, h]: [f64; 2], print: u32, metal: u32) {
    let body = [[r, h], [r, 0.004]];
    let rim = r * 1.03;
    let below = [[r, 0.004], [rim, 0.003], [rim, 0.0], [r * 0.9, 0.0], [0.0, 0.004]];
    let neck = r * dice.range(0.35, 0.7);
    let shoulder = rounded(&[[neck, h + r * 0.6], [r * 0.85, h + r * 0.35], [r, h]], 2);
    let mut top = vec![[0.0, h + r * 0.6]];
    top.extend(shoulder);
    a.lathe(64, &[Section::new(&top, metal), Section::new(&body, print), Section::new(&below, metal)]);
    let cap = style.turned(dice.int(0, 3)).plain(a, dice, [0.05, 0.03]);
    let z = h + r * 0.6;
    if dice.chance(0.5) {
        let wide = r * dice.range(0.85, 1.0);
        let tall = r * dice.range(0.8, 1.6);
        let low = h + r * 0.1;
        let profile = rounded(
            &[
                [0.0, low + tall],
                [wide * 0.9, low + tall],
                [wide, low + tall * 0.85],
                [wide, low],
                [0.0, low],
            ],
            1,
        );
        a.lathe(48, &[Section::new(&profile, cap)]);
    } else {
        let (kr, tall) = (neck * 0.7, r * 0.5);
        a.lathe(
            32,
            &[Section::new(
                &[
                    [0.0, z + tall],
                    [kr * 0.8, z + tall],
                    [kr, z + tall * 0.6],
                    [kr, z - 0.002],
                    [0.0, z - 0.002],
                ],
                cap,
            )],
        );
        let nozzle = a.plain([0.1; 3]);
        a.tube(
            &[v(0.0, -kr * 0.5, z + tall * 0.5), v(0.0, -kr * 1.15, z + tall * 0.5)],
            10,
            kr * 0.18,
            nozzle,
        );
    }
}

/// A food tin with ribs and a lid that may stand open.
fn tin(a: &mut Assembly, dice: &mut Dice, [r, h]: [f64; 2], print: u32, metal: u32) {
    let (ribs, depth) = (dice.int(0, 14), dice.range(0.0004, 0.0014));
    let label = dice.chance(0.6);
    let side: Vec<[f64; 2]> = (0..=120)
        .map(|i| {
            let t = f64::from(i) / 120.0;
            let within = (0.15..0.85).contains(&t) && ribs > 0 && !label;
            let rib = if within {
                depth * (0.5 + 0.5 * cos_turns((t - 0.15) / 0.7 * f64::from(ribs)))
            } else {
                0.0
            };
            [r - rib, h * (1.0 - t) + 0.002 * (2.0 * t - 1.0)]
        })
        .collect();
    let (low, high) = (side[120], side[0]);
    let open = dice.chance(0.4);
    let inside = if open { 0.004 } else { h - 0.003 };
    let top = [
        [0.0, inside],
        [r - 0.001, inside],
        [r - 0.001, h],
        [r * 1.03, h + 0.0005],
        [r * 1.03, h - 0.002],
        high,
    ];
    let below = [low, [r * 1.03, 0.0022], [r * 1.03, 0.0], [r * 0.95, 0.0], [r * 0.93, 0.002], [0.0, 0.002]];
    let skin = if label || dice.chance(0.5) { print } else { metal };
    a.lathe(64, &[Section::new(&top, metal), Section::new(&side, skin), Section::new(&below, metal)]);
    if open {
        let frame = a.at.moved(0.0, r, h).turned(0, dice.range(0.1, 0.3)).moved(0.0, -r, 0.0);
        let lid = rounded(&[[0.0, 0.0012], [r * 0.95, 0.0012], [r * 0.95, 0.0], [0.0, 0.0]], 1);
        a.within(frame, |a| a.lathe(56, &[Section::new(&lid, metal)]));
    } else if dice.chance(0.5) {
        ring_pull(a, v(0.0, -r * 0.5, h - 0.0015), r * 0.3, metal);
    }
}

fn ring_pull(a: &mut Assembly, at: V, r: f64, metal: u32) {
    let path: Vec<V> = (0..32)
        .map(|i| f64::from(i) / 32.0)
        .map(|t| at + v(r * 0.7 * cos_turns(t), r * sin_turns(t), 0.0008))
        .collect();
    a.ring_along(&path, 8, [0.0012, 0.0008], 0.0, metal);
}

fn drink(a: &mut Assembly, dice: &mut Dice, [r, h]: [f64; 2], print: u32, metal: u32) {
    let neck = r * dice.range(0.78, 0.9);
    let top = [
        [0.0, h - 0.003],
        [neck * 0.9, h - 0.003],
        [neck * 0.93, h],
        [neck, h - 0.001],
        [neck * 0.96, h - 0.004],
    ];
    let shoulder = h - r * dice.range(0.3, 0.6);
    let dent = if dice.chance(0.3) { dice.range(0.05, 0.2) } else { 0.0 };
    let mut side = rounded(&[[neck * 0.96, h - 0.004], [r, shoulder], [r, shoulder - 0.004]], 2);
    let low = r * 0.35;
    side.extend((1..=24).map(|i| [r, shoulder - 0.004 + (low - shoulder + 0.004) * f64::from(i) / 24.0]));
    let below = rounded(
        &[[r, low], [r * 0.95, r * 0.12], [r * 0.75, 0.0], [r * 0.65, 0.0], [r * 0.4, 0.006], [0.0, 0.008]],
        2,
    );
    let turns = dice.unit();
    a.lathe_bent(
        64,
        &[Section::new(&top, metal), Section::new(&side, print), Section::new(&below, metal)],
        |p| {
            // A dent from one side at half height.
            let (c, s) = (cos_turns(turns), sin_turns(turns));
            let facing = (p.x * c + p.y * s) / r;
            let near = 1.0 - ((p.z - h * 0.5) / (h * 0.25)) * ((p.z - h * 0.5) / (h * 0.25));
            let push = dent * r * facing.max(0.0) * facing.max(0.0) * near.max(0.0);
            v(p.x - c * push, p.y - s * push, p.z)
        },
    );
    ring_pull(a, v(0.0, -neck * 0.3, h - 0.0025), neck * 0.32, metal);
}

/// A bucket or paint pot with a bail.
fn bucket(a: &mut Assembly, dice: &mut Dice, style: &Style, [r, h]: [f64; 2], print: u32, metal: u32) {
    let foot = r * dice.range(0.7, 1.0);
    let wall = 0.0015;
    let inner = [[0.0, wall], [foot - wall, wall], [r - wall, h]];
    let rim = [[r - wall, h], [r, h + 0.001], [r * 1.05, h], [r * 1.05, h - 0.004], [r, h - 0.005]];
    let outer = [[r, h - 0.005], [0.5 * (r + foot), h * 0.5], [foot, 0.0]];
    let below = [[foot, 0.0], [0.0, 0.0]];
    a.lathe(
        64,
        &[
            Section::new(&inner, metal),
            Section::new(&rim, metal),
            Section::new(&outer, print),
            Section::new(&below, metal),
        ],
    );
    let lift = dice.range(-0.2, 0.25);
    let path: Vec<V> = (0..=40)
        .map(|i| {
            let t = 0.5 * f64::from(i) / 40.0;
            let (c, s) = (r * 1.05 * cos_turns(t), r * 1.05 * sin_turns(t));
            v(c, s * cos_turns(lift), h - 0.008 + s * sin_turns(lift))
        })
        .collect();
    a.tube(&path, 8, 0.0012, metal);
    if dice.chance(0.6) {
        let level = h * dice.range(0.3, 0.9);
        let wide = foot + (r - foot) * level / h - wall * 0.5;
        let paint = style.turned(2).surface(a, dice, [2.0 * r, 2.0 * r]);
        a.lathe(
            56,
            &[Section::new(
                &[
                    [0.0, level],
                    [wide * 0.5, level],
                    [wide, level],
                    [wide * 0.98, level - 0.004],
                    [0.0, level - 0.004],
                ],
                paint,
            )],
        );
        if dice.chance(0.5) {
            let stick = style.turned(1).plain(a, dice, [0.02, 0.1]);
            let frame =
                a.at.moved(r * 0.2, 0.0, h * 0.5 + 0.02)
                    .turned(1, dice.range(0.03, 0.09))
                    .turned(2, dice.unit());
            a.within(frame, |a| a.rounded_box(v(0.006, 0.016, h * 1.2), 0.001, 1, SAME_EACH, stick));
        }
    } else if dice.chance(0.5) {
        let knots = [v(-r * 0.5, 0.0, h * 0.1 + 0.004), v(r * 0.1, 0.0, h * 0.6), v(r * 0.6, 0.0, h * 1.5)];
        let tool = style.turned(1).plain(a, dice, [0.02, 0.1]);
        a.tube(&path_through(&knots, 20), 12, 0.004, tool);
    }
}

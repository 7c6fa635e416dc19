//! Lamps: desk lamps with joints, standing lamps with shades, lanterns.

use super::style::Style;
use super::vessel::CrossSection;
use crate::objects::dice::Dice;
use crate::objects::exact::{circumference, cos_turns, sin_turns};
use crate::objects::frame::{V, v};
use crate::objects::paint::{brushed_metal, texels};
use crate::objects::shape::{Assembly, SAME_EACH, Section, path_through, rounded};

pub(super) fn make(dice: &mut Dice) -> Assembly {
    let mut a = Assembly::new();
    let style = Style::draw(dice);
    let metal = if dice.chance(0.5) {
        let painter = brushed_metal(dice, [0.05, 0.1]);
        a.paint(texels([0.05, 0.1]), painter)
    } else {
        style.turned(1).plain(&mut a, dice, [0.05, 0.1])
    };
    match dice.int(0, 3) {
        0 | 1 => desk_lamp(&mut a, dice, &style, metal),
        2 => table_lamp(&mut a, dice, &style, metal),
        _ => lantern(&mut a, dice, &style, metal),
    }
    a
}

/// A hollow shade about z, its wide end below at z = 0.
fn shade(a: &mut Assembly, dice: &mut Dice, style: &Style, [top, bottom, height]: [f64; 3]) {
    let belly = dice.range(0.85, 1.3);
    let outer = rounded(&[[top, height], [0.5 * (top + bottom) * belly, height * 0.5], [bottom, 0.0]], 3);
    let wall = 0.0016;
    let mut inner: Vec<[f64; 2]> = outer.iter().rev().map(|[r, z]| [r - wall, *z]).collect();
    inner.extend(outer.first());
    let section = CrossSection::draw(dice);
    let outside = style.surface(a, dice, [circumference(bottom), height]);
    let inside = a.plain([0.95, 0.93, 0.85]);
    let rim = [outer[outer.len() - 1], inner[0]];
    a.lathe_bent(
        section.around(),
        &[Section::new(&outer, outside), Section::new(&rim, inside), Section::new(&inner, inside)],
        |p| section.bend(p),
    );
}

fn base(a: &mut Assembly, dice: &mut Dice, r: f64, metal: u32) -> f64 {
    let height = dice.range(0.006, 0.02);
    if dice.chance(0.25) {
        let frame = a.at.moved(0.0, 0.0, height / 2.0);
        a.within(frame, |a| a.rounded_box(v(1.8 * r, 1.8 * r, height), 0.003, 3, SAME_EACH, metal));
    } else {
        let profile =
            rounded(&[[0.0, height], [r * 0.5, height], [r, height * 0.4], [r, 0.0], [0.0, 0.0]], 2);
        a.lathe(56, &[Section::new(&profile, metal)]);
    }
    height
}

fn bulb(a: &mut Assembly, at: V, r: f64) {
    let glass = a.plain([0.99, 0.96, 0.85]);
    a.ellipsoid(at, v(r, r, r * 1.2), 14, glass);
}

fn desk_lamp(a: &mut Assembly, dice: &mut Dice, style: &Style, metal: u32) {
    let wide = dice.range(0.03, 0.055);
    let height = base(a, dice, wide, metal);
    let (lower, upper) = (dice.range(0.06, 0.13), dice.range(0.05, 0.12));
    let (lean, bend) = (dice.range(-0.04, 0.1), dice.range(0.1, 0.24));
    let elbow = v(0.0, lower * sin_turns(lean), height + lower * cos_turns(lean));
    let end = elbow + v(0.0, -upper * sin_turns(bend), upper * cos_turns(bend));
    let r = dice.range(0.0018, 0.004);
    let twin = if dice.chance(0.5) { dice.range(0.004, 0.008) } else { 0.0 };
    if dice.chance(0.3) {
        // A goose neck instead of joints.
        let path = path_through(&[v(0.0, 0.0, height - 0.002), v(0.0, 0.01, height + lower), end], 48);
        a.tube(&path, 12, r * 1.3, metal);
    } else {
        for x in if twin > 0.0 { vec![-twin, twin] } else { vec![0.0] } {
            let side = v(x, 0.0, 0.0);
            a.tube(&[v(0.0, 0.0, height - 0.002) + side, elbow + side], 10, r, metal);
            a.tube(&[elbow + side, end + side], 10, r, metal);
        }
        for at in [v(0.0, 0.0, height), elbow, end] {
            let wide = twin + r * 2.0;
            a.tube(&[at - v(wide, 0.0, 0.0), at + v(wide, 0.0, 0.0)], 14, r * 1.8, metal);
        }
        if dice.chance(0.4) {
            spring(a, elbow * 0.3, elbow, r, metal);
        }
    }
    let size = dice.range(0.022, 0.04);
    let tilt = dice.range(-0.02, 0.12);
    let measures = [size * dice.range(0.25, 0.6), size, size * dice.range(1.1, 1.6)];
    let frame = a.at.moved(end.x, end.y, end.z).turned(0, -tilt).moved(0.0, -size * 0.2, -size * 1.2);
    a.within(frame, |a| {
        shade(a, dice, style, measures);
        bulb(a, v(0.0, 0.0, size * 0.45), size * 0.4);
        a.tube(&[v(0.0, 0.0, size * 0.5), v(0.0, 0.0, size * 1.55)], 12, size * 0.22, metal);
    });
    if dice.chance(0.5) {
        let knots: Vec<V> =
            (0..5).map(|k| v(dice.around_zero(0.02), 0.03 + 0.022 * f64::from(k), 0.0025)).collect();
        let cable = a.plain(style.palette.dark);
        a.tube(&path_through(&knots, 40), 8, 0.0015, cable);
    }
}

fn spring(a: &mut Assembly, from: V, to: V, r: f64, metal: u32) {
    let along = to - from;
    let path: Vec<V> = (0..=160)
        .map(|i| {
            let t = f64::from(i) / 160.0;
            let turn = t * 14.0;
            from + along * t + v(cos_turns(turn), 0.4 * sin_turns(turn), 0.0) * (r * 1.6)
        })
        .collect();
    a.tube(&path, 5, r * 0.3, metal);
}

fn table_lamp(a: &mut Assembly, dice: &mut Dice, style: &Style, metal: u32) {
    let (r, tall) = (dice.range(0.018, 0.045), dice.range(0.06, 0.14));
    let mut points = vec![[r * 0.2, tall]];
    for k in 1..dice.int(3, 6) {
        points.push([r * dice.range(0.25, 1.1), tall * (1.0 - f64::from(k) * 0.17)]);
    }
    points.extend([[r, 0.006], [r, 0.0]]);
    let mut profile = vec![[0.0, tall]];
    profile.extend(rounded(&points, 3));
    profile.push([0.0, 0.0]);
    let section = CrossSection::draw(dice);
    let body = style.turned(2).surface(a, dice, [circumference(r), tall]);
    a.lathe_bent(section.around(), &[Section::new(&profile, body)], |p| section.bend(p));
    let (wide, high) = (dice.range(0.04, 0.07), dice.range(0.03, 0.07));
    a.tube(&[v(0.0, 0.0, tall - 0.003), v(0.0, 0.0, tall + high * 0.6)], 10, 0.003, metal);
    bulb(a, v(0.0, 0.0, tall + high * 0.55), 0.012);
    let narrow = wide * dice.range(0.35, 1.0);
    let frame = a.at.moved(0.0, 0.0, tall + 0.002);
    a.within(frame, |a| shade(a, dice, style, [narrow, wide, high]));
}

fn lantern(a: &mut Assembly, dice: &mut Dice, style: &Style, metal: u32) {
    let (r, tall) = (dice.range(0.03, 0.05), dice.range(0.06, 0.12));
    let height = base(a, dice, r * 1.1, metal);
    let posts = dice.int(4, 10);
    for k in 0..posts {
        let turns = f64::from(k) / f64::from(posts);
        let (x, y) = (r * 0.92 * cos_turns(turns), r * 0.92 * sin_turns(turns));
        let bow = 1.0 + dice.range(0.0, 0.01);
        let path = path_through(
            &[v(x, y, height * 0.5), v(x * bow, y * bow, height + tall * 0.5), v(x, y, height + tall)],
            12,
        );
        a.tube(&path, 8, 0.0018, metal);
    }
    let rings = dice.int(0, 4);
    for k in 0..rings {
        let z = height + tall * (f64::from(k) + 0.5) / f64::from(rings);
        let path: Vec<V> = (0..48)
            .map(|i| f64::from(i) / 48.0)
            .map(|t| v(r * 0.92 * cos_turns(t), r * 0.92 * sin_turns(t), z))
            .collect();
        a.ring_along(&path, 6, [0.0012, 0.0012], 0.0, metal);
    }
    let wax = style.surface(a, dice, [circumference(r * 0.45), tall * 0.6]);
    let candle = tall * dice.range(0.3, 0.8);
    a.lathe(
        36,
        &[Section::new(
            &[
                [0.0, height + candle],
                [r * 0.42, height + candle + 0.001],
                [r * 0.45, height + candle - 0.002],
                [r * 0.45, height * 0.5],
                [0.0, height * 0.5],
            ],
            wax,
        )],
    );
    let flame = a.plain([1.0, 0.75, 0.25]);
    a.ellipsoid(v(0.0, 0.0, height + candle + 0.01), v(0.004, 0.004, 0.01), 10, flame);
    let roof = dice.range(0.012, 0.04);
    let top = height + tall;
    let profile = rounded(
        &[
            [0.0, top + roof],
            [r * 0.25, top + roof * 0.9],
            [r * 1.15, top + 0.003],
            [r * 1.15, top],
            [0.0, top + 0.001],
        ],
        2,
    );
    let tiles = style.turned(1).surface(a, dice, [circumference(r), roof]);
    a.lathe(48, &[Section::new(&profile, tiles)]);
    let hoop = r * 0.45;
    let path: Vec<V> = (0..40)
        .map(|i| f64::from(i) / 40.0)
        .map(|t| v(hoop * cos_turns(t), 0.0, top + roof + hoop * 0.9 + hoop * sin_turns(t)))
        .collect();
    a.ring_along(&path, 8, [0.0015, 0.0015], 0.0, metal);
}

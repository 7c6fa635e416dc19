//! Bowls, pans, pots with lids, colanders, with or without something in them.

use super::fruit::one_fruit;
use super::style::Style;
use super::vessel::{CrossSection, Vessel};
use crate::objects::dice::Dice;
use crate::objects::exact::{circumference, cos_turns, sin_turns};
use crate::objects::frame::{Frame, V, v};
use crate::objects::paint::{brushed_metal, texels, wood};
use crate::objects::shape::{Assembly, Section, path_through};

pub(super) fn make(dice: &mut Dice) -> Assembly {
    let mut a = Assembly::new();
    let style = Style::draw(dice);
    let r = dice.range(0.05, 0.1);
    let pan = dice.chance(0.4);
    let height = if pan { dice.range(0.02, 0.08) } else { r * dice.range(0.3, 1.0) };
    let foot = r * if pan { dice.range(0.75, 0.95) } else { dice.range(0.3, 0.7) };
    let bulge = r * dice.range(0.8, 1.05);
    let points = [
        [r, height],
        [bulge, height * 0.6],
        [(foot + bulge) * 0.5, height * 0.15],
        [foot, 0.003],
        [foot, 0.0],
    ];
    let section = if pan { CrossSection::Round } else { CrossSection::draw(dice) };
    let vessel = Vessel::through(&points, dice.range(0.002, 0.005), section);
    let size = [circumference(r), height * 1.4];
    let material = dice.int(0, 3);
    let outside = match material {
        0 if pan => metal(&mut a, dice, &style, size),
        1 => {
            let painter = wood(dice, size);
            style.worn(&mut a, dice, size, painter)
        }
        _ => style.surface(&mut a, dice, size),
    };
    let inside = match dice.int(0, 2) {
        0 => outside,
        1 => style.turned(3).surface(&mut a, dice, size),
        _ => style.turned(dice.int(0, 4)).plain(&mut a, dice, size),
    };
    vessel.add(&mut a, outside, inside);
    if pan {
        handles(&mut a, dice, &style, &vessel);
    }
    match dice.int(0, 5) {
        0 | 1 => contents(&mut a, dice, &vessel),
        2 => {
            let soup = style.turned(2).patterned(&mut a, dice, [2.0 * r; 2]);
            vessel.fill(&mut a, height * 0.7, 0.0, soup);
        }
        3 if pan => lid(&mut a, dice, &style, &vessel),
        _ => {}
    }
    a
}

fn metal(a: &mut Assembly, dice: &mut Dice, style: &Style, size: [f64; 2]) -> u32 {
    let painter = brushed_metal(dice, size);
    style.worn(a, dice, size, painter)
}

fn handles(a: &mut Assembly, dice: &mut Dice, style: &Style, vessel: &Vessel) {
    let grip = style.turned(4).surface(a, dice, [0.03, 0.1]);
    let steel = brushed_metal(dice, [0.03, 0.1]);
    let steel = a.paint(texels([0.03, 0.1]), steel);
    let z = vessel.height() * 0.8;
    let at = vessel.radius_at(z) - vessel.wall * 0.5;
    if dice.chance(0.6) {
        let (length, rise) = (dice.range(0.08, 0.17), dice.range(-0.01, 0.04));
        let path = path_through(
            &[v(at, 0.0, z), v(at + 0.02, 0.0, z + rise * 0.3), v(at + length, 0.0, z + rise)],
            24,
        );
        a.tube_along(&path[..8], 14, V::y(), steel, |_| [0.004, 0.0025]);
        let (wide, thick) = (dice.range(0.005, 0.01), dice.range(0.003, 0.006));
        a.tube_along(&path[6..], 16, V::y(), grip, |t| [wide * (0.75 + 0.25 * t), thick]);
    } else {
        for side in [0.0, 0.5] {
            let frame = a.at.turned(2, side);
            let (wide, out) = (dice.range(0.015, 0.03), 0.018);
            let path = path_through(
                &[
                    v(at, -wide, z),
                    v(at + out, -wide * 0.9, z + 0.002),
                    v(at + out, wide * 0.9, z + 0.002),
                    v(at, wide, z),
                ],
                28,
            );
            a.within(frame, |a| a.tube(&path, 12, 0.0035, grip));
        }
    }
}

fn lid(a: &mut Assembly, dice: &mut Dice, style: &Style, vessel: &Vessel) {
    let (r, z) = (vessel.widest() * 1.01, vessel.height() + vessel.wall * 0.5);
    let dome = dice.range(0.004, 0.03);
    let paint = style.turned(1).surface(a, dice, [circumference(r), r]);
    let mut profile = vec![[0.0, z + dome]];
    profile.extend((1..=12).map(|i| {
        let t = f64::from(i) / 12.0;
        [r * t, z + dome * (1.0 - t * t) + 0.001]
    }));
    profile.extend([[r, z - 0.001], [0.0, z - 0.0005]]);
    a.lathe(72, &[Section::new(&profile, paint)]);
    let knob = style.turned(4).plain(a, dice, [0.04, 0.02]);
    let k = dice.range(0.006, 0.012);
    let top = z + dome;
    a.lathe(
        32,
        &[Section::new(
            &[
                [0.0, top + k * 2.0],
                [k, top + k * 1.8],
                [k, top + k * 1.2],
                [k * 0.4, top + k * 0.7],
                [k * 0.5, top - 0.003],
                [0.0, top - 0.003],
            ],
            knob,
        )],
    );
}

/// Fruit, balls or sticks piled inside.
fn contents(a: &mut Assembly, dice: &mut Dice, vessel: &Vessel) {
    let kind = dice.int(0, 9);
    let seed_of_kind = u64::from(dice.seed());
    let size = vessel.widest() * dice.range(0.16, 0.36);
    let count = dice.int(3, 12);
    for i in 0..count {
        let mut own = Dice::of("content", seed_of_kind + if kind < 6 { 0 } else { u64::from(i) });
        let fruit = one_fruit(&mut own, size);
        let ring = if i < 6 { 0.45 } else { 0.2 };
        let turns = f64::from(i) * 0.382;
        let z = vessel.height() * 0.35 + size * 0.6 + if i < 6 { 0.0 } else { size * 1.2 };
        let frame = Frame::identity()
            .moved(vessel.widest() * ring * cos_turns(turns), vessel.widest() * ring * sin_turns(turns), z)
            .turned(dice.int(0, 2) as usize, dice.unit());
        a.add(fruit, frame);
    }
}

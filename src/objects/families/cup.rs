//! Mugs, cups, tumblers, jugs.

use super::style::Style;
use super::vessel::{CrossSection, Vessel};
use crate::objects::dice::Dice;
use crate::objects::exact::{circumference, cos_turns, sin_turns};
use crate::objects::frame::{V, v};
use crate::objects::paint::{bands, pattern};
use crate::objects::shape::{Assembly, Section, path_through};

pub(super) fn make(dice: &mut Dice) -> Assembly {
    let mut a = Assembly::new();
    let style = Style::draw(dice);
    let (r, height) = (dice.range(0.028, 0.05), dice.range(0.055, 0.15));
    let (foot, belly) = (r * dice.range(0.55, 1.0), r * dice.range(0.8, 1.25));
    let lip = r * dice.range(0.97, 1.12);
    let points: Vec<[f64; 2]> = match dice.int(0, 3) {
        0 => vec![[lip, height], [r, height * 0.5], [foot, 0.004], [foot, 0.0]],
        1 => vec![[r, height], [r, height * 0.6], [r, 0.012], [r * 0.92, 0.0]],
        2 => {
            vec![[lip, height], [r * 0.95, height * 0.85], [belly, height * 0.45], [foot, 0.006], [foot, 0.0]]
        }
        _ => vec![
            [lip, height],
            [belly, height * 0.75],
            [foot * 0.7, height * 0.2],
            [foot * 0.55, height * 0.12],
            [foot, 0.003],
            [foot, 0.0],
        ],
    };
    let vessel = Vessel::through(&points, dice.range(0.0018, 0.005), CrossSection::draw(dice));
    let size = [circumference(r), height];
    let outside = if dice.chance(0.4) {
        // A decorated band between plain ones.
        let (from, to) = (dice.range(0.05, 0.4), dice.range(0.6, 0.95));
        let band = pattern(dice, [size[0], height * (to - from)], &style.palette.turned(1), style.detail);
        let (rim, base) = (style.palette.any(dice), style.palette.main);
        let painter =
            bands(vec![(from, Box::new(move |_, _| rim)), (to, band), (1.0, Box::new(move |_, _| base))]);
        style.worn(&mut a, dice, size, painter)
    } else if dice.chance(0.4) {
        style.print(&mut a, dice, size)
    } else {
        style.surface(&mut a, dice, size)
    };
    let inside = style.turned(dice.pick(&[0, 3, 3])).plain(&mut a, dice, [size[0], 0.08]);
    vessel.add(&mut a, outside, inside);
    let handles = dice.pick(&[0, 1, 1, 1, 1, 2]);
    let paint = style.turned(dice.int(0, 4)).surface(&mut a, dice, [0.02, 0.12]);
    handle(&mut a, dice, &vessel, handles, paint);
    if dice.chance(0.35) {
        let drink =
            Style { detail: style.detail * 0.5, ..style.turned(4) }.surface(&mut a, dice, [0.07, 0.04]);
        vessel.fill(&mut a, height * dice.range(0.5, 0.9), 0.0, drink);
    }
    if dice.chance(0.25) {
        saucer(&mut a, dice, &style, r);
    }
    if dice.chance(0.25) {
        spoon(&mut a, dice, &style, &vessel);
    }
    a
}

fn handle(a: &mut Assembly, dice: &mut Dice, vessel: &Vessel, count: u32, paint: u32) {
    let height = vessel.height();
    let (low, high) = (height * dice.range(0.1, 0.35), height * dice.range(0.65, 0.92));
    let out = dice.range(0.018, 0.042);
    let square = dice.range(0.0, 1.0);
    let (thick, wide) = (dice.range(0.002, 0.005), dice.range(0.003, 0.009));
    let droop = dice.range(-0.2, 0.3) * height;
    for k in 0..count {
        // Inside the wall at both ends, so that no gap shows.
        let at = |z: f64| vessel.radius_at(z) - vessel.wall * 0.5;
        let middle = 0.5 * (low + high) - droop * 0.3;
        let reach = vessel.radius_at(middle) + out;
        let corner = reach - out * (1.0 - square) * 0.5;
        let knots = [
            v(at(high), 0.0, high),
            v(corner, 0.0, high + (1.0 - square) * 0.004),
            v(reach, 0.0, middle),
            v(corner - out * 0.1, 0.0, low - droop * 0.2),
            v(at(low), 0.0, low),
        ];
        let path = path_through(&knots, 36);
        let frame = a.at.turned(2, 0.5 * f64::from(k));
        a.within(frame, |a| a.tube_along(&path, 16, V::y(), paint, |_| [wide, thick]));
    }
}

fn saucer(a: &mut Assembly, dice: &mut Dice, style: &Style, r: f64) {
    let wide = r * dice.range(1.7, 2.2);
    let paint = style.turned(dice.int(0, 2)).surface(a, dice, [circumference(wide), wide]);
    let (rise, thick) = (dice.range(0.006, 0.016), 0.003);
    let profile = [
        [0.0, -0.001],
        [wide * 0.5, -0.001],
        [wide * 0.6, 0.001],
        [wide, rise],
        [wide * 1.01, rise - 0.001],
        [wide * 0.62, 0.001 - thick],
        [wide * 0.5, -thick - 0.001],
        [0.0, -thick - 0.001],
    ];
    a.lathe(72, &[Section::new(&profile, paint)]);
}

fn spoon(a: &mut Assembly, dice: &mut Dice, style: &Style, vessel: &Vessel) {
    let paint = style.turned(3).plain(a, dice, [0.02, 0.1]);
    let (lean, turns) = (vessel.widest() * 0.75, dice.unit());
    let length = vessel.height() * dice.range(1.25, 1.6);
    let (x, y) = (lean * cos_turns(turns), lean * sin_turns(turns));
    let bottom = vessel.wall * 2.5 + 0.004;
    let path = path_through(
        &[v(-x * 0.5, -y * 0.5, bottom), v(x * 0.3, y * 0.3, length * 0.6), v(x * 1.05, y * 1.05, length)],
        20,
    );
    a.tube_along(&path, 10, v(-y, x, 0.0), paint, |t| [0.0022 + 0.003 * (t - 0.7).max(0.0) * 3.0, 0.0012]);
}

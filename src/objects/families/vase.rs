//! Vases, urns and jugs, with or without branches in them.

use super::style::Style;
use super::vessel::{CrossSection, Vessel};
use crate::objects::dice::Dice;
use crate::objects::exact::{circumference, cos_turns, sin_turns};
use crate::objects::frame::{V, v};
use crate::objects::paint::{bands, of_hue, plain_or_pattern};
use crate::objects::shape::{Assembly, path_through};

pub(super) fn make(dice: &mut Dice) -> Assembly {
    let mut a = Assembly::new();
    let style = Style::draw(dice);
    let (r, height) = (dice.range(0.025, 0.055), dice.range(0.08, 0.18));
    let mut points = vec![[r * dice.range(0.35, 1.2), height]];
    let knots = dice.int(2, 6);
    for k in 1..=knots {
        points.push([r * dice.range(0.3, 1.25), height * (1.0 - f64::from(k) / f64::from(knots + 1))]);
    }
    let foot = r * dice.range(0.45, 1.0);
    points.extend([[foot, 0.005], [foot, 0.0]]);
    let vessel = Vessel::through(&points, dice.range(0.002, 0.004), CrossSection::draw(dice));
    let size = [circumference(r), height];
    let outside = if dice.chance(0.5) {
        // Painted in bands, each with a pattern of its own.
        let mut parts = Vec::new();
        let mut at = 0.0;
        while at < 1.0 {
            let wide = dice.range(0.06, 0.4);
            let painter = plain_or_pattern(
                dice,
                [size[0], height * wide],
                &style.palette.turned(parts.len() as u32),
                style.detail,
            );
            at += wide;
            parts.push((at.min(1.0), painter));
        }
        style.worn(&mut a, dice, size, bands(parts))
    } else {
        style.surface(&mut a, dice, size)
    };
    let inside = style.turned(4).plain(&mut a, dice, [0.05, 0.1]);
    vessel.add(&mut a, outside, inside);
    let ears = dice.pick(&[0, 0, 1, 2, 2, 3]);
    for k in 0..ears {
        ear(&mut a, dice, &vessel, f64::from(k) / f64::from(ears), outside);
    }
    if dice.chance(0.35) {
        branches(&mut a, dice, &style, &vessel);
    }
    a
}

fn ear(a: &mut Assembly, dice: &mut Dice, vessel: &Vessel, turns: f64, paint: u32) {
    let (low, high) = (vessel.height() * dice.range(0.4, 0.6), vessel.height() * dice.range(0.75, 0.95));
    let at = |z: f64| vessel.radius_at(z) - vessel.wall * 0.5;
    let out = at(low).max(at(high)) + dice.range(0.008, 0.025);
    let path = path_through(
        &[
            v(at(low), 0.0, low),
            v(out, 0.0, low * 0.5 + high * 0.5),
            v(out * 0.9, 0.0, high * 1.02),
            v(at(high), 0.0, high),
        ],
        30,
    );
    let half = [dice.range(0.0025, 0.006), dice.range(0.002, 0.003)];
    let frame = a.at.turned(2, turns);
    a.within(frame, |a| a.tube_along(&path, 12, V::y(), paint, |_| half));
}

/// Dry branches with buds or berries.
fn branches(a: &mut Assembly, dice: &mut Dice, style: &Style, vessel: &Vessel) {
    let bark = a.plain(of_hue(dice.range(0.05, 0.12), 0.5, dice.range(0.2, 0.5)));
    let berry = style.turned(2).surface(a, dice, [0.02, 0.02]);
    let neck = vessel.outer.iter().fold(f64::MAX, |m, p| m.min(p[0])) - vessel.wall * 2.0;
    for k in 0..dice.int(2, 8) {
        let (turns, lean) = (f64::from(k) * 0.382, dice.range(0.02, 0.09));
        let (c, s) = (cos_turns(turns), sin_turns(turns));
        let height = vessel.height();
        let top = height * dice.range(1.3, 2.0);
        let out = neck.max(0.002) * 0.7;
        let knots = [
            v(-0.5 * out * c, -0.5 * out * s, height * 0.3),
            v(out * c, out * s, height),
            v((out + lean * 0.6) * c + dice.around_zero(0.005), (out + lean * 0.6) * s, (height + top) * 0.5),
            v((out + lean) * c, (out + lean) * s + dice.around_zero(0.01), top),
        ];
        let path = path_through(&knots, 24);
        a.tube_along(&path, 7, V::x(), bark, |t| [0.0018 - 0.001 * t; 2]);
        for i in 0..dice.int(2, 10) {
            let at = path[(23 - i.min(11)) as usize];
            let side = v(dice.around_zero(0.008), dice.around_zero(0.008), dice.range(0.0, 0.008));
            a.tube(&[at, at + side], 5, 0.0006, bark);
            a.ellipsoid(at + side, V::repeat(dice.range(0.0015, 0.004)), 8, berry);
        }
    }
}

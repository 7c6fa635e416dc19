//! Toy vehicles: cars, trucks, locomotives, aeroplanes, boats.

mod aeroplane;
mod boat;
mod car;
mod locomotive;
mod truck;

use super::style::Style;
use crate::objects::dice::Dice;
use crate::objects::frame::V;
use crate::objects::shape::{Assembly, Section};

pub(super) fn make(dice: &mut Dice) -> Assembly {
    let mut a = Assembly::new();
    let style = Style::draw(dice);
    match dice.int(0, 5) {
        0 | 1 => car::car(&mut a, dice, &style),
        2 => truck::truck(&mut a, dice, &style),
        3 => locomotive::locomotive(&mut a, dice, &style),
        4 => aeroplane::aeroplane(&mut a, dice, &style),
        _ => boat::boat(&mut a, dice, &style),
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

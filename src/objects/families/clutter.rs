//! Several other objects stacked or side by side.

use super::{FAMILIES, Maker};
use crate::objects::dice::Dice;
use crate::objects::frame::{Frame, V};
use crate::objects::shape::Assembly;

/// What a pile is made of: families whose objects can stand on or beside others.
const MEMBERS: [&str; 12] = [
    "animal", "bottle", "bowl", "bricks", "can", "carton", "device", "fruit", "mug", "shoe", "tool",
    "vehicle",
];

pub(super) fn make(dice: &mut Dice) -> Assembly {
    let mut a = Assembly::new();
    let count = dice.int(2, 5);
    // Where the next thing may stand: on top of what is there, or beside it.
    let mut placed: Vec<[V; 2]> = Vec::new();
    for k in 0..count {
        let member = maker(dice)(dice);
        let [low, high] = member.bounds();
        let size = high - low;
        let wanted = dice.range(0.05, 0.12);
        let scale = wanted / size.max().max(1e-6);
        let turns = if dice.chance(0.5) { dice.unit() } else { dice.pick(&[0.0, 0.25, 0.5, 0.75]) };
        let lying = dice.chance(0.2);
        let middle = (low + high) * 0.5;
        let mut frame = Frame::identity().turned(2, turns);
        if lying {
            frame = frame.turned(0, 0.25);
        }
        let frame = frame.stretched(scale, scale, scale).moved(-middle.x, -middle.y, -middle.z);
        // Its box once turned.
        let corners = (0..8).map(|c| {
            let pick = |bit: usize, axis: usize| if c >> bit & 1 == 0 { low[axis] } else { high[axis] };
            frame.point(V::new(pick(0, 0), pick(1, 1), pick(2, 2)))
        });
        let (mut lower, mut upper) = (V::repeat(f64::MAX), V::repeat(f64::MIN));
        for p in corners {
            (lower, upper) = (lower.inf(&p), upper.sup(&p));
        }
        let shift = if k == 0 {
            V::new(0.0, 0.0, -lower.z)
        } else if dice.chance(0.5) {
            // On top of one that nothing stands on, slightly sunk in.
            let under = placed[placed.len() - 1];
            let at = (under[0] + under[1]) * 0.5;
            V::new(
                at.x + dice.around_zero(0.006),
                at.y + dice.around_zero(0.006),
                under[1].z - lower.z - 0.001,
            )
        } else {
            // On the ground, beyond everything in one direction, as near as boxes allow.
            let away = dice.unit();
            let (c, s) = (crate::objects::exact::cos_turns(away), crate::objects::exact::sin_turns(away));
            let mut distance: f64 = 0.0;
            while placed.iter().any(|[a, b]| {
                let at = V::new(c * distance, s * distance, -lower.z);
                let overlaps =
                    |axis: usize| lower[axis] + at[axis] < b[axis] && upper[axis] + at[axis] > a[axis];
                overlaps(0) && overlaps(1)
            }) {
                distance += 0.004;
            }
            V::new(c * distance, s * distance, -lower.z) * 0.92 + V::new(0.0, 0.0, -lower.z * 0.08)
        };
        placed.push([lower + shift, upper + shift]);
        a.add(member, Frame::identity().moved(shift.x, shift.y, shift.z).after(frame));
    }
    a
}

fn maker(dice: &mut Dice) -> Maker {
    let name = dice.pick(&MEMBERS);
    FAMILIES.iter().find(|family| family.0 == name).map_or(super::carton::make, |family| family.2)
}

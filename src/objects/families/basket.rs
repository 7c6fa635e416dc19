//! Baskets, crates and cages: walls that one sees through.

use super::fruit::one_fruit;
use super::style::Style;
use crate::objects::dice::Dice;
use crate::objects::exact::{cos_turns, sin_turns};
use crate::objects::frame::{Frame, V, v};
use crate::objects::paint::{texels, wood};
use crate::objects::shape::{Assembly, path_through, superellipse};

pub(super) fn make(dice: &mut Dice) -> Assembly {
    let mut a = Assembly::new();
    let style = Style::draw(dice);
    let (r, height) = (dice.range(0.04, 0.07), dice.range(0.03, 0.1));
    match dice.int(0, 3) {
        0 | 1 => wicker(&mut a, dice, &style, r, height),
        2 => crate_of_slats(&mut a, dice, &style, r, height),
        _ => wire(&mut a, dice, &style, r, height),
    }
    if dice.chance(0.45) {
        let size = r * dice.range(0.25, 0.4);
        for i in 0..dice.int(2, 9) {
            let fruit = one_fruit(dice, size);
            let turns = f64::from(i) * 0.382;
            let out = r * if i < 5 { 0.4 } else { 0.12 };
            let z = size * 1.1 + if i < 5 { 0.0 } else { size * 1.3 };
            let frame = Frame::identity()
                .moved(out * cos_turns(turns), out * sin_turns(turns), z)
                .turned(dice.int(0, 1) as usize, dice.unit());
            a.add(fruit, frame);
        }
    }
    a
}

/// Straw or wood.
fn straw(a: &mut Assembly, dice: &mut Dice, style: &Style) -> u32 {
    if dice.chance(0.5) {
        let painter = wood(dice, [0.02, 0.2]);
        return a.paint(texels([0.05, 0.2]), painter);
    }
    style.plain(a, dice, [0.02, 0.2])
}

/// Radius at a share of the height, and the outline's shape.
struct Wall {
    foot: f64,
    top: f64,
    belly: f64,
    height: f64,
    squareness: f64,
}

impl Wall {
    fn draw(dice: &mut Dice, r: f64, height: f64) -> Self {
        Self {
            foot: r * dice.range(0.6, 0.95),
            top: r,
            belly: r * dice.range(-0.05, 0.2),
            height,
            squareness: if dice.chance(0.3) { dice.range(0.3, 0.6) } else { 1.0 },
        }
    }

    fn point(&self, turns: f64, t: f64) -> V {
        let r = self.foot + (self.top - self.foot) * t + self.belly * sin_turns(0.5 * t);
        let corner = if self.squareness < 1.0 {
            let at = (turns * 4.0).rem_euclid(1.0) - 0.5;
            1.0 + (1.0 - self.squareness) * 0.4 * (1.0 - (2.0 * at) * (2.0 * at))
        } else {
            1.0
        };
        v(r * corner * cos_turns(turns), r * corner * sin_turns(turns), self.height * t)
    }
}

fn handle(a: &mut Assembly, dice: &mut Dice, wall: &Wall, thick: f64, paint: u32) {
    let rise = wall.top * dice.range(0.7, 1.4);
    let path: Vec<V> = (0..=40)
        .map(|i| {
            let t = 0.5 * f64::from(i) / 40.0;
            v(wall.top * 0.98 * cos_turns(t), 0.0, wall.height * 0.9 + rise * sin_turns(t))
        })
        .collect();
    a.tube_along(&path, 12, V::y(), paint, |_| [thick * 1.8, thick]);
}

fn floor(a: &mut Assembly, wall: &Wall, paint: u32) {
    let ring = |z: f64| -> Vec<V> {
        (0..48).map(|i| wall.point(f64::from(i) / 48.0, 0.0)).map(|p| v(p.x, p.y, z)).collect()
    };
    a.loft(&[ring(0.003), ring(0.0)], paint, paint);
}

fn wicker(a: &mut Assembly, dice: &mut Dice, style: &Style, r: f64, height: f64) {
    let wall = Wall::draw(dice, r, height);
    let one = straw(a, dice, style);
    let two = if dice.chance(0.5) { straw(a, dice, &style.turned(2)) } else { one };
    floor(a, &wall, one);
    let stakes = dice.int(8, 16) * 2;
    let thick = dice.range(0.0012, 0.0022);
    let rows = ((height / (thick * dice.range(2.1, 4.5))) as u32).clamp(5, 22);
    for k in 0..stakes {
        let turns = f64::from(k) / f64::from(stakes);
        let path: Vec<V> = (0..=8).map(|i| wall.point(turns, f64::from(i) / 8.0)).collect();
        a.tube(&path, 6, thick * 0.8, two);
    }
    let steps = stakes * 3;
    for row in 0..rows {
        let t = (f64::from(row) + 0.5) / f64::from(rows);
        let phase = if row % 2 == 0 { 0.0 } else { 0.5 };
        let path: Vec<V> = (0..steps)
            .map(|i| {
                let turns = f64::from(i) / f64::from(steps);
                let p = wall.point(turns, t);
                let out = 1.0 + 1.5 * thick / wall.top * cos_turns(turns * f64::from(stakes) * 0.5 + phase);
                v(p.x * out, p.y * out, p.z)
            })
            .collect();
        a.ring_along(&path, 6, [thick, thick], 0.0, if row % 4 == 3 { two } else { one });
    }
    let rim: Vec<V> = (0..64).map(|i| wall.point(f64::from(i) / 64.0, 1.0)).collect();
    a.ring_along(&rim, 10, [thick * 2.0, thick * 2.0], 0.0, two);
    if dice.chance(0.6) {
        handle(a, dice, &wall, thick * 1.6, one);
    }
}

fn wire(a: &mut Assembly, dice: &mut Dice, style: &Style, r: f64, height: f64) {
    let wall = Wall::draw(dice, r, height);
    let metal = style.plain(a, dice, [0.01, 0.2]);
    let thick = dice.range(0.0009, 0.002);
    let bars = dice.int(8, 30);
    let cage = dice.chance(0.35);
    for k in 0..bars {
        let turns = f64::from(k) / f64::from(bars);
        let mut knots = vec![wall.point(turns, 0.0) * 0.1, wall.point(turns, 0.0)];
        knots.extend((1..=4).map(|i| wall.point(turns, f64::from(i) / 4.0)));
        if cage {
            let p = wall.point(turns, 1.0);
            knots.push(v(p.x * 0.6, p.y * 0.6, height + r * 0.5));
            knots.push(v(p.x * 0.02, p.y * 0.02, height + r * 0.65));
        }
        a.tube(&path_through(&knots, 26), 6, thick, metal);
    }
    for row in 0..=dice.int(2, 7) {
        let t = f64::from(row) / 7.0;
        let ring: Vec<V> = (0..56).map(|i| wall.point(f64::from(i) / 56.0, t)).collect();
        a.ring_along(&ring, 6, [thick, thick], 0.0, metal);
    }
    let rim: Vec<V> = (0..64).map(|i| wall.point(f64::from(i) / 64.0, 1.0)).collect();
    a.ring_along(&rim, 8, [thick * 1.6, thick * 1.6], 0.0, metal);
    if cage || dice.chance(0.3) {
        let ball = style.turned(2).surface(a, dice, [0.08, 0.04]);
        a.ellipsoid(v(0.0, 0.0, height * 0.5), V::repeat(r * 0.35), 20, ball);
    }
}

fn crate_of_slats(a: &mut Assembly, dice: &mut Dice, style: &Style, r: f64, height: f64) {
    let boards = straw(a, dice, style);
    let printed = if dice.chance(0.5) { style.print(a, dice, [2.0 * r, 0.02]) } else { boards };
    let (x, y) = (r, r * dice.range(0.6, 1.0));
    let thick = dice.range(0.0012, 0.003);
    for (sx, sy) in [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)] {
        let (cx, cy) = (sx * (x - thick * 2.0), sy * (y - thick * 2.0));
        a.block(
            v(cx - thick * 1.5, cy - thick * 1.5, 0.0),
            v(cx + thick * 1.5, cy + thick * 1.5, height),
            boards,
        );
    }
    let rows = dice.int(2, 6);
    let share = dice.range(0.5, 0.92);
    for row in 0..rows {
        let (low, high) =
            (height * f64::from(row) / f64::from(rows), height * (f64::from(row) + share) / f64::from(rows));
        for side in [1.0, -1.0] {
            a.block(v(-x, side * y - thick * 0.5, low), v(x, side * y + thick * 0.5, high), printed);
            a.block(
                v(side * x - thick * 0.5, -y + thick, low),
                v(side * x + thick * 0.5, y - thick, high),
                boards,
            );
        }
    }
    let planks = dice.int(3, 7);
    for k in 0..planks {
        let (low, wide) =
            (-x + 2.0 * x * f64::from(k) / f64::from(planks), 2.0 * x / f64::from(planks) * 0.85);
        a.block(v(low, -y * 0.99, thick * 0.2), v(low + wide, y * 0.99, thick * 1.2), boards);
    }
    if dice.chance(0.3) {
        let outline = superellipse([x * 0.5, y * 0.5], 0.5, 32);
        let cloth = style.turned(1).patterned(a, dice, [0.1, 0.1]);
        let frame = a.at.moved(0.0, 0.0, thick * 1.1);
        a.within(frame, |a| a.extrude(&outline, height * dice.range(0.3, 1.1), 0.004, cloth, cloth));
    }
}

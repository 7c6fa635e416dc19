//! Hand tools: hammers, screwdrivers, wrenches, pliers, brushes, scissors.

use super::style::Style;
use crate::objects::dice::Dice;
use crate::objects::frame::{V, v};
use crate::objects::paint::{brushed_metal, texels, wood};
use crate::objects::shape::{Assembly, SAME_EACH, Section, circle, path_through, rounded, rounded_rectangle};

pub(super) fn make(dice: &mut Dice) -> Assembly {
    let mut a = Assembly::new();
    let style = Style::draw(dice);
    let steel = brushed_metal(dice, [0.06, 0.06]);
    let steel = style.worn(&mut a, dice, [0.06, 0.06], steel);
    let grip = if dice.chance(0.35) {
        let painter = wood(dice, [0.06, 0.12]);
        style.worn(&mut a, dice, [0.06, 0.12], painter)
    } else {
        style.surface(&mut a, dice, [0.06, 0.12])
    };
    let tool = Tool { steel, grip };
    match dice.int(0, 6) {
        0 | 1 => tool.hammer(&mut a, dice),
        2 => tool.screwdriver(&mut a, dice),
        3 => tool.wrench(&mut a, dice),
        4 => tool.pliers(&mut a, dice),
        5 => tool.brush(&mut a, dice),
        _ => tool.saw(&mut a, dice),
    }
    a
}

struct Tool {
    steel: u32,
    grip: u32,
}

impl Tool {
    /// A handle standing along z from 0 to `length`.
    fn handle(&self, a: &mut Assembly, dice: &mut Dice, length: f64, r: f64) {
        let waist = dice.range(0.6, 0.95);
        let flat = dice.range(0.6, 1.0);
        let path: Vec<V> = (0..=24).map(|i| v(0.0, 0.0, length * f64::from(i) / 24.0)).collect();
        let (ribs, depth) = (f64::from(dice.int(0, 14)), dice.range(0.0, 0.08));
        a.tube_along(&path, 20, V::x(), self.grip, |t| {
            let swell = 1.0 - (1.0 - waist) * crate::objects::exact::sin_turns(0.5 * t);
            let rib = 1.0 - depth * (0.5 + 0.5 * crate::objects::exact::cos_turns(t * ribs));
            [r * swell * rib, r * flat * swell * rib]
        });
    }

    fn hammer(&self, a: &mut Assembly, dice: &mut Dice) {
        let (length, r) = (dice.range(0.1, 0.2), dice.range(0.007, 0.012));
        self.handle(a, dice, length, r);
        let (half, reach) = (r * dice.range(1.2, 1.9), dice.range(0.025, 0.05));
        let before = a.at;
        a.at = before.moved(0.0, 0.0, length - half * 0.5);
        a.rounded_box(v(half * 2.2, half * 2.0, half * 2.0), half * 0.3, 2, SAME_EACH, self.steel);
        // The face.
        let profile = [
            [0.0, reach],
            [half * 0.95, reach],
            [half * 1.05, reach - 0.003],
            [half * 1.05, reach * 0.7],
            [half * 0.7, reach * 0.55],
            [half * 0.8, 0.0],
            [0.0, 0.0],
        ];
        a.at = a.at.turned(1, 0.25);
        a.lathe(32, &[Section::new(&rounded(&profile, 1), self.steel)]);
        a.at = before.moved(0.0, 0.0, length - half * 0.5);
        match dice.int(0, 2) {
            0 => {
                // A claw.
                for side in [1.0, -1.0] {
                    let path = path_through(
                        &[
                            v(0.0, side * half * 0.3, 0.0),
                            v(-reach * 0.7, side * half * 0.5, 0.002),
                            v(-reach * 1.2, side * half * 0.8, -half * 1.3),
                        ],
                        20,
                    );
                    a.tube_along(&path, 12, V::y(), self.steel, |t| {
                        [half * (0.5 - 0.2 * t), half * (0.75 - 0.6 * t)]
                    });
                }
            }
            1 => {
                // A wedge.
                let path = path_through(&[V::zeros(), v(-reach, 0.0, 0.0)], 12);
                a.tube_along(&path, 16, V::y(), self.steel, |t| [half * 0.95, half * (0.95 - 0.85 * t)]);
            }
            _ => {
                // A ball.
                a.ellipsoid(v(-reach * 0.8, 0.0, 0.0), V::repeat(half * 0.9), 16, self.steel);
                a.tube(&[V::zeros(), v(-reach * 0.8, 0.0, 0.0)], 16, half * 0.55, self.steel);
            }
        }
        a.at = before;
    }

    fn screwdriver(&self, a: &mut Assembly, dice: &mut Dice) {
        let (length, r) = (dice.range(0.05, 0.09), dice.range(0.008, 0.016));
        let (blade, thin) = (dice.range(0.04, 0.14), dice.range(0.0015, 0.0035));
        let flutes = f64::from(dice.int(4, 9));
        let depth = dice.range(0.02, 0.12);
        let profile = rounded(
            &[
                [0.0, length],
                [r * 0.6, length],
                [r * 0.5, length * 0.88],
                [r, length * 0.75],
                [r * 0.85, length * 0.3],
                [r * 0.9, 0.004],
                [r * 0.6, 0.0],
                [0.0, 0.0],
            ],
            2,
        );
        a.lathe_bent(64, &[Section::new(&profile, self.grip)], |p| {
            let turns = f64::from(crate::objects::exact::angle_turns(p.y as f32, p.x as f32));
            let scale = 1.0 - depth * (0.5 + 0.5 * crate::objects::exact::cos_turns(turns * flutes));
            v(p.x * scale, p.y * scale, p.z)
        });
        let path: Vec<V> =
            (0..=16).map(|i| v(0.0, 0.0, length - 0.004 + blade * f64::from(i) / 16.0)).collect();
        let flat = dice.chance(0.6);
        a.tube_along(&path, 14, V::x(), self.steel, |t| {
            let tip = ((t - 0.85) / 0.15).max(0.0);
            if flat {
                [thin * (1.0 + 0.8 * tip), thin * (1.0 - 0.8 * tip)]
            } else {
                [thin * (1.0 - 0.7 * tip); 2]
            }
        });
    }

    fn wrench(&self, a: &mut Assembly, dice: &mut Dice) {
        let (length, thick) = (dice.range(0.1, 0.18), dice.range(0.004, 0.008));
        let (wide, r) = (dice.range(0.006, 0.011), dice.range(0.012, 0.022));
        let shaft = rounded_rectangle([length * 0.5, wide], wide * 0.4, 3);
        let paint = if dice.chance(0.5) { self.grip } else { self.steel };
        a.extrude(&shaft, thick * 0.8, thick * 0.15, paint, paint);
        // Ring at one end, jaw at the other.
        let frame = a.at.moved(length * 0.5 + r * 0.5, 0.0, -thick * 0.15);
        let sides = dice.pick(&[6, 12]);
        a.within(frame, |a| {
            a.extrude_with_hole(
                &circle([r, r], 36),
                Some(&circle([r * 0.58, r * 0.58], sides)),
                thick * 1.3,
                thick * 0.2,
                self.steel,
                self.steel,
            );
        });
        let (gap, jaw) = (r * dice.range(0.45, 0.65), r * 1.25);
        let mut outline: Vec<[f64; 2]> =
            circle([jaw, jaw], 40).into_iter().filter(|p| p[0] < jaw * 0.6 || p[1].abs() > gap).collect();
        // The round rest begins at the upper lip and ends at the lower; the notch goes in between.
        outline.sort_by(|p, q| turn_from_right(p).total_cmp(&turn_from_right(q)));
        outline.extend([
            [jaw * 0.75, -gap],
            [-jaw * 0.05, -gap * 0.9],
            [-jaw * 0.3, 0.0],
            [-jaw * 0.05, gap * 0.9],
            [jaw * 0.75, gap],
        ]);
        let frame =
            a.at.moved(-length * 0.5 - r * 0.5, 0.0, -thick * 0.15).turned(2, 0.5 + dice.pick(&[0.0, 0.04]));
        a.within(frame, |a| a.extrude(&outline, thick * 1.3, thick * 0.2, self.steel, self.steel));
    }

    fn pliers(&self, a: &mut Assembly, dice: &mut Dice) {
        let (open, length) = (dice.range(0.0, 0.05), dice.range(0.08, 0.12));
        let (nose, thick) = (dice.range(0.02, 0.06), dice.range(0.004, 0.006));
        for side in [1.0, -1.0] {
            let frame = a.at.stretched(side, 1.0, 1.0).turned(2, open * 0.5);
            a.within(frame, |a| {
                let jaw =
                    path_through(&[v(0.0, 0.0, 0.0), v(0.006, 0.014, 0.0), v(0.0035, nose + 0.008, 0.0)], 18);
                a.tube_along(&jaw, 12, V::z(), self.steel, |t| {
                    [thick * (1.1 - 0.7 * t), 0.006 * (1.0 - 0.65 * t)]
                });
                let arm = path_through(
                    &[
                        v(0.0, 0.0, 0.0),
                        v(-0.012, -0.02, 0.0),
                        v(-0.022, -length * 0.6, 0.0),
                        v(-0.016, -length, 0.0),
                    ],
                    28,
                );
                a.tube_along(&arm[..10], 12, V::z(), self.steel, |_| [thick * 0.9, 0.004]);
                a.tube_along(&arm[7..], 14, V::z(), self.grip, |t| [thick * (1.2 - 0.2 * t), 0.0055]);
            });
        }
        let frame = a.at.moved(0.0, 0.0, -thick * 1.4);
        a.within(frame, |a| {
            a.extrude(&circle([0.009, 0.009], 28), thick * 2.8, 0.001, self.steel, self.steel)
        });
    }

    fn brush(&self, a: &mut Assembly, dice: &mut Dice) {
        let (length, r) = (dice.range(0.07, 0.13), dice.range(0.006, 0.01));
        self.handle(a, dice, length, r);
        let (wide, deep, long) = (dice.range(0.01, 0.035), dice.range(0.004, 0.01), dice.range(0.02, 0.045));
        let frame = a.at.moved(0.0, 0.0, length + 0.008);
        a.within(frame, |a| a.rounded_box(v(wide * 2.1, deep * 2.2, 0.02), 0.002, 2, SAME_EACH, self.steel));
        let hair = brushed_metal(dice, [long, wide]);
        let hair = a.paint(texels([long, wide]), hair);
        let (across, rows) = (dice.int(8, 22), dice.int(2, 5));
        for i in 0..across {
            for j in 0..rows {
                let x = wide * (2.0 * (f64::from(i) + 0.5) / f64::from(across) - 1.0);
                let y = deep * (2.0 * (f64::from(j) + 0.5) / f64::from(rows) - 1.0);
                let end = v(
                    x * dice.range(0.9, 1.3),
                    y * dice.range(0.8, 1.5),
                    length + 0.016 + long * dice.range(0.85, 1.0),
                );
                a.tube(&[v(x, y, length + 0.014), end], 5, wide / f64::from(across) * 0.8, hair);
            }
        }
    }

    fn saw(&self, a: &mut Assembly, dice: &mut Dice) {
        let (length, height) = (dice.range(0.1, 0.2), dice.range(0.02, 0.045));
        let teeth = dice.int(14, 44);
        let mut outline = vec![[length, height * 0.4], [length, height * 0.8], [0.0, height]];
        for i in 0..=teeth {
            let x = length * f64::from(i) / f64::from(teeth);
            outline.push([x, 0.0]);
            if i < teeth {
                outline.push([x + length / f64::from(teeth) * 0.75, -height * 0.08]);
            }
        }
        let before = a.at;
        a.at = before.turned(0, 0.25);
        a.extrude(&outline, 0.0012, 0.0, self.steel, self.steel);
        // A handle with a hole for the hand.
        let (half, hole) = (height * dice.range(0.9, 1.2), height * 0.55);
        a.at = a.at.moved(-half * 0.7, height * 0.5, -0.005);
        a.extrude_with_hole(
            &rounded_rectangle([half * 0.8, half], half * 0.4, 5),
            Some(&rounded_rectangle([hole * 0.6, hole], hole * 0.4, 5)),
            0.011,
            0.002,
            self.grip,
            self.grip,
        );
        a.at = before;
    }
}

/// Turns from the positive x axis, 0 to 1.
fn turn_from_right(p: &[f64; 2]) -> f64 {
    f64::from(crate::objects::exact::angle_turns(p[1] as f32, p[0] as f32)).rem_euclid(1.0)
}

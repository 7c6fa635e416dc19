//! What cups, bowls, vases and pots are: a wall turned about z, open above.

use crate::objects::dice::Dice;
use crate::objects::exact::{cos_turns, sin_turns};
use crate::objects::frame::{V, v};
use crate::objects::shape::{Assembly, Section, rounded};

/// A vessel standing on z = 0.
pub(super) struct Vessel {
    /// (radius, height) of its outside from the rim down to where it stands.
    pub(super) outer: Vec<[f64; 2]>,
    /// Thickness, metres.
    pub(super) wall: f64,
    /// How its cross-section departs from a circle.
    pub(super) section: CrossSection,
}

/// A cross-section's shape.
#[derive(Clone, Copy, Debug)]
pub(super) enum CrossSection {
    /// A circle.
    Round,
    /// Waves: how many, how deep as a share of the radius, turns from bottom to top per metre.
    Fluted(f64, f64, f64),
    /// Flat sides: how many.
    Faceted(f64),
    /// Stretched along x.
    Oval(f64),
}

impl CrossSection {
    /// Mostly round ones.
    pub(super) fn draw(dice: &mut Dice) -> Self {
        match dice.int(0, 9) {
            0 | 1 => {
                let twist = if dice.chance(0.5) { dice.range(-4.0, 4.0) } else { 0.0 };
                Self::Fluted(f64::from(dice.int(5, 18)), dice.range(0.02, 0.09), twist)
            }
            2 => Self::Faceted(f64::from(dice.int(4, 10))),
            3 => Self::Oval(dice.range(1.1, 1.5)),
            _ => Self::Round,
        }
    }

    /// Where a point of the round shape goes.
    pub(super) fn bend(self, p: V) -> V {
        let turns = || f64::from(crate::objects::exact::angle_turns(p.y as f32, p.x as f32));
        let scale = match self {
            Self::Round => return p,
            Self::Oval(by) => return v(p.x * by, p.y, p.z),
            Self::Fluted(count, depth, twist) => 1.0 + depth * sin_turns((turns() + twist * p.z) * count),
            Self::Faceted(count) => {
                let t = (turns() * count).rem_euclid(1.0) - 0.5;
                cos_turns(0.5 / count) / cos_turns(t / count)
            }
        };
        v(p.x * scale, p.y * scale, p.z)
    }

    /// Cells around that show it.
    pub(super) fn around(self) -> usize {
        match self {
            Self::Fluted(count, ..) => (count as usize * 8).max(64),
            Self::Faceted(count) => (count as usize) * (72 / count as usize).max(1),
            _ => 72,
        }
    }
}

impl Vessel {
    /// A vessel through few points of its outside, from the rim (first) to the edge it stands on (last).
    pub(super) fn through(points: &[[f64; 2]], wall: f64, section: CrossSection) -> Self {
        Self { outer: rounded(points, 3), wall, section }
    }

    /// Radius of the outside at a height.
    pub(super) fn radius_at(&self, z: f64) -> f64 {
        for pair in self.outer.windows(2) {
            let ([r0, z0], [r1, z1]) = (pair[0], pair[1]);
            if z <= z0 && z >= z1 {
                return r0 + (r1 - r0) * (z0 - z) / (z0 - z1).max(1e-9);
            }
        }
        self.outer.last().map_or(0.0, |p| p[0])
    }

    /// Height of the rim.
    pub(super) fn height(&self) -> f64 {
        self.outer.first().map_or(0.0, |p| p[1])
    }

    /// Largest radius.
    pub(super) fn widest(&self) -> f64 {
        self.outer.iter().fold(0.0, |m: f64, p| m.max(p[0]))
    }

    /// Adds it: `outside` and `inside` are textures once around.
    pub(super) fn add(&self, a: &mut Assembly, outside: u32, inside: u32) {
        let wall = self.wall;
        let floor = self.outer.last().map_or(0.0, |p| p[1]) + wall * 1.2;
        let rim = self.outer.first().copied().unwrap_or_default();
        let mut inner: Vec<[f64; 2]> = vec![[0.0, floor]];
        for [r, z] in self.outer.iter().rev() {
            if *z > floor + 1e-9 {
                let r = (r - wall).max(0.15 * r);
                if inner.len() == 1 {
                    inner.push([r * 0.93, floor]);
                }
                inner.push([r, *z]);
            }
        }
        let inner_rim = inner.last().copied().unwrap_or([0.0, floor]);
        let lip =
            rounded(&[inner_rim, [inner_rim[0], rim[1] + wall * 0.4], [rim[0], rim[1] + wall * 0.4], rim], 2);
        let foot = self.outer.last().copied().unwrap_or_default();
        let below = [
            foot,
            [foot[0] * 0.9, foot[1]],
            [foot[0] * 0.86, foot[1] + wall * 0.5],
            [0.0, foot[1] + wall * 0.5],
        ];
        let sections = [
            Section::new(&inner, inside),
            Section::new(&lip, inside),
            Section::new(&self.outer, outside),
            Section::new(&below, inside),
        ];
        a.lathe_bent(self.section.around(), &sections, |p| self.section.bend(p));
    }

    /// Adds what fills it up to a height: a closed disc.
    pub(super) fn fill(&self, a: &mut Assembly, z: f64, dome: f64, paint: u32) {
        let r = (self.radius_at(z) - self.wall * 0.6).max(1e-3);
        let low = z - 0.004;
        let bottom = (self.radius_at(low) - self.wall * 0.6).max(1e-3).min(r);
        let top = [[0.0, z + dome], [0.5 * r, z + 0.75 * dome], [r, z], [bottom, low], [0.0, low]];
        a.lathe_bent(self.section.around(), &[Section::new(&top, paint)], |p| self.section.bend(p));
    }
}

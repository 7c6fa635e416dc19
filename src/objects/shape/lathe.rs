//! Surfaces of revolution.

use super::assembly::{Assembly, UvRect, WHOLE};
use crate::objects::exact::{cos_turns, sin_turns};
use crate::objects::frame::{V, v};

/// A stretch of a profile with its own texture.
pub(in crate::objects) struct Section<'a> {
    /// (radius, height) from the top outside downwards; the next stretch starts where this one ends.
    pub(in crate::objects) profile: &'a [[f64; 2]],
    /// Its texture: u once around, from -y to the right as seen from outside, v along the profile.
    pub(in crate::objects) paint: u32,
    /// How much of the texture.
    pub(in crate::objects) uv: UvRect,
}

impl<'a> Section<'a> {
    /// A stretch under a whole texture.
    pub(in crate::objects) fn new(profile: &'a [[f64; 2]], paint: u32) -> Self {
        Self { profile, paint, uv: WHOLE }
    }
}

impl Assembly {
    /// Turns a profile about z. It runs so that the solid is on its right (down on the outside, towards the
    /// axis below, up on the inside), and starts and ends on the axis, or ends where it started.
    pub(in crate::objects) fn lathe(&mut self, around: usize, sections: &[Section<'_>]) {
        self.lathe_bent(around, sections, |p| p);
    }

    /// As [`Self::lathe`], every point then moved by `bend`.
    pub(in crate::objects) fn lathe_bent(
        &mut self,
        around: usize,
        sections: &[Section<'_>],
        bend: impl Fn(V) -> V,
    ) {
        self.part(true, |a| {
            for section in sections {
                let rings: Vec<Vec<V>> =
                    section.profile.iter().map(|[r, z]| ring(around, *r, *z, &bend)).collect();
                a.skin(&rings, true, section.uv, section.paint);
            }
        });
    }
}

fn ring(around: usize, r: f64, z: f64, bend: &impl Fn(V) -> V) -> Vec<V> {
    (0..around)
        .map(|i| {
            // On the axis all points are one, whatever the bend makes of signs of zero.
            let turns = if r == 0.0 { 0.0 } else { i as f64 / around as f64 - 0.25 };
            bend(v(r * cos_turns(turns), r * sin_turns(turns), z))
        })
        .collect()
}

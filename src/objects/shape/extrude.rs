//! Plates cut out along an outline.

use super::assembly::{Assembly, WHOLE};
use super::ear_clip::ear_clip;
use super::outline::{Outline, doubled_area, inset};
use crate::objects::frame::{V, v};

impl Assembly {
    /// A plate over an anticlockwise outline in x and y, from z = 0 to `height`, its edges bevelled by `bevel`.
    /// The `top` texture lies flat over both faces, `side` once around.
    pub(in crate::objects) fn extrude(
        &mut self,
        outline: &[[f64; 2]],
        height: f64,
        bevel: f64,
        top: u32,
        side: u32,
    ) {
        self.extrude_with_hole(outline, None, height, bevel, top, side);
    }

    /// As [`Self::extrude`], with a hole along another anticlockwise outline inside.
    pub(in crate::objects) fn extrude_with_hole(
        &mut self,
        outline: &[[f64; 2]],
        hole: Option<&[[f64; 2]]>,
        height: f64,
        bevel: f64,
        top: u32,
        side: u32,
    ) {
        let bevel = bevel.min(height * 0.45);
        let narrow = if bevel > 0.0 { inset(outline, bevel) } else { outline.to_vec() };
        let clockwise: Option<Outline> = hole.map(|h| h.iter().rev().copied().collect());
        let face = match &clockwise {
            Some(hole) => bridged(&narrow, hole),
            None => narrow.clone(),
        };
        self.part(true, |a| {
            let ring = |outline: &[[f64; 2]], z: f64| -> Vec<V> {
                outline.iter().map(|[x, y]| v(*x, *y, z)).collect()
            };
            let mut rings = vec![
                ring(&narrow, height),
                ring(outline, height - bevel),
                ring(outline, bevel),
                ring(&narrow, 0.0),
            ];
            rings.dedup();
            a.skin(&rings, true, WHOLE, side);
            if let Some(hole) = &clockwise {
                a.skin(&[ring(hole, height), ring(hole, 0.0)], true, WHOLE, side);
            }
            let (low, high) = bounds(outline);
            for (z, up) in [(height, true), (0.0, false)] {
                let ids: Vec<u32> = face
                    .iter()
                    .map(|[x, y]| {
                        let uv = [(x - low[0]) / (high[0] - low[0]), 1.0 - (y - low[1]) / (high[1] - low[1])];
                        a.vertex(v(*x, *y, z), None, uv)
                    })
                    .collect();
                for [p, q, r] in ear_clip(&face) {
                    a.triangle(if up { [ids[p], ids[q], ids[r]] } else { [ids[p], ids[r], ids[q]] }, top);
                }
            }
        });
    }
}

/// One outline around both: in to the hole over the shortest bridge, around it and back.
fn bridged(outer: &[[f64; 2]], hole: &[[f64; 2]]) -> Outline {
    debug_assert!(doubled_area(outer) > 0.0 && doubled_area(hole) < 0.0);
    let (mut best, mut from, mut to) = (f64::MAX, 0, 0);
    for (i, p) in outer.iter().enumerate() {
        for (k, q) in hole.iter().enumerate() {
            let squared = (p[0] - q[0]) * (p[0] - q[0]) + (p[1] - q[1]) * (p[1] - q[1]);
            if squared < best {
                (best, from, to) = (squared, i, k);
            }
        }
    }
    let around_hole = hole.iter().cycle().skip(to).take(hole.len() + 1);
    outer[..=from].iter().chain(around_hole).chain(&outer[from..]).copied().collect()
}

fn bounds(outline: &[[f64; 2]]) -> ([f64; 2], [f64; 2]) {
    outline.iter().fold(([f64::MAX; 2], [f64::MIN; 2]), |(low, high), [x, y]| {
        ([low[0].min(*x), low[1].min(*y)], [high[0].max(*x), high[1].max(*y)])
    })
}

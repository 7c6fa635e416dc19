//! Boxes with round edges.

use super::assembly::{Assembly, UvRect, WHOLE};
use crate::objects::frame::{V, v};

/// A texture of three by two faces: front, right, back above left, top, bottom.
pub(in crate::objects) const ATLAS: [UvRect; 6] = [
    [0.0, 0.0, 1.0 / 3.0, 0.5],
    [1.0 / 3.0, 0.0, 2.0 / 3.0, 0.5],
    [2.0 / 3.0, 0.0, 1.0, 0.5],
    [0.0, 0.5, 1.0 / 3.0, 1.0],
    [1.0 / 3.0, 0.5, 2.0 / 3.0, 1.0],
    [2.0 / 3.0, 0.5, 1.0, 1.0],
];

/// The whole texture on each face.
pub(in crate::objects) const SAME_EACH: [UvRect; 6] = [WHOLE; 6];

/// For each face the axes along u (to the right), up and out, as seen from outside, with their signs.
/// Front (-y), right (+x), back (+y), left (-x), top, bottom.
const FACES: [[(usize, bool); 3]; 6] = [
    [(0, true), (2, true), (1, false)],
    [(1, true), (2, true), (0, true)],
    [(0, false), (2, true), (1, true)],
    [(1, false), (2, true), (0, false)],
    [(0, true), (1, true), (2, true)],
    [(0, true), (1, false), (2, false)],
];

impl Assembly {
    /// A box about the origin with edges rounded to `radius` in `steps` cells, and the textures' parts for its
    /// front (-y), right, back, left, top and bottom, each upright as seen from outside.
    pub(in crate::objects) fn rounded_box(
        &mut self,
        size: V,
        radius: f64,
        steps: usize,
        uvs: [UvRect; 6],
        paint: u32,
    ) {
        let lattice = Lattice::new(size, radius, steps, 1);
        self.box_of(&lattice, uvs, paint, |p| p);
    }

    /// As [`Self::rounded_box`], every point then moved by `bend`.
    pub(in crate::objects) fn box_bent(
        &mut self,
        size: V,
        radius: f64,
        steps: usize,
        uvs: [UvRect; 6],
        paint: u32,
        bend: impl Fn(V) -> V,
    ) {
        // Flat stretches get cells, too, so that the bend has something to move.
        self.box_of(&Lattice::new(size, radius, steps, 6), uvs, paint, bend);
    }

    fn box_of(&mut self, lattice: &Lattice, uvs: [UvRect; 6], paint: u32, bend: impl Fn(V) -> V) {
        let last = lattice.last();
        let half = lattice.half;
        self.part(true, |a| {
            for (face, uv) in FACES.iter().zip(uvs) {
                let [right, up, out] = *face;
                let mut ids = Vec::with_capacity((last + 1) * (last + 1));
                for j in 0..=last {
                    for i in 0..=last {
                        let mut at = [0; 3];
                        at[right.0] = if right.1 { i } else { last - i };
                        at[up.0] = if up.1 { last - j } else { j };
                        at[out.0] = if out.1 { last } else { 0 };
                        let point = lattice.point(at);
                        let share = |(axis, forward): (usize, bool)| {
                            let s = 0.5 + 0.5 * point[axis] / half[axis];
                            if forward { s } else { 1.0 - s }
                        };
                        let (s, t) = (share(right), 1.0 - share(up));
                        let uv = [uv[0] + (uv[2] - uv[0]) * s, uv[1] + (uv[3] - uv[1]) * t];
                        ids.push(a.vertex(bend(point), None, uv));
                    }
                }
                for j in 0..last {
                    for i in 0..last {
                        let k = j * (last + 1) + i;
                        let [p, q, r, s] = [ids[k], ids[k + 1], ids[k + last + 1], ids[k + last + 2]];
                        a.triangle([p, r, q], paint);
                        a.triangle([q, r, s], paint);
                    }
                }
            }
        });
    }

    /// A box with sharp edges from `low` to `high`, the whole texture on each face.
    pub(in crate::objects) fn block(&mut self, low: V, high: V, paint: u32) {
        let middle = (low + high) * 0.5;
        let before = self.at;
        self.at = before.moved(middle.x, middle.y, middle.z);
        let size = high - low;
        self.rounded_box(size, size.min() * 0.03, 1, SAME_EACH, paint);
        self.at = before;
    }
}

/// The points of a rounded box, numbered along each axis: a point that two faces share has the same bits in both.
struct Lattice {
    half: V,
    radius: f64,
    steps: usize,
    flat: usize,
}

impl Lattice {
    fn new(size: V, radius: f64, steps: usize, flat: usize) -> Self {
        let half = size * 0.5;
        Self { half, radius: radius.min(half.min() * 0.999).max(0.0), steps, flat }
    }

    fn last(&self) -> usize {
        2 * self.steps + self.flat
    }

    /// The middle of the rounding along an axis, and how far out of it the direction goes, -1 to 1.
    fn along(&self, axis: usize, i: usize) -> (f64, f64) {
        let (steps, flat) = (self.steps, self.flat);
        let inner = self.half[axis] - self.radius;
        if i <= steps {
            let out = if steps == 0 { 1.0 } else { (steps - i) as f64 / steps as f64 };
            (-inner, -out)
        } else if i >= steps + flat {
            let out = if steps == 0 { 1.0 } else { (i - steps - flat) as f64 / steps as f64 };
            (inner, out)
        } else {
            (inner * (2.0 * (i - steps) as f64 / flat as f64 - 1.0), 0.0)
        }
    }

    fn point(&self, at: [usize; 3]) -> V {
        let [x, y, z] = [0, 1, 2].map(|axis| self.along(axis, at[axis]));
        let direction = v(x.1, y.1, z.1).try_normalize(1e-12).unwrap_or(V::zeros());
        v(x.0, y.0, z.0) + direction * self.radius
    }
}

//! Tubes and bands along curves.

use super::assembly::{Assembly, WHOLE};
use crate::objects::exact::{cos_turns, sin_turns};
use crate::objects::frame::V;

impl Assembly {
    /// A tube along `path` with round ends. `half(t)` gives the half widths across it for t from 0 to 1: the
    /// first lies in the plane of `side` at the start and is carried along without twist.
    pub(in crate::objects) fn tube_along(
        &mut self,
        path: &[V],
        around: usize,
        side: V,
        paint: u32,
        half: impl Fn(f64) -> [f64; 2],
    ) {
        const CAP: usize = 4;
        let frames = frames(path, side);
        let (Some(first), Some(last)) = (frames.first(), frames.last()) else { return };
        let mut rings = Vec::with_capacity(path.len() + 2 * CAP);
        for k in (1..=CAP).rev() {
            rings.push(cap_ring(first, half(0.0), around, k, CAP, -1.0));
        }
        for (i, frame) in frames.iter().enumerate() {
            rings.push(frame.ring(half(i as f64 / (frames.len() - 1).max(1) as f64), around));
        }
        for k in 1..=CAP {
            rings.push(cap_ring(last, half(1.0), around, k, CAP, 1.0));
        }
        self.part(true, |a| a.skin(&rings, true, WHOLE, paint));
    }

    /// A round tube of one radius.
    pub(in crate::objects) fn tube(&mut self, path: &[V], around: usize, radius: f64, paint: u32) {
        let direction = path.get(1).zip(path.first()).map_or(V::z(), |(b, a)| b - a);
        let side = if direction.x.abs() < 0.9 * direction.norm() { V::x() } else { V::y() };
        self.tube_along(path, around, side, paint, |_| [radius; 2]);
    }

    /// A tube along a closed path (its end is not repeated), `twist_turns` once around.
    pub(in crate::objects) fn ring_along(
        &mut self,
        path: &[V],
        around: usize,
        half: [f64; 2],
        twist_turns: f64,
        paint: u32,
    ) {
        let n = path.len();
        if n < 3 {
            return;
        }
        let frames: Vec<Across> = (0..n)
            .map(|i| {
                let direction =
                    (path[(i + 1) % n] - path[(i + n - 1) % n]).try_normalize(1e-12).unwrap_or(V::z());
                Across { at: path[i], direction, side: V::zeros(), up: V::zeros() }
            })
            .collect();
        let frames = carried(frames, V::z());
        // What carrying the side once around has turned it by is given back evenly.
        let (first, last) = (&frames[0], &frames[n - 1]);
        let side = across(last.side, first.direction);
        let turned = angle(side.dot(&first.side), side.dot(&first.up));
        let mut rings: Vec<Vec<V>> = frames
            .iter()
            .enumerate()
            .map(|(i, frame)| frame.turned((twist_turns - turned) * i as f64 / n as f64).ring(half, around))
            .collect();
        // A whole number of turns brings the ring back to itself up to a shift of its points.
        rings.push(rings[0].clone());
        self.part(true, |a| a.skin(&rings, true, WHOLE, paint));
    }
}

/// A place on a path with two directions across it.
struct Across {
    at: V,
    direction: V,
    side: V,
    up: V,
}

impl Across {
    /// Runs clockwise as seen along the path, that is anticlockwise as seen from the start's outside.
    fn ring(&self, half: [f64; 2], around: usize) -> Vec<V> {
        (0..around)
            .map(|i| {
                let turns = i as f64 / around as f64;
                self.at + self.side * (cos_turns(turns) * half[0]) - self.up * (sin_turns(turns) * half[1])
            })
            .collect()
    }

    fn turned(&self, turns: f64) -> Self {
        let (s, c) = (sin_turns(turns), cos_turns(turns));
        Self { side: self.side * c + self.up * s, up: self.up * c - self.side * s, ..*self }
    }
}

fn cap_ring(frame: &Across, half: [f64; 2], around: usize, k: usize, of: usize, sign: f64) -> Vec<V> {
    let t = 0.25 * k as f64 / of as f64;
    // The last ring is one point.
    let narrow = if k == of { 0.0 } else { cos_turns(t) };
    let out = sin_turns(t) * half[0].min(half[1]) * sign;
    let moved = Across { at: frame.at + frame.direction * out, ..*frame };
    moved.ring(half.map(|h| h * narrow), around)
}

fn frames(path: &[V], side: V) -> Vec<Across> {
    let n = path.len();
    let frames = (0..n)
        .map(|i| {
            let (a, b) = (path[i.saturating_sub(1)], path[(i + 1).min(n - 1)]);
            let direction = (b - a).try_normalize(1e-12).unwrap_or(V::z());
            Across { at: path[i], direction, side: V::zeros(), up: V::zeros() }
        })
        .collect();
    carried(frames, side)
}

/// Carries `side` along, always across the path.
fn carried(mut frames: Vec<Across>, side: V) -> Vec<Across> {
    let mut side = side;
    for frame in &mut frames {
        side = across(side, frame.direction);
        frame.side = side;
        frame.up = frame.direction.cross(&side);
    }
    frames
}

fn across(side: V, direction: V) -> V {
    let flat = |s: V| (s - direction * direction.dot(&s)).try_normalize(1e-6);
    flat(side).or_else(|| flat(V::x())).or_else(|| flat(V::y())).unwrap_or(V::z())
}

/// The angle of (c, s), turns.
fn angle(c: f64, s: f64) -> f64 {
    f64::from(crate::objects::exact::angle_turns(s as f32, c as f32))
}

//! Balls and what is like them: ellipsoids, superquadrics, stones.

use super::assembly::{Assembly, WHOLE};
use crate::objects::exact::{cos_turns, power, sin_turns};
use crate::objects::frame::{V, v};

impl Assembly {
    /// A ball about the origin, `rows` cells from pole to pole; `shape` moves each point of the unit sphere.
    pub(in crate::objects) fn ball_like(&mut self, rows: usize, paint: u32, shape: impl Fn(V) -> V) {
        let around = rows * 2;
        let rings: Vec<Vec<V>> = (0..=rows)
            .map(|j| {
                let polar = 0.5 * j as f64 / rows as f64;
                let pole = j == 0 || j == rows;
                let (r, z) = (if pole { 0.0 } else { sin_turns(polar) }, cos_turns(polar));
                (0..around)
                    .map(|i| {
                        let turns = if pole { 0.0 } else { i as f64 / around as f64 - 0.25 };
                        shape(v(r * cos_turns(turns), r * sin_turns(turns), z))
                    })
                    .collect()
            })
            .collect();
        self.part(true, |a| a.skin(&rings, true, WHOLE, paint));
    }

    /// An ellipsoid with the given half axes.
    pub(in crate::objects) fn ellipsoid(&mut self, center: V, half: V, rows: usize, paint: u32) {
        self.ball_like(rows, paint, |p| center + p.component_mul(&half));
    }

    /// A superquadric: `squareness` of 1 is an ellipsoid, smaller goes towards a box, 2 is an octahedron.
    pub(in crate::objects) fn superquadric(&mut self, half: V, squareness: f64, rows: usize, paint: u32) {
        let signed = |x: f64| power(x.abs(), squareness) * if x < 0.0 { -1.0 } else { 1.0 };
        self.ball_like(rows, paint, |p| {
            let flat = (p.x * p.x + p.y * p.y).sqrt();
            let (c, s) = if flat > 1e-12 { (p.x / flat, p.y / flat) } else { (1.0, 0.0) };
            let r = if flat > 1e-12 { signed(flat) } else { 0.0 };
            v(r * signed(c), r * signed(s), signed(p.z)).component_mul(&half)
        });
    }
}

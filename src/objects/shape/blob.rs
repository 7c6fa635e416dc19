//! Soft bodies: lumps that flow into each other.

use super::assembly::Assembly;
use super::box_projection::box_uv;
use super::march::march;
use crate::objects::frame::V;

/// An ellipsoid or a capsule that is thicker at one end.
#[derive(Clone, Copy, Debug)]
pub(in crate::objects) struct Lump {
    from: V,
    to: V,
    radius: [f64; 2],
    /// Stretch of space along the axes; 1 for round lumps.
    stretch: V,
    paint: u32,
}

impl Lump {
    /// An ellipsoid with its axes along the frame's.
    pub(in crate::objects) fn ellipsoid(center: V, half: V, paint: u32) -> Self {
        let radius = half.min();
        Self { from: center, to: center, radius: [radius; 2], stretch: half / radius, paint }
    }

    /// A rod from `from` to `to`, with a radius at each.
    pub(in crate::objects) fn rod(from: V, to: V, radius: [f64; 2], paint: u32) -> Self {
        Self { from, to, radius, stretch: V::repeat(1.0), paint }
    }

    /// About the distance from its surface, negative inside.
    fn distance(&self, p: V) -> f64 {
        let p = (p - self.from).component_div(&self.stretch);
        let axis = (self.to - self.from).component_div(&self.stretch);
        let along = (p.dot(&axis) / axis.norm_squared().max(1e-12)).clamp(0.0, 1.0);
        (p - axis * along).norm() - (self.radius[0] + (self.radius[1] - self.radius[0]) * along)
    }

    fn reach(&self) -> V {
        self.stretch * self.radius[0].max(self.radius[1])
    }
}

/// Several lumps as one body.
pub(in crate::objects) struct Blob {
    /// The lumps.
    pub(in crate::objects) lumps: Vec<Lump>,
    /// Within this distance neighbouring lumps flow together, metres.
    pub(in crate::objects) softness: f64,
    /// Side of a texture on the surface, metres.
    pub(in crate::objects) tile: f64,
}

impl Blob {
    fn distance(&self, p: V) -> f64 {
        let mut all = f64::MAX;
        for lump in &self.lumps {
            let d = lump.distance(p);
            // Quadratic smooth minimum: exact where one lump is alone.
            let near = (self.softness - (all - d).abs()).max(0.0);
            all = all.min(d) - near * near / (4.0 * self.softness.max(1e-9));
        }
        all
    }
}

impl Assembly {
    /// A body of lumps, about `cells` cells along its longest side; each place is painted as its nearest lump.
    /// `carve` changes the field: it gets a point and the distance there.
    pub(in crate::objects) fn blob(&mut self, blob: &Blob, cells: usize, carve: impl Fn(V, f64) -> f64) {
        let (mut low, mut high) = (V::repeat(f64::MAX), V::repeat(f64::MIN));
        for lump in &blob.lumps {
            let reach = lump.reach().add_scalar(blob.softness);
            low = low.inf(&(lump.from.inf(&lump.to) - reach));
            high = high.sup(&(lump.from.sup(&lump.to) + reach));
        }
        let cell = (high - low).max() / cells as f64;
        let (low, high) = (low.add_scalar(-2.0 * cell), high.add_scalar(2.0 * cell));
        let field = |p: V| carve(p, blob.distance(p));
        self.field(low, high, cell, blob.tile, field, |p| {
            let nearest = blob.lumps.iter().min_by(|a, b| a.distance(p).total_cmp(&b.distance(p)));
            nearest.map_or(0, |lump| lump.paint)
        });
    }

    /// The zero surface of a field that is negative inside and positive all over the faces of the box; `paint`
    /// for a place, textures laid from three sides in tiles of `tile` metres.
    pub(in crate::objects) fn field(
        &mut self,
        low: V,
        high: V,
        cell: f64,
        tile: f64,
        field: impl Fn(V) -> f64,
        paint: impl Fn(V) -> u32,
    ) {
        let surface = march(low, high, cell, &field);
        let step = cell * 0.25;
        let slope = |p: V| {
            let axis = |d: V| field(p + d) - field(p - d);
            V::new(axis(V::x() * step), axis(V::y() * step), axis(V::z() * step))
        };
        let normals: Vec<V> = surface.points.iter().map(|p| slope(*p)).collect();
        self.part(true, |a| {
            // One copy of a point for each side from which the texture is laid.
            let mut copies = vec![[None; 3]; surface.points.len()];
            for triangle in surface.triangles {
                let points = triangle.map(|i| surface.points[i as usize]);
                let across = (points[1] - points[0]).cross(&(points[2] - points[0]));
                let side = across.abs().imax();
                let ids = triangle.map(|i| {
                    let (point, normal) = (surface.points[i as usize], normals[i as usize]);
                    *copies[i as usize][side]
                        .get_or_insert_with(|| a.vertex(point, Some(normal), box_uv(point, side, tile)))
                });
                a.triangle(ids, paint(points.iter().sum::<V>() / 3.0));
            }
        });
    }
}

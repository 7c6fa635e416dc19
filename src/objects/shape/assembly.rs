//! A mesh under construction.

use std::ops::Range;
use std::sync::Arc;

use image::{Rgba, RgbaImage};

use crate::objects::frame::{Frame, V};
use crate::objects::paint::{Color, Painter};
use crate::render::{Material, Mesh};

/// Left, top, right and bottom of a part of a texture.
pub(in crate::objects) type UvRect = [f64; 4];

/// The whole texture.
pub(in crate::objects) const WHOLE: UvRect = [0.0, 0.0, 1.0, 1.0];

/// Some triangles that belong together.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::objects) struct Part {
    /// Which.
    pub(in crate::objects) triangles: Range<usize>,
    /// They are the whole surface of a solid.
    pub(in crate::objects) closed: bool,
}

/// A finished mesh and its parts.
pub(in crate::objects) struct Built {
    /// The mesh; triangles as the parts say.
    pub(in crate::objects) mesh: Mesh,
    /// In the order in which they were added.
    #[cfg_attr(not(test), expect(dead_code, reason = "the tests hold the parts to what they promise"))]
    pub(in crate::objects) parts: Vec<Part>,
}

/// A texture to be painted.
struct Paint {
    size_px: (u32, u32),
    painter: Painter,
}

/// A mesh under construction: parts are added at the current place.
pub(in crate::objects) struct Assembly {
    /// Where parts are put.
    pub(in crate::objects) at: Frame,
    mesh: Mesh,
    paints: Vec<Paint>,
    parts: Vec<Part>,
}

impl Assembly {
    /// Nothing yet.
    pub(in crate::objects) fn new() -> Self {
        Self { at: Frame::identity(), mesh: Mesh::default(), paints: Vec::new(), parts: Vec::new() }
    }

    /// A texture for parts to come, `size_px` texels wide and high.
    pub(in crate::objects) fn paint(&mut self, size_px: (u32, u32), painter: Painter) -> u32 {
        self.paints.push(Paint { size_px, painter });
        self.paints.len() as u32 - 1
    }

    /// One colour for parts to come.
    pub(in crate::objects) fn plain(&mut self, color: Color) -> u32 {
        self.paint((2, 2), Box::new(move |_, _| color))
    }

    /// Adds a part: all that `build` adds. `closed` promises that it is the whole surface of a solid.
    pub(in crate::objects) fn part(&mut self, closed: bool, build: impl FnOnce(&mut Self)) {
        let from = self.mesh.triangles.len();
        build(self);
        self.parts.push(Part { triangles: from..self.mesh.triangles.len(), closed });
    }

    /// Adds what `build` adds at `frame`, then goes back to the present place.
    pub(in crate::objects) fn within(&mut self, frame: Frame, build: impl FnOnce(&mut Self)) {
        let before = std::mem::replace(&mut self.at, frame);
        build(self);
        self.at = before;
    }

    /// Takes over another assembly, put at `frame` of the present place.
    pub(in crate::objects) fn add(&mut self, other: Assembly, frame: Frame) {
        let place = self.at.after(frame);
        let (vertices, triangles) = (self.mesh.positions.len() as u32, self.mesh.triangles.len());
        let paints = self.paints.len() as u32;
        let far = |p: [f32; 3]| place.point(V::from(p.map(f64::from)));
        self.mesh.positions.extend(other.mesh.positions.iter().map(|p| single(far(*p))));
        self.mesh.normals.extend(other.mesh.normals.iter().map(|n| {
            let turned = far(*n) - far([0.0; 3]);
            turned.try_normalize(1e-12).map_or([0.0; 3], single)
        }));
        self.mesh.uvs.extend(other.mesh.uvs);
        let mirrored = place.mirrors();
        self.mesh.triangles.extend(other.mesh.triangles.iter().map(|t| {
            let [a, b, c] = t.map(|i| i + vertices);
            if mirrored { [a, c, b] } else { [a, b, c] }
        }));
        self.mesh.triangle_materials.extend(other.mesh.triangle_materials.iter().map(|m| m + paints));
        self.paints.extend(other.paints);
        self.parts.extend(other.parts.into_iter().map(|part| Part {
            triangles: part.triangles.start + triangles..part.triangles.end + triangles,
            ..part
        }));
    }

    /// Lowest and highest corner of what there is, in the object's frame.
    pub(in crate::objects) fn bounds(&self) -> [V; 2] {
        let mut bounds = [V::repeat(f64::MAX), V::repeat(f64::MIN)];
        for p in &self.mesh.positions {
            let p = V::from(p.map(f64::from));
            bounds = [bounds[0].inf(&p), bounds[1].sup(&p)];
        }
        if self.mesh.positions.is_empty() { [V::zeros(); 2] } else { bounds }
    }

    /// Adds a vertex. Without a normal it gets one from its triangles, in the end.
    pub(in crate::objects) fn vertex(&mut self, point: V, normal: Option<V>, uv: [f64; 2]) -> u32 {
        self.mesh.positions.push(single(self.at.point(point)));
        let normal = normal.and_then(|n| (self.at.point(n) - self.at.point(V::zeros())).try_normalize(1e-12));
        self.mesh.normals.push(normal.map_or([0.0; 3], single));
        self.mesh.uvs.push(uv.map(|c| c as f32));
        self.mesh.positions.len() as u32 - 1
    }

    /// Adds a triangle whose corners run anticlockwise as seen from outside; none where two corners meet.
    pub(in crate::objects) fn triangle(&mut self, [a, b, c]: [u32; 3], paint: u32) {
        let at = |i: u32| self.mesh.positions.get(i as usize).map(|p| p.map(|v| v + 0.0));
        if at(a) == at(b) || at(b) == at(c) || at(c) == at(a) {
            return;
        }
        self.mesh.triangles.push(if self.at.mirrors() { [a, c, b] } else { [a, b, c] });
        self.mesh.triangle_materials.push(paint);
    }

    /// A skin over rings of equally many points: ring after ring runs along v, the points of a ring along u.
    /// Seen from outside, u goes right and v goes down. `round` joins each ring's end to its start.
    pub(in crate::objects) fn skin(&mut self, rings: &[Vec<V>], round: bool, uv: UvRect, paint: u32) {
        let columns = rings.first().map_or(0, Vec::len);
        if columns < 2 || rings.iter().any(|ring| ring.len() != columns) {
            return;
        }
        let across = if round { columns + 1 } else { columns };
        let longest =
            rings.iter().map(|ring| around(ring, across)).max_by(|a, b| last(a).total_cmp(&last(b)));
        let u = shares(longest.unwrap_or_default());
        let v = shares(along(rings));
        let first = self.mesh.positions.len() as u32;
        for (ring, v) in rings.iter().zip(&v) {
            for (point, u) in ring.iter().cycle().zip(&u) {
                self.vertex(*point, None, [uv[0] + (uv[2] - uv[0]) * u, uv[1] + (uv[3] - uv[1]) * v]);
            }
        }
        let across = across as u32;
        for j in 0..rings.len() as u32 - 1 {
            for i in 0..across - 1 {
                let a = first + j * across + i;
                let (b, c, d) = (a + 1, a + across, a + across + 1);
                self.triangle([a, c, b], paint);
                self.triangle([b, c, d], paint);
            }
        }
    }

    /// Closes a convex or star-shaped ring by a fan about its mean; the ring runs anticlockwise as seen from
    /// outside when `outward`, clockwise otherwise. The texture lies flat over the ring's box in its two longer axes.
    pub(in crate::objects) fn fan(&mut self, ring: &[V], outward: bool, uv: UvRect, paint: u32) {
        let middle = ring.iter().sum::<V>() / ring.len().max(1) as f64;
        let flat = Flat::over(ring, uv);
        let center = self.vertex(middle, None, flat.uv(&middle));
        let rim: Vec<u32> = ring.iter().map(|p| self.vertex(*p, None, flat.uv(p))).collect();
        for (i, a) in rim.iter().enumerate() {
            let b = rim[(i + 1) % rim.len()];
            self.triangle(if outward { [center, *a, b] } else { [center, b, *a] }, paint);
        }
    }

    /// Paints the textures, `detail` of 1 at their full size, and gives out the mesh. Vertices lack normals
    /// until [`Mesh::repair`].
    pub(in crate::objects) fn finish(mut self, detail: f64) -> Built {
        self.mesh.materials = self.paints.iter().map(|paint| painted(paint, detail)).collect();
        Built { mesh: self.mesh, parts: self.parts }
    }
}

/// Lays a texture flat over points.
struct Flat {
    axes: [usize; 2],
    low: V,
    size: V,
    uv: UvRect,
}

impl Flat {
    fn over(points: &[V], uv: UvRect) -> Self {
        let (mut low, mut high) = (V::repeat(f64::MAX), V::repeat(f64::MIN));
        for p in points {
            (low, high) = (low.inf(p), high.sup(p));
        }
        let size = (high - low).map(|s| s.max(1e-9));
        let thin = size.imin();
        let axes = [[1, 2], [0, 2], [0, 1]].get(thin).copied().unwrap_or([0, 1]);
        Self { axes, low, size, uv }
    }

    fn uv(&self, p: &V) -> [f64; 2] {
        let share = self.axes.map(|k| (p[k] - self.low[k]) / self.size[k]);
        let [u0, v0, u1, v1] = self.uv;
        [u0 + (u1 - u0) * share[0], v1 + (v0 - v1) * share[1]]
    }
}

fn painted(paint: &Paint, detail: f64) -> Material {
    let scaled = |side: u32| ((f64::from(side) * detail) as u32).clamp(2, side.max(2));
    let (width, height) = (scaled(paint.size_px.0), scaled(paint.size_px.1));
    let image = RgbaImage::from_fn(width, height, |x, y| {
        let uv = [(x as f32 + 0.5) / width as f32, (y as f32 + 0.5) / height as f32];
        let [r, g, b] = (paint.painter)(uv[0], uv[1]).map(|c| (c.clamp(0.0, 1.0) * 255.0 + 0.5) as u8);
        Rgba([r, g, b, 255])
    });
    Material { color: [1.0; 3], texture: Some(Arc::new(image)), ..Material::default() }
}

fn single(p: V) -> [f32; 3] {
    [p.x as f32, p.y as f32, p.z as f32]
}

/// Length along a ring up to each of its points, back to the first when `across` counts one more.
fn around(ring: &[V], across: usize) -> Vec<f64> {
    let mut length = 0.0;
    let mut lengths = vec![0.0];
    for i in 1..across {
        length += (ring[i % ring.len()] - ring[i - 1]).norm();
        lengths.push(length);
    }
    lengths
}

/// Mean length from the first ring to each.
fn along(rings: &[Vec<V>]) -> Vec<f64> {
    let mut length = 0.0;
    let mut lengths = vec![0.0];
    for pair in rings.windows(2) {
        let sum: f64 = pair[0].iter().zip(&pair[1]).map(|(a, b)| (b - a).norm()).sum();
        length += sum / pair[0].len() as f64;
        lengths.push(length);
    }
    lengths
}

fn last(lengths: &[f64]) -> f64 {
    lengths.last().copied().unwrap_or_default()
}

fn shares(lengths: Vec<f64>) -> Vec<f64> {
    let whole = last(&lengths).max(1e-12);
    lengths.into_iter().map(|l| l / whole).collect()
}

//! The colour of a point on a triangle.

use super::light::PreparedLight;
use super::project::InCamera;

/// A triangle's plane seen from the camera's centre: gives barycentric coordinates of the
/// point a ray hits, and how they change from pixel to pixel.
///
/// Corners p, p + e1, p + e2 and a ray d meet where u = d.(e2 x p) / d.n and
/// v = d.(p x e1) / d.n with n = e1 x e2 (Cramer's rule; the ray starts at the origin). All
/// three products are linear in d, so perspective is right everywhere and corners behind
/// the camera do no harm.
pub(super) struct Facet {
    u: [f32; 3],
    v: [f32; 3],
    /// Not a unit vector; camera frame.
    normal: [f32; 3],
}

/// Where a ray meets a facet.
pub(super) struct Hit {
    /// Weights of the three corners: in 0..1, sum 1.
    pub(super) weights: [f32; 3],
    /// Change of (u, v), the weights of the second and third corner, one pixel to the right.
    right: [f32; 2],
    /// The same one pixel down.
    down: [f32; 2],
    /// True when the ray meets the side from which the corners run clockwise.
    pub(super) from_behind: bool,
}

impl Facet {
    #[inline]
    pub(super) fn new([p, q, r]: [InCamera; 3]) -> Self {
        let (e1, e2) = (minus(q, p), minus(r, p));
        Self { u: cross(e2, p), v: cross(p, e1), normal: cross(e1, e2) }
    }

    /// The weights of the second and third corner where a ray meets the facet's plane.
    #[inline]
    pub(super) fn weights(&self, ray: [f32; 3]) -> [f32; 2] {
        let along = dot(self.normal, ray);
        let inverse = if along.abs() > 1e-30 { 1.0 / along } else { 0.0 };
        [dot(self.u, ray) * inverse, dot(self.v, ray) * inverse]
    }

    /// `ray` has z = 1; `step` is its change in x and y per pixel.
    #[inline]
    pub(super) fn hit(&self, ray: [f32; 3], step: [f32; 2]) -> Hit {
        let along = dot(self.normal, ray);
        let inverse = if along.abs() > 1e-30 { 1.0 / along } else { 0.0 };
        let (u, v) = (dot(self.u, ray) * inverse, dot(self.v, ray) * inverse);
        let change = |k: usize| {
            let n = self.normal[k] * inverse;
            let s = step[k];
            [(self.u[k] * inverse - u * n) * s, (self.v[k] * inverse - v * n) * s]
        };
        let (right, down) = (change(0), change(1));
        // A pixel's mean sample may lie a little outside a sliver.
        let (u, v) = (u.clamp(0.0, 1.0), v.clamp(0.0, 1.0));
        let outside = (u + v).max(1.0);
        let (u, v) = (u / outside, v / outside);
        Hit { weights: [(1.0 - u - v).max(0.0), u, v], right, down, from_behind: along > 0.0 }
    }
}

impl Hit {
    /// Texture coordinates at the hit, and their change to the right and lower neighbour pixel.
    #[inline]
    pub(super) fn on_texture(&self, uv: [[f32; 2]; 3]) -> [[f32; 2]; 3] {
        let at =
            |k: usize| self.weights[0] * uv[0][k] + self.weights[1] * uv[1][k] + self.weights[2] * uv[2][k];
        let (a, b) = ([uv[1][0] - uv[0][0], uv[1][1] - uv[0][1]], [uv[2][0] - uv[0][0], uv[2][1] - uv[0][1]]);
        let change = |d: [f32; 2]| [a[0] * d[0] + b[0] * d[1], a[1] * d[0] + b[1] * d[1]];
        [[at(0), at(1)], change(self.right), change(self.down)]
    }

    /// Light at the hit. `normals` are the corners' (world frame); `turned` tells that they
    /// point to the side from which the corners run clockwise.
    #[inline]
    pub(super) fn light(&self, light: &PreparedLight, normals: [[f32; 3]; 3], turned: bool) -> f32 {
        let n: [f32; 3] = std::array::from_fn(|k| {
            self.weights[0] * normals[0][k]
                + self.weights[1] * normals[1][k]
                + self.weights[2] * normals[2][k]
        });
        let length = dot(n, n).sqrt();
        // Both sides are drawn: the normal is the one that faces the camera.
        let sign = if self.from_behind == turned { 1.0 } else { -1.0 };
        let scale = if length > 0.0 { sign / length } else { 0.0 };
        light.at(n.map(|v| v * scale))
    }
}

#[inline]
pub(super) fn dot(a: [f32; 3], b: [f32; 3]) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline]
pub(super) fn minus(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

#[inline]
pub(super) fn cross(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

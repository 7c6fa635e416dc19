//! Building blocks of the sample objects.

use std::f32::consts::TAU;

use nalgebra::{Isometry3, Point3, Rotation3, Translation3, UnitQuaternion, Vector3};

use crate::render::{Material, Mesh};

/// Left, top, right and bottom of a part of a texture.
pub(super) type UvRect = [f32; 4];

/// The whole texture.
pub(super) const WHOLE: UvRect = [0.0, 0.0, 1.0, 1.0];

/// A mesh under construction; parts are added under the current placement.
pub(super) struct Builder {
    mesh: Mesh,
    /// Where parts are put.
    pub(super) at: Isometry3<f32>,
}

/// Turned about z and moved.
pub(super) fn placed(x: f32, y: f32, z: f32, turn_rad: f32) -> Isometry3<f32> {
    Isometry3::from_parts(
        Translation3::new(x, y, z),
        UnitQuaternion::from_axis_angle(&Vector3::z_axis(), turn_rad),
    )
}

impl Builder {
    pub(super) fn new() -> Self {
        Self { mesh: Mesh::default(), at: Isometry3::identity() }
    }

    pub(super) fn finish(self) -> Mesh {
        self.mesh
    }

    pub(super) fn material(&mut self, material: Material) -> u32 {
        self.mesh.materials.push(material);
        self.mesh.materials.len() as u32 - 1
    }

    /// A surface of `columns` x `rows` cells; `point(i, j)` for i up to `columns`, j up to `rows`.
    /// The texture's part `uv` is laid over it, i along u, j along v.
    pub(super) fn grid(
        &mut self,
        (columns, rows): (u32, u32),
        uv: UvRect,
        material: u32,
        point: impl Fn(u32, u32) -> [f32; 3],
    ) {
        let first = self.mesh.positions.len() as u32;
        for j in 0..=rows {
            for i in 0..=columns {
                let p = self.at * Point3::from(point(i, j));
                self.mesh.positions.push(p.into());
                let (s, t) = (i as f32 / columns as f32, j as f32 / rows as f32);
                self.mesh.uvs.push([uv[0] + (uv[2] - uv[0]) * s, uv[1] + (uv[3] - uv[1]) * t]);
            }
        }
        for j in 0..rows {
            for i in 0..columns {
                let a = first + j * (columns + 1) + i;
                let (b, c, d) = (a + 1, a + columns + 1, a + columns + 2);
                self.mesh.triangles.extend([[a, c, b], [b, c, d]]);
                self.mesh.triangle_materials.extend([material; 2]);
            }
        }
    }

    /// A surface of revolution about z: `profile` are (radius, height) from top to bottom, seen
    /// from outside. The texture's left edge lies at -y and u runs to the right as seen from there.
    pub(super) fn lathe(&mut self, around: u32, profile: &[[f32; 2]], uv: UvRect, material: u32) {
        let rows = (profile.len() as u32).saturating_sub(1);
        self.grid((around, rows), uv, material, |i, j| {
            // The last column is the first: the same bits, so that normals meet over the seam.
            let angle = TAU * ((i % around) as f32 / around as f32) - TAU / 4.0;
            let [r, z] = profile.get(j as usize).copied().unwrap_or_default();
            [r * angle.cos(), r * angle.sin(), z]
        });
        // Along the profile the texture is laid by length, not by the spacing of its points.
        let mut along = vec![0.0f32];
        for pair in profile.windows(2) {
            if let ([a, b], Some(length)) = (pair, along.last().copied()) {
                along.push(length + (b[0] - a[0]).hypot(b[1] - a[1]));
            }
        }
        let whole = along.last().copied().unwrap_or_default().max(1e-9);
        let from = self.mesh.uvs.len().saturating_sub(along.len() * (around as usize + 1));
        for (row, length) in self.mesh.uvs[from..].chunks_exact_mut(around as usize + 1).zip(&along) {
            row.iter_mut().for_each(|[_, v]| *v = uv[1] + (uv[3] - uv[1]) * length / whole);
        }
    }

    /// A round tube about a path; u runs around it, v along it.
    pub(super) fn tube(
        &mut self,
        (around, along): (u32, u32),
        material: u32,
        path: impl Fn(f32) -> [f32; 3],
        radius: impl Fn(f32) -> f32,
    ) {
        let at = |t: f32| Vector3::from(path(t));
        self.grid((around, along), WHOLE, material, |i, j| {
            let t = j as f32 / along as f32;
            let direction = (at(t + 1e-3) - at(t - 1e-3)).normalize();
            let across = if direction.y.abs() < 0.9 { Vector3::y() } else { Vector3::x() };
            let side = direction.cross(&across).normalize();
            let up = side.cross(&direction);
            let angle = TAU * ((i % around) as f32 / around as f32);
            (at(t) + (side * angle.cos() + up * angle.sin()) * radius(t)).into()
        });
    }

    /// A box from `low` to `high`. `uvs` are the texture's parts for front (-y), right (+x),
    /// back (+y), left (-x), top and bottom, each upright as seen from outside.
    pub(super) fn cuboid(&mut self, low: [f32; 3], high: [f32; 3], uvs: [UvRect; 6], material: u32) {
        let ([x0, y0, z0], [x1, y1, z1]) = (low, high);
        // Top left corner, then the steps to the right and down.
        let faces = [
            ([x0, y0, z1], [x1 - x0, 0.0, 0.0], [0.0, 0.0, z0 - z1]),
            ([x1, y0, z1], [0.0, y1 - y0, 0.0], [0.0, 0.0, z0 - z1]),
            ([x1, y1, z1], [x0 - x1, 0.0, 0.0], [0.0, 0.0, z0 - z1]),
            ([x0, y1, z1], [0.0, y0 - y1, 0.0], [0.0, 0.0, z0 - z1]),
            ([x0, y1, z1], [x1 - x0, 0.0, 0.0], [0.0, y0 - y1, 0.0]),
            ([x0, y0, z0], [x1 - x0, 0.0, 0.0], [0.0, y1 - y0, 0.0]),
        ];
        const CELLS: u32 = 4;
        for ((corner, right, down), uv) in faces.into_iter().zip(uvs) {
            self.grid((CELLS, CELLS), uv, material, |i, j| {
                let (s, t) = (i as f32 / CELLS as f32, j as f32 / CELLS as f32);
                std::array::from_fn(|k| corner[k] + right[k] * s + down[k] * t)
            });
        }
    }

    /// A ball.
    pub(super) fn ball(&mut self, center: [f32; 3], radius: f32, cells: u32, material: u32) {
        let profile: Vec<[f32; 2]> = (0..=cells)
            .map(|j| {
                let angle = 0.5 * TAU * j as f32 / cells as f32;
                [radius * angle.sin().max(0.0), center[2] + radius * angle.cos()]
            })
            .collect();
        let before = self.at;
        self.at *= Translation3::new(center[0], center[1], 0.0);
        self.lathe(2 * cells, &profile, WHOLE, material);
        self.at = before;
    }

    /// Leans the placement by an angle about x (its top towards -y for positive angles).
    pub(super) fn lean(&mut self, angle_rad: f32) {
        self.at *=
            UnitQuaternion::from_rotation_matrix(&Rotation3::from_axis_angle(&Vector3::x_axis(), angle_rad));
    }
}

/// Rounds a polyline profile: each inner corner is cut twice (Chaikin), ends stay.
pub(super) fn rounded(profile: &[[f32; 2]]) -> Vec<[f32; 2]> {
    let mut points = profile.to_vec();
    for _ in 0..2 {
        let mut next = Vec::with_capacity(points.len() * 2);
        next.extend(points.first());
        for pair in points.windows(2) {
            if let [a, b] = pair {
                next.push([0.75 * a[0] + 0.25 * b[0], 0.75 * a[1] + 0.25 * b[1]]);
                next.push([0.25 * a[0] + 0.75 * b[0], 0.25 * a[1] + 0.75 * b[1]]);
            }
        }
        next.extend(points.last());
        points = next;
    }
    points
}

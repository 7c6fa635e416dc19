//! The triangle mesh every loader makes and the renderer takes.

use std::sync::Arc;

use image::RgbaImage;
use nalgebra::{Matrix3, Vector3};

use super::bounding_sphere::bounding_sphere;
use super::normals;
use crate::geometry::Point;

/// A textured triangle mesh, z up.
///
/// `positions`, `normals` and `uvs` have one entry a vertex (the loaders see to it:
/// [`Mesh::repair`]); `triangles` and `triangle_materials` one a triangle.
#[derive(Clone, Debug, Default)]
pub struct Mesh {
    /// Vertex positions; metres once fitted.
    pub positions: Vec<[f32; 3]>,
    /// Unit vertex normals. Empty until [`Mesh::repair`] makes them.
    pub normals: Vec<[f32; 3]>,
    /// Texture coordinates; (0, 0) is the texture's top left corner, v runs down. Empty for none.
    pub uvs: Vec<[f32; 2]>,
    /// Vertex indices; either winding, as both sides are drawn.
    pub triangles: Vec<[u32; 3]>,
    /// Index into `materials` for each triangle.
    pub triangle_materials: Vec<u32>,
    /// Materials.
    pub materials: Vec<Material>,
    /// What went wrong without being fatal while the mesh was loaded.
    pub warnings: Vec<MeshWarning>,
}

/// A surface's colour.
#[derive(Clone, Debug)]
pub struct Material {
    /// Name in the file, for messages.
    pub name: String,
    /// Diffuse colour, linear (not sRGB), 0 to 1; multiplies the texture.
    pub color: [f32; 3],
    /// 1 for opaque. Below [`Material::INVISIBLE_BELOW`] the surface is left out, otherwise it
    /// is drawn as if opaque: what is behind glass does not shine through.
    pub opacity: f32,
    /// sRGB texture with straight alpha.
    pub texture: Option<Arc<RgbaImage>>,
    /// The texture's alpha below which the surface has a hole (cut-out); 0 ignores the alpha.
    pub alpha_cutoff: f32,
}

impl Default for Material {
    fn default() -> Self {
        Self { name: String::new(), color: [0.8; 3], opacity: 1.0, texture: None, alpha_cutoff: 0.5 }
    }
}

impl Material {
    /// Surfaces of less opacity than this are not drawn.
    pub const INVISIBLE_BELOW: f32 = 0.15;
}

/// A problem that does not stop a mesh from being used.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum MeshWarning {
    /// A texture is named but is not there or cannot be decoded; the colour is used alone.
    #[error("material {material}: texture {texture} is not used: {reason}")]
    Texture {
        /// The material's name.
        material: String,
        /// The texture's name as written in the file.
        texture: String,
        /// What is wrong with it.
        reason: String,
    },
    /// The material file is missing or broken: a plain grey is used.
    #[error("materials are not used: {reason}")]
    Materials {
        /// What is wrong.
        reason: String,
    },
    /// Triangles with indices out of range, NaN or infinite corners were left out.
    #[error("{count} of {of} triangles have corners that do not exist or are not finite and are left out")]
    BrokenTriangles {
        /// Triangles left out.
        count: usize,
        /// Triangles in the file.
        of: usize,
    },
    /// Every material is all but clear, so they are drawn opaque instead of nothing.
    #[error("all materials are nearly clear; they are drawn opaque")]
    AllClear,
}

impl Mesh {
    /// Makes the mesh consistent: drops triangles whose corners are missing or not finite,
    /// makes normals where they are missing or zero, cuts or fills texture coordinates and material
    /// indices, and makes clear materials opaque if all are clear. Notes what it did in `warnings`.
    pub fn repair(&mut self) {
        let finite = |i: &u32| {
            self.positions.get(*i as usize).is_some_and(|p| p.iter().all(|v| v.is_finite() && v.abs() < 1e15))
        };
        let keep: Vec<bool> = self.triangles.iter().map(|t| t.iter().all(finite)).collect();
        let (of, kept) = (keep.len(), keep.iter().filter(|k| **k).count());
        self.triangle_materials.resize(of, 0);
        if kept < of {
            let mut flags = keep.iter();
            self.triangles.retain(|_| *flags.next().unwrap_or(&false));
            let mut flags = keep.iter();
            self.triangle_materials.retain(|_| *flags.next().unwrap_or(&false));
            self.warnings.push(MeshWarning::BrokenTriangles { count: of - kept, of });
        }
        if self.materials.is_empty() {
            self.materials.push(Material::default());
        }
        let last = self.materials.len() as u32 - 1;
        for material in &mut self.triangle_materials {
            *material = (*material).min(last);
        }
        if !self.uvs.is_empty() {
            self.uvs.resize(self.positions.len(), [0.0; 2]);
            for uv in self.uvs.iter_mut().flatten().filter(|v| !v.is_finite() || v.abs() > 1e6) {
                *uv = 0.0;
            }
        }
        if self.materials.iter().all(|m| m.opacity < Material::INVISIBLE_BELOW) {
            self.materials.iter_mut().for_each(|m| m.opacity = 1.0);
            self.warnings.push(MeshWarning::AllClear);
        }
        normals::complete(self);
    }

    /// The mesh moved and scaled so that its bounding sphere has the given centre (world
    /// frame) and radius in metres. A mesh without extent is only moved.
    pub fn fitted(&self, center: Point, radius_m: f64) -> Mesh {
        let sphere = bounding_sphere(self);
        let scale = if sphere.radius > 0.0 { radius_m / sphere.radius } else { 1.0 };
        let mut mesh = self.clone();
        for p in &mut mesh.positions {
            let q = center + (Point::from(p.map(f64::from)) - sphere.center) * scale;
            *p = [q.x as f32, q.y as f32, q.z as f32];
        }
        mesh
    }

    /// Applies a linear map to positions and its inverse transpose to normals; used by
    /// loaders to turn y up into z up, and to stretch furniture to its catalogue size.
    pub(super) fn map_linear(&mut self, map: &Matrix3<f32>) {
        let for_normals = map.try_inverse().map_or(*map, |inverse| inverse.transpose());
        for p in &mut self.positions {
            *p = (map * Vector3::from(*p)).into();
        }
        for n in &mut self.normals {
            *n = (for_normals * Vector3::from(*n)).try_normalize(0.0).unwrap_or_default().into();
        }
    }

    /// Turns a y-up mesh (x right, y up, z towards the viewer) into our z-up world:
    /// x stays, the file's z becomes -y, so a front that faced +z faces -y.
    pub(super) fn turn_y_up_to_z_up(&mut self) {
        for v in self.positions.iter_mut().chain(&mut self.normals) {
            let [x, y, z] = *v;
            *v = [x, -z, y];
        }
    }

    /// How many different colours the drawn surfaces have, counting only plain materials.
    pub(crate) fn plain_colours(&self) -> usize {
        let mut colours: Vec<[u32; 3]> = self
            .triangle_materials
            .iter()
            .filter_map(|i| self.materials.get(*i as usize))
            .filter(|m| m.texture.is_none())
            .map(|m| m.color.map(|c| (c * 255.0) as u32))
            .collect();
        colours.sort_unstable();
        colours.dedup();
        colours.len()
    }

    /// True when a drawn surface has a texture and coordinates to place it.
    pub(crate) fn has_texture(&self) -> bool {
        !self.uvs.is_empty()
            && self
                .triangle_materials
                .iter()
                .any(|i| self.materials.get(*i as usize).is_some_and(|m| m.texture.is_some()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn broken_corners_are_dropped_and_counted() {
        let mut mesh = Mesh {
            positions: vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [f32::NAN, 0.0, 0.0]],
            triangles: vec![[0, 1, 2], [0, 1, 3], [0, 1, 9]],
            triangle_materials: vec![7],
            ..Mesh::default()
        };
        mesh.repair();
        assert_eq!(mesh.triangles, [[0, 1, 2]]);
        assert_eq!(mesh.triangle_materials, [0]);
        assert_eq!(mesh.warnings, [MeshWarning::BrokenTriangles { count: 2, of: 3 }]);
        assert_eq!(mesh.normals.len(), 4);
    }

    #[test]
    fn a_fitted_mesh_touches_its_sphere_and_stays_inside() {
        let center = Point::new(0.4, -0.1, 0.08);
        let mesh = super::super::sample_object("robot").unwrap().fitted(center, 0.1);
        let far = mesh
            .triangles
            .iter()
            .flatten()
            .map(|i| (Point::from(mesh.positions[*i as usize].map(f64::from)) - center).norm())
            .fold(0.0, f64::max);
        assert!((far - 0.1).abs() < 1e-6, "{far}");
    }
}

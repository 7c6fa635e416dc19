//! glTF 2.0, text (.gltf) and binary (.glb).

use std::sync::Arc;

use base64::Engine;
use gltf::buffer::Source as BufferSource;
use gltf::image::Source as ImageSource;
use gltf::mesh::Mode;
use image::RgbaImage;
use nalgebra::{Matrix3, Matrix4, Point3, Vector3};

use super::MeshError;
use super::files::Files;
use crate::imaging::{DEFAULT_MAX_PIXELS, decode_image};
use crate::render::{Material, Mesh, MeshWarning};

/// Loads all meshes of the default scene (of all scenes, if none is the default), each under
/// its node's transform, and turns them z-up. Skins, morph targets, cameras and lights are left out.
pub(super) fn load(name: &str, bytes: &[u8], files: &dyn Files) -> Result<Mesh, MeshError> {
    let broken = |reason: String| MeshError::Broken { name: name.to_owned(), reason };
    let gltf::Gltf { document, blob } = gltf::Gltf::from_slice(bytes).map_err(|e| broken(e.to_string()))?;
    let mut blob = blob;
    let mut buffers = Vec::new();
    for buffer in document.buffers() {
        let bytes = match buffer.source() {
            BufferSource::Bin => {
                blob.take().ok_or_else(|| broken("its binary chunk is missing".to_owned()))?
            }
            BufferSource::Uri(uri) => {
                read_uri(uri, files).map_err(|reason| broken(format!("buffer {uri:.80}: {reason}")))?
            }
        };
        if bytes.len() < buffer.length() {
            return Err(broken(format!("a buffer has {} bytes instead of {}", bytes.len(), buffer.length())));
        }
        buffers.push(bytes);
    }
    let mut reading = Reading { buffers, files, mesh: Mesh::default(), images: Vec::new() };
    reading.materials(&document);
    let scenes = match document.default_scene() {
        Some(scene) => vec![scene],
        None => document.scenes().collect(),
    };
    for node in scenes.iter().flat_map(|s| s.nodes()) {
        reading.node(&node, &Matrix4::identity(), 0);
    }
    reading.mesh.turn_y_up_to_z_up();
    Ok(reading.mesh)
}

/// Deeper trees than this are cut off: a file whose nodes form a circle must come to an end.
const MAX_DEPTH: u32 = 64;
/// A file may show one mesh at many nodes: no more triangles than this in all.
const MAX_TRIANGLES: usize = 20_000_000;

struct Reading<'a> {
    buffers: Vec<Vec<u8>>,
    files: &'a dyn Files,
    mesh: Mesh,
    images: Vec<Option<Arc<RgbaImage>>>,
}

impl Reading<'_> {
    fn materials(&mut self, document: &gltf::Document) {
        self.images = vec![None; document.images().len()];
        let mut tried = vec![false; self.images.len()];
        for material in document.materials() {
            let pbr = material.pbr_metallic_roughness();
            let label = material.name().unwrap_or("unnamed").to_owned();
            let texture = pbr.base_color_texture().and_then(|info| {
                let image = info.texture().source();
                let i = image.index();
                if !std::mem::replace(tried.get_mut(i)?, true) {
                    match self.image(&image) {
                        Ok(decoded) => self.images[i] = Some(Arc::new(decoded)),
                        Err(reason) => self.mesh.warnings.push(MeshWarning::Texture {
                            material: label.clone(),
                            texture: image.name().map_or(format!("image {i}"), str::to_owned),
                            reason,
                        }),
                    }
                }
                self.images.get(i)?.clone()
            });
            let [r, g, b, a] = pbr.base_color_factor();
            let (opacity, alpha_cutoff) = match material.alpha_mode() {
                gltf::material::AlphaMode::Opaque => (1.0, 0.0),
                gltf::material::AlphaMode::Mask => (a, material.alpha_cutoff().unwrap_or(0.5)),
                gltf::material::AlphaMode::Blend => (a, 0.5),
            };
            self.mesh.materials.push(Material {
                name: label,
                color: [r, g, b],
                opacity,
                texture,
                alpha_cutoff,
            });
        }
        let name = "none".to_owned();
        self.mesh.materials.push(Material { name, ..Material::default() });
    }

    fn image(&self, image: &gltf::Image<'_>) -> Result<RgbaImage, String> {
        let decode = |bytes: &[u8]| decode_image(bytes, DEFAULT_MAX_PIXELS).map_err(|e| e.to_string());
        match image.source() {
            ImageSource::Uri { uri, .. } => decode(&read_uri(uri, self.files)?),
            ImageSource::View { view, .. } => {
                let (start, length) = (view.offset(), view.length());
                let bytes = self.buffers.get(view.buffer().index());
                decode(
                    bytes
                        .and_then(|b| b.get(start..start.checked_add(length)?))
                        .ok_or("it is out of range")?,
                )
            }
        }
    }

    fn node(&mut self, node: &gltf::Node<'_>, parent: &Matrix4<f32>, depth: u32) {
        let world = parent * Matrix4::from(node.transform().matrix());
        for primitive in node.mesh().iter().flat_map(|m| m.primitives()) {
            self.primitive(&primitive, &world);
        }
        if depth < MAX_DEPTH {
            for child in node.children() {
                self.node(&child, &world, depth + 1);
            }
        }
    }

    fn primitive(&mut self, primitive: &gltf::Primitive<'_>, world: &Matrix4<f32>) {
        let reader = primitive.reader(|buffer| self.buffers.get(buffer.index()).map(Vec::as_slice));
        let Some(positions) = reader.read_positions() else { return };
        let first = self.mesh.positions.len();
        let linear: Matrix3<f32> = world.fixed_view::<3, 3>(0, 0).into();
        let for_normals = linear.try_inverse().map_or(linear, |m| m.transpose());
        self.mesh
            .positions
            .extend(positions.map(|p| <[f32; 3]>::from(world.transform_point(&Point3::from(p)))));
        let count = self.mesh.positions.len();
        if let Some(normals) = reader.read_normals() {
            self.mesh.normals.extend(normals.map(|n| <[f32; 3]>::from(for_normals * Vector3::from(n))));
        }
        self.mesh.normals.resize(count, [0.0; 3]);
        let set =
            primitive.material().pbr_metallic_roughness().base_color_texture().map_or(0, |t| t.tex_coord());
        if let Some(uvs) = reader.read_tex_coords(set) {
            self.mesh.uvs.extend(uvs.into_f32());
        }
        self.mesh.uvs.resize(count, [0.0; 2]);
        let indices: Vec<u32> = match reader.read_indices() {
            Some(indices) => indices.into_u32().collect(),
            None => (0..(count - first) as u32).collect(),
        };
        let corner = |i: &u32| i.saturating_add(first as u32);
        let room = MAX_TRIANGLES.saturating_sub(self.mesh.triangles.len());
        let triangles: Vec<[u32; 3]> = match primitive.mode() {
            Mode::Triangles => indices.as_chunks::<3>().0.iter().map(|t| t.each_ref().map(corner)).collect(),
            Mode::TriangleStrip => indices
                .windows(3)
                .enumerate()
                .filter_map(|(i, w)| match w {
                    [a, b, c] if i % 2 == 0 => Some([a, b, c].map(corner)),
                    [a, b, c] => Some([b, a, c].map(corner)),
                    _ => None,
                })
                .collect(),
            Mode::TriangleFan => match indices.split_first() {
                Some((hub, rim)) => rim
                    .windows(2)
                    .filter_map(|w| if let [a, b] = w { Some([hub, a, b].map(corner)) } else { None })
                    .collect(),
                None => Vec::new(),
            },
            Mode::Points | Mode::Lines | Mode::LineLoop | Mode::LineStrip => Vec::new(),
        };
        self.mesh.triangles.extend(triangles.into_iter().take(room));
        let plain = self.mesh.materials.len() - 1;
        let material = primitive.material().index().unwrap_or(plain).min(plain) as u32;
        self.mesh.triangle_materials.resize(self.mesh.triangles.len(), material);
    }
}

/// A `data:` URI's content, or a file beside the model (percent-encoded name).
fn read_uri(uri: &str, files: &dyn Files) -> Result<Vec<u8>, String> {
    let Some(data) = uri.strip_prefix("data:") else { return files.read(&percent_decoded(uri)) };
    let (_, content) = data.split_once(";base64,").ok_or("a data URI that is not base64")?;
    base64::engine::general_purpose::STANDARD.decode(content).map_err(|e| e.to_string())
}

fn percent_decoded(name: &str) -> String {
    let mut bytes = Vec::with_capacity(name.len());
    let mut rest = name.as_bytes();
    while let Some((first, tail)) = rest.split_first() {
        let code = tail
            .get(..2)
            .and_then(|h| std::str::from_utf8(h).ok())
            .and_then(|h| u8::from_str_radix(h, 16).ok());
        match code {
            Some(byte) if *first == b'%' => {
                bytes.push(byte);
                rest = &tail[2..];
            }
            _ => {
                bytes.push(*first);
                rest = tail;
            }
        }
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

//! The renderer: visibility first, then one shading a pixel and triangle.

use std::sync::{Arc, Mutex, PoisonError};

use image::RgbaImage;

use super::closed::{Visible, visible_sides};
use super::cut_out::CutOut;
use super::light::PreparedLight;
use super::project::{InCamera, OnScreen, View};
use super::raster::{NOTHING, Pattern, Samples, Target};
use super::shade::{Facet, cross, dot, minus};
use super::srgb::byte_of_linear;
use super::texture::MipTexture;
use super::{Material, Mesh, RenderSettings};
use crate::geometry::Pose;
use crate::imaging::Camera;

/// The most triangles of a pixel that are shaded; where its samples see more, all smaller than a
/// pixel, these stand for the rest. The samples' order spreads the chosen ones over the pixel.
const MAX_SHADED: u32 = 4;

/// A mesh made ready to be drawn many times: mip levels built, broken and clear triangles
/// left out. Can be shared between threads; each image is drawn by the calling thread alone.
pub struct Renderer {
    positions: Vec<[f32; 3]>,
    attributes: Vec<Attributes>,
    triangles: Vec<Triangle>,
    surfaces: Vec<Surface>,
    textures: Vec<MipTexture>,
    /// Buffers of finished images, so that the next image need not ask for memory.
    scratch: Mutex<Vec<Scratch>>,
}

/// What shading reads of a vertex, side by side in memory.
#[derive(Clone, Copy)]
struct Attributes {
    normal: [f32; 3],
    uv: [f32; 2],
}

struct Triangle {
    corners: [u32; 3],
    surface: u32,
    /// The corners' normals point to the side from which the corners run clockwise.
    turned: bool,
    /// The side that can be seen from outside.
    visible: Visible,
}

struct Surface {
    color: [f32; 3],
    texture: Option<usize>,
    /// Where the texture's alpha is less there is a hole; 0 for none.
    cutoff: f32,
}

#[derive(Default)]
struct Scratch {
    in_camera: Vec<InCamera>,
    on_screen: Vec<OnScreen>,
    depth: Vec<f32>,
    ids: Vec<u32>,
}

impl Renderer {
    /// Prepares a mesh. Any mesh is taken: what is inconsistent in it is repaired first
    /// (see [`Mesh::repair`]).
    pub fn new(mesh: &Mesh) -> Self {
        let mut mesh = mesh.clone();
        mesh.repair();
        mesh.uvs.resize(mesh.positions.len(), [0.0; 2]);
        let mut images: Vec<Arc<RgbaImage>> = Vec::new();
        let mut textures: Vec<MipTexture> = Vec::new();
        let mut surfaces = Vec::with_capacity(mesh.materials.len());
        for material in &mesh.materials {
            let texture = material.texture.as_ref().map(|image| {
                images.iter().position(|known| Arc::ptr_eq(known, image)).unwrap_or_else(|| {
                    images.push(Arc::clone(image));
                    textures.push(MipTexture::new(image));
                    images.len() - 1
                })
            });
            let has_alpha = texture.is_some_and(|i| textures[i].has_alpha);
            let cutoff = if has_alpha { material.alpha_cutoff.clamp(0.0, 0.99) } else { 0.0 };
            surfaces.push(Surface { color: material.color, texture, cutoff });
        }
        let at = |v: &[[f32; 3]], i: u32| v.get(i as usize).copied().unwrap_or_default();
        let mut triangles = Vec::with_capacity(mesh.triangles.len());
        for (corners, material) in mesh.triangles.iter().zip(&mesh.triangle_materials) {
            let drawn = mesh
                .materials
                .get(*material as usize)
                .is_some_and(|m| m.opacity >= Material::INVISIBLE_BELOW);
            let [a, b, c] = corners.map(|i| at(&mesh.positions, i));
            let geometric = cross(minus(b, a), minus(c, a));
            if !drawn || geometric == [0.0; 3] {
                continue;
            }
            let side: f32 = corners.iter().map(|i| dot(geometric, at(&mesh.normals, *i))).sum();
            triangles.push(Triangle {
                corners: *corners,
                surface: *material,
                turned: side < 0.0,
                visible: Visible::Both,
            });
        }
        let corners: Vec<[u32; 3]> = triangles.iter().map(|t| t.corners).collect();
        let hides = |i: usize| surfaces[triangles[i].surface as usize].cutoff == 0.0;
        let visible = visible_sides(&mesh.positions, &corners, hides);
        triangles.iter_mut().zip(visible).for_each(|(triangle, visible)| triangle.visible = visible);
        let Mesh { positions, normals, uvs, .. } = mesh;
        let attributes = normals.into_iter().zip(uvs).map(|(normal, uv)| Attributes { normal, uv }).collect();
        Self { positions, attributes, triangles, surfaces, textures, scratch: Mutex::default() }
    }

    /// Triangles that are drawn.
    pub fn triangle_count(&self) -> usize {
        self.triangles.len()
    }

    /// Draws the mesh as the camera sees it: sRGB with straight alpha, clear where nothing is,
    /// part clear along outlines. The same arguments give the same bytes.
    ///
    /// `camera` must pass [`Camera::check`]; another one may give an empty image. `world_from_camera`
    /// has OpenCV axes.
    pub fn render(&self, camera: &Camera, world_from_camera: &Pose, settings: &RenderSettings) -> RgbaImage {
        let mut scratch =
            self.scratch.lock().unwrap_or_else(PoisonError::into_inner).pop().unwrap_or_default();
        let view = View::new(camera, world_from_camera, settings.near_m);
        let image = match settings.samples_per_pixel {
            0..=1 => self.draw::<1>(camera, &view, settings, &mut scratch),
            2..=4 => self.draw::<4>(camera, &view, settings, &mut scratch),
            5..=8 => self.draw::<8>(camera, &view, settings, &mut scratch),
            9.. => self.draw::<16>(camera, &view, settings, &mut scratch),
        };
        self.scratch.lock().unwrap_or_else(PoisonError::into_inner).push(scratch);
        image
    }

    fn draw<const N: usize>(
        &self,
        camera: &Camera,
        view: &View,
        settings: &RenderSettings,
        scratch: &mut Scratch,
    ) -> RgbaImage
    where
        Samples: Pattern<N>,
    {
        let mut image = RgbaImage::new(camera.width, camera.height);
        let Scratch { in_camera, on_screen, depth, ids } = scratch;
        in_camera.clear();
        in_camera.extend(self.positions.iter().map(|p| view.to_camera(*p)));
        on_screen.clear();
        on_screen.extend(in_camera.iter().map(|p| view.to_screen(*p)));
        let Some((origin, size)) = extent(camera, on_screen) else { return image };
        // A solid that reaches behind the near plane is cut open: its inside may be seen.
        let uncut = on_screen.iter().all(|[_, _, w]| *w > 0.0);

        let samples = size[0] as usize * size[1] as usize * N;
        depth.clear();
        depth.resize(samples, 0.0);
        ids.clear();
        ids.resize(samples, NOTHING);
        let mut target =
            Target { origin, size, depth: depth.as_chunks_mut::<N>().0, ids: ids.as_chunks_mut::<N>().0 };
        for (id, triangle) in self.triangles.iter().enumerate() {
            let [i, j, k] = triangle.corners;
            let corners = [i as usize, j as usize, k as usize];
            let [i, j, k] = corners;
            let (screen, p) =
                ([on_screen[i], on_screen[j], on_screen[k]], [in_camera[i], in_camera[j], in_camera[k]]);
            if uncut
                && triangle.visible != Visible::Both
                && turned_away(&p) == (triangle.visible == Visible::Front)
            {
                continue;
            }
            let surface = &self.surfaces[triangle.surface as usize];
            match surface.texture {
                Some(texture) if surface.cutoff > 0.0 => {
                    let (texture, uv) = (&self.textures[texture], corners.map(|i| self.attributes[i].uv));
                    let cut = CutOut::new(view, p, texture, uv, surface.cutoff, 1.0 / (N as f32).sqrt());
                    view.straighten(p, screen, |s| target.draw(s, id as u32, |x, y| cut.keeps(x, y)));
                }
                _ => view.straighten(p, screen, |s| target.draw(s, id as u32, |_, _| true)),
            }
        }

        let light = PreparedLight::new(&settings.light);
        let stride = image.width() as usize * 4;
        let rows = target.ids.chunks_exact(size[0] as usize);
        let lines = image.chunks_exact_mut(stride).skip(origin[1] as usize);
        for ((row, line), y) in rows.zip(lines).zip(origin[1]..) {
            let (pixels, _) = line.as_chunks_mut::<4>();
            for ((ids, pixel), x) in
                row.iter().zip(pixels.iter_mut().skip(origin[0] as usize)).zip(origin[0]..)
            {
                if ids.iter().all(|id| *id == NOTHING) {
                    continue;
                }
                *pixel = self.resolve(ids, [x as f32, y as f32], view, &light, in_camera);
            }
        }
        image
    }

    /// The colour of a pixel from what its samples see: each triangle is shaded once, in
    /// the middle of its samples.
    #[inline]
    fn resolve<const N: usize>(
        &self,
        ids: &[u32; N],
        [x, y]: [f32; 2],
        view: &View,
        light: &PreparedLight,
        in_camera: &[InCamera],
    ) -> [u8; 4]
    where
        Samples: Pattern<N>,
    {
        let (mut sum, mut covered, mut shaded_weight, mut shaded) = ([0.0f32; 3], 0.0f32, 0.0f32, 0);
        for (first, id) in ids.iter().enumerate() {
            if *id == NOTHING || ids[..first].contains(id) {
                continue;
            }
            let (mut at, mut weight) = ([0.0f32; 2], 0.0f32);
            for (other, offset) in ids.iter().zip(Samples::OFFSETS) {
                if other == id {
                    at = [at[0] + offset[0], at[1] + offset[1]];
                    weight += 1.0;
                }
            }
            covered += weight;
            if shaded == MAX_SHADED {
                continue;
            }
            shaded += 1;
            shaded_weight += weight;
            let (px, py) = (x + at[0] / weight, y + at[1] / weight);
            // Levels need no blending where several triangles are blended anyway.
            let alone = weight == N as f32;
            let color = self.shade(*id, view.ray(px, py), view.ray_step(), alone, light, in_camera);
            for (s, c) in sum.iter_mut().zip(color) {
                *s += c * weight;
            }
        }
        let [r, g, b] = sum.map(|s| byte_of_linear(s / shaded_weight));
        [r, g, b, (covered * (255.0 / N as f32) + 0.5) as u8]
    }

    #[inline]
    fn shade(
        &self,
        id: u32,
        ray: [f32; 3],
        step: [f32; 2],
        alone: bool,
        light: &PreparedLight,
        in_camera: &[InCamera],
    ) -> [f32; 3] {
        let triangle = &self.triangles[id as usize];
        let [i, j, k] = triangle.corners;
        let [i, j, k] = [i as usize, j as usize, k as usize];
        let surface = &self.surfaces[triangle.surface as usize];
        let hit = Facet::new([in_camera[i], in_camera[j], in_camera[k]]).hit(ray, step);
        let (a, b, c) = (self.attributes[i], self.attributes[j], self.attributes[k]);
        let brightness = hit.light(light, [a.normal, b.normal, c.normal], triangle.turned);
        let color = surface.color.map(|c| c * brightness);
        let Some(texture) = surface.texture else { return color };
        let [uv, right, down] = hit.on_texture([a.uv, b.uv, c.uv]);
        let [r, g, b, a] = self.textures[texture].over_footprint(uv, right, down, alone);
        // The texture's colours carry their alpha; what is drawn is opaque.
        let scale = if a > 1e-3 { 1.0 / a } else { 0.0 };
        [color[0] * r * scale, color[1] * g * scale, color[2] * b * scale]
    }
}

/// Whether the camera is on the side from which the corners run clockwise.
#[inline]
fn turned_away(corners: &[InCamera; 3]) -> bool {
    let [a, b, c] = *corners;
    dot(cross(minus(b, a), minus(c, a)), a) >= 0.0
}

/// First column and row, width and height of the pixels that the mesh can touch; `None` if none.
fn extent(camera: &Camera, on_screen: &[OnScreen]) -> Option<([i32; 2], [i32; 2])> {
    let (width, height) = (camera.width as i32, camera.height as i32);
    let everything = Some(([0, 0], [width, height]));
    let (mut low, mut high) = ([f32::MAX; 2], [f32::MIN; 2]);
    // Behind the near plane anything may come of a triangle once it is cut; a bent edge
    // may bulge out of its ends' rectangle.
    let all_seen = on_screen.iter().fold(true, |all, [x, y, w]| {
        low = [low[0].min(*x), low[1].min(*y)];
        high = [high[0].max(*x), high[1].max(*y)];
        all & (*w > 0.0)
    });
    if width <= 0 || height <= 0 || on_screen.is_empty() {
        return None;
    }
    if !all_seen || !camera.distortion.is_none() {
        return everything;
    }
    let axis = |k: usize, size: i32| {
        // The casts saturate and turn NaN into 0.
        let first = ((low[k] - 1.0).floor() as i32).clamp(0, size);
        let after = ((high[k] + 1.0).ceil() as i32).clamp(0, size);
        (first < after).then_some((first, after - first))
    };
    let ((x, w), (y, h)) = (axis(0, width)?, axis(1, height)?);
    Some(([x, y], [w, h]))
}

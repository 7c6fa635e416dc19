//! Holes in textures: which samples of a triangle they take away.

use super::project::{InCamera, View};
use super::shade::Facet;
use super::texture::MipTexture;

/// A triangle whose texture has holes.
pub(super) struct CutOut<'a> {
    view: &'a View,
    facet: Facet,
    texture: &'a MipTexture,
    /// The texture's level, the same all over the triangle.
    level: usize,
    /// Texture coordinates of the first corner, and from it to the second and third.
    uv: [[f32; 2]; 3],
    cutoff: f32,
}

impl<'a> CutOut<'a> {
    /// `scale` is the distance between samples, pixels: texels are chosen to match.
    pub(super) fn new(
        view: &'a View,
        corners: [InCamera; 3],
        texture: &'a MipTexture,
        uv: [[f32; 2]; 3],
        cutoff: f32,
        scale: f32,
    ) -> Self {
        let facet = Facet::new(corners);
        let middle: InCamera = std::array::from_fn(|k| corners.iter().map(|c| c[k]).sum::<f32>() / 3.0);
        // Behind the camera nothing is drawn; any level will do.
        let depth = middle[2].abs().max(1e-6);
        let hit = facet.hit([middle[0] / depth, middle[1] / depth, 1.0], view.ray_step());
        let [_, right, down] = hit.on_texture(uv).map(|[u, v]| [u * scale, v * scale]);
        let level = texture.level_for(right, down);
        let from_first = |k: usize| [uv[k][0] - uv[0][0], uv[k][1] - uv[0][1]];
        Self { view, facet, texture, level, uv: [uv[0], from_first(1), from_first(2)], cutoff }
    }

    /// True when there is surface, no hole, at a position on the screen (pixels).
    #[inline]
    pub(super) fn keeps(&self, x: f32, y: f32) -> bool {
        let [u, v] = self.facet.weights(self.view.ray(x, y));
        let [first, second, third] = self.uv;
        let at = |k: usize| first[k] + u * second[k] + v * third[k];
        self.texture.alpha([at(0), at(1)], self.level) >= self.cutoff
    }
}

//! The object as the simulated camera sees it.

use image::RgbaImage;

use super::Photograph;
use crate::geometry::Pose;
use crate::imaging::Camera;
use crate::render::{Mesh, RenderSettings, Renderer};

/// A mesh before a camera.
pub struct RenderedObject {
    renderer: Renderer,
    camera: Camera,
    settings: RenderSettings,
}

impl RenderedObject {
    /// `mesh` stands in the base frame, metres.
    pub fn new(mesh: &Mesh, camera: Camera) -> Self {
        Self { renderer: Renderer::new(mesh), camera, settings: RenderSettings::default() }
    }
}

impl Photograph for RenderedObject {
    fn photograph(&self, base_from_camera: &Pose) -> RgbaImage {
        self.renderer.render(&self.camera, base_from_camera, &self.settings)
    }
}

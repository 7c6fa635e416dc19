//! Textured triangle meshes: loading, sample objects, and a rasteriser for one CPU core.
//!
//! Meshes are z-up and in metres once fitted; loaders turn y-up files. Nothing here
//! knows what the images are for.

mod bounding_sphere;
mod closed;
mod cut_out;
mod light;
pub mod load;
mod mesh;
mod normals;
mod project;
mod raster;
mod renderer;
pub mod samples;
mod settings;
mod shade;
mod srgb;
#[cfg(test)]
mod tests;
mod texture;

pub use bounding_sphere::{BoundingSphere, bounding_sphere};
pub use light::{DirectionalLight, Light};
pub use load::MeshError;
pub use mesh::{Material, Mesh, MeshWarning};
pub use renderer::Renderer;
pub use samples::{sample_names, sample_object};
pub use settings::RenderSettings;

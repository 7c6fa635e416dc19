//! NeRFs that train in seconds on one thread.
//!
//! A hash grid and two small networks (Müller et al. 2022, "Instant Neural
//! Graphics Primitives"), an occupancy grid and Adam, written for vector units:
//! samples sit in lanes, one source serves every instruction set.

mod bounds;
mod composite;
mod distance_map;
mod error;
mod field;
mod march;
mod occupancy;
mod ray;
mod settings;
mod silhouette;
mod simd;
#[cfg(test)]
mod tests;
mod trace;
mod train;
mod trained;
mod training_views;
mod view_rays;
mod visual_hull;

pub use bounds::Bounds;
pub use error::NerfError;
pub use settings::NerfSettings;
pub use simd::InstructionSet;
pub use train::{TrainProgress, train};
pub use trained::{Evaluation, Nerf};

//! Poses and directions: the floor everything else stands on.
//!
//! Metres, radians, right-handed frames. A transform `a_from_b` maps
//! coordinates in frame `b` to coordinates in frame `a`; a vector `x_in_a` has
//! its coordinates in frame `a`. Camera frames have OpenCV axes: x right,
//! y down, z forward.

mod direction;
mod look_at;

pub use direction::{azimuth_elevation_from_direction, direction_from_azimuth_elevation};
pub use look_at::look_at;

/// A rigid transform between two frames, named `a_from_b` where it is used.
pub type Pose = nalgebra::Isometry3<f64>;
/// A point, named `point_in_a` where it is used; metres.
pub type Point = nalgebra::Point3<f64>;
/// A free vector, named `vector_in_a` where it is used.
pub type Vector = nalgebra::Vector3<f64>;
/// A unit direction.
pub type Direction = nalgebra::Unit<Vector>;

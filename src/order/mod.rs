//! In which order to visit the views: local paths around the object, exact shortest path through all.

mod cost_matrix;
mod error;
mod exact;
mod local_path;
mod local_search;
mod obstacle;
mod ordered_path;

pub use cost_matrix::{CostMatrix, MAX_POINTS};
pub use error::OrderError;
pub use local_path::LocalPath;
pub use local_search::{nearest_neighbour, two_opt};
pub use obstacle::Obstacle;
pub use ordered_path::{OPTIMALITY_TOLERANCE, OrderedPath, WORK_PER_SECOND, order_points, shortest_path};

#[cfg(test)]
mod tests;

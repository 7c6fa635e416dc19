//! The shortest path through all points.

use std::time::Duration;

use super::held_karp;
use super::local_search;
use super::tour_problem::TourProblem;
use super::{CostMatrix, Obstacle, OrderError};
use crate::geometry::Point;

/// A path counts as optimal if no path is shorter by more than this share of its length.
pub const OPTIMALITY_TOLERANCE: f64 = 1e-9;

/// An order of visit and what is proven about it.
#[derive(Debug, Clone, PartialEq)]
pub struct OrderedPath {
    /// Indices of all points, the start first.
    pub order: Vec<usize>,
    /// Cost of the path; metres where the costs are.
    pub length: f64,
    /// No path costs less than this.
    pub lower_bound: f64,
    /// Whether `length - lower_bound` is at most [`OPTIMALITY_TOLERANCE`] times `length`.
    pub optimal: bool,
}

/// The cheapest path that starts at `start`, visits every point once and ends anywhere.
///
/// # Errors
/// A start that is no index of the matrix.
pub fn shortest_path(
    matrix: &CostMatrix,
    start: usize,
    _budget: Duration,
) -> Result<OrderedPath, OrderError> {
    let n = matrix.len();
    if start >= n {
        return Err(OrderError::Start { start, count: n });
    }
    let order = local_search::search(matrix, start, 300);
    let length = matrix.path_length(&order);
    let tolerance = OPTIMALITY_TOLERANCE * length;
    let problem = TourProblem::of(matrix, start);
    let bound = held_karp::ascend(&problem, length, tolerance, 400).bound.clamp(0.0, length);
    Ok(OrderedPath { order, length, lower_bound: bound, optimal: length - bound <= tolerance })
}

/// The shortest path through `points` around `obstacle`, see [`shortest_path`].
///
/// # Errors
/// No points or too many, a number that is not finite, a point inside the obstacle or under the
/// table, a start that is no index.
pub fn order_points(
    points: &[Point],
    start: usize,
    obstacle: &Obstacle,
    budget: Duration,
) -> Result<OrderedPath, OrderError> {
    shortest_path(&CostMatrix::from_points(points, obstacle)?, start, budget)
}

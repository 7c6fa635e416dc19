//! The shortest path through all points.

use std::time::Duration;

use super::exact;
use super::local_search;
use super::{CostMatrix, Obstacle, OrderError};
use crate::geometry::Point;

/// A path counts as optimal if no path is shorter by more than this share of its length.
pub const OPTIMALITY_TOLERANCE: f64 = 1e-9;

/// Multiplications that a second of budget buys: about what one core of a server does.
pub const WORK_PER_SECOND: u64 = 1_000_000_000;

/// Kicks of the local search where costs depend on the direction.
const DIRECTED_KICKS: usize = 200;

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
/// Symmetric costs are solved exactly (branch and cut) unless `budget` runs out first: then the
/// best path found comes with the bound proven so far. The budget is counted in work, not on the
/// clock (a second of it is [`WORK_PER_SECOND`] multiplications), so the answer does not depend
/// on the machine; on a slow or busy one it may take longer than the budget says.
///
/// Costs that depend on the direction get local search; the bound is that of the problem in which
/// each pair costs what its cheaper direction does.
///
/// # Errors
/// A start that is no index of the matrix.
pub fn shortest_path(matrix: &CostMatrix, start: usize, budget: Duration) -> Result<OrderedPath, OrderError> {
    let n = matrix.len();
    if start >= n {
        return Err(OrderError::Start { start, count: n });
    }
    let work = WORK_PER_SECOND.saturating_mul(budget.as_millis().min(1 << 40) as u64) / 1000;
    let first = local_search::nearest_neighbour(matrix, start);
    if n < 3 {
        let length = matrix.path_length(&first);
        return Ok(OrderedPath { order: first, length, lower_bound: length, optimal: true });
    }
    let solved = exact::solve(matrix, start, first, work);
    let mut order = solved.order;
    if !matrix.is_symmetric() {
        let searched = local_search::search(matrix, start, DIRECTED_KICKS);
        if matrix.path_length(&searched) < matrix.path_length(&order) {
            order = searched;
        }
    }
    let length = matrix.path_length(&order);
    let lower_bound = solved.lower_bound.clamp(0.0, length);
    let optimal = length - lower_bound <= OPTIMALITY_TOLERANCE * length;
    Ok(OrderedPath { order, length, lower_bound, optimal })
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

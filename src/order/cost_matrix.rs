//! What it costs to go from each point to each other.

use super::{LocalPath, Obstacle, OrderError};
use crate::geometry::Point;

/// Most points an ordering problem may have.
pub const MAX_POINTS: usize = 1000;

/// An n x n matrix of costs, row = from, column = to; finite and not negative. The diagonal is
/// ignored.
#[derive(Debug, Clone, PartialEq)]
pub struct CostMatrix {
    n: usize,
    costs: Vec<f64>,
}

impl CostMatrix {
    /// A matrix from its rows, one after the other. It need not be symmetric.
    ///
    /// # Errors
    /// Wrong number of entries, none, too many points, or a cost that is not finite or negative.
    pub fn from_rows(n: usize, costs: Vec<f64>) -> Result<CostMatrix, OrderError> {
        check_count(n)?;
        if costs.len() != n * n {
            return Err(OrderError::Shape { n, len: costs.len() });
        }
        for (k, &value) in costs.iter().enumerate() {
            if k / n != k % n && !(0.0..=1e12).contains(&value) {
                return Err(OrderError::Cost { from: k / n, to: k % n, value });
            }
        }
        Ok(CostMatrix { n, costs })
    }

    /// Lengths, metres, of the local paths between `points` around `obstacle`; symmetric.
    ///
    /// # Errors
    /// No points or too many, a number that is not finite, a point inside the obstacle.
    pub fn from_points(points: &[Point], obstacle: &Obstacle) -> Result<CostMatrix, OrderError> {
        let n = points.len();
        check_count(n)?;
        obstacle.check(points)?;
        let mut costs = vec![0.0; n * n];
        for (i, &from) in points.iter().enumerate() {
            for (j, &to) in points.iter().enumerate().take(i) {
                let length_m = LocalPath::between(from, to, obstacle).length_m();
                costs[i * n + j] = length_m;
                costs[j * n + i] = length_m;
            }
        }
        Ok(CostMatrix { n, costs })
    }

    /// Number of points.
    pub fn len(&self) -> usize {
        self.n
    }

    /// Whether there are no points; never true.
    pub fn is_empty(&self) -> bool {
        self.n == 0
    }

    /// Cost from point `from` to point `to`, both below [`CostMatrix::len`].
    pub fn get(&self, from: usize, to: usize) -> f64 {
        self.costs[from * self.n + to]
    }

    /// The costs from point `from` to all.
    pub fn row(&self, from: usize) -> &[f64] {
        &self.costs[from * self.n..(from + 1) * self.n]
    }

    /// Whether every cost equals the cost of the way back.
    pub fn is_symmetric(&self) -> bool {
        (0..self.n).all(|i| (0..i).all(|j| self.get(i, j) == self.get(j, i)))
    }

    /// Cost of visiting the points in this order.
    pub fn path_length(&self, order: &[usize]) -> f64 {
        order.windows(2).map(|pair| self.get(pair[0], pair[1])).sum()
    }
}

fn check_count(n: usize) -> Result<(), OrderError> {
    if n == 0 {
        return Err(OrderError::Empty);
    }
    if n > MAX_POINTS {
        return Err(OrderError::TooMany { count: n, max: MAX_POINTS });
    }
    Ok(())
}

//! The path problem as a closed tour, which is what the theory is about.
//!
//! A node `home` is added that costs nothing to reach from anywhere. A closed tour that uses the
//! edge from `home` to the start, without `home`, is a path from the start with a free end.

use crate::order::CostMatrix;

/// A symmetric closed-tour problem whose last node is `home`; the edge from `home` to `start`
/// belongs to every tour.
#[derive(Debug, Clone)]
pub(super) struct TourProblem {
    /// Number of nodes, `home` included.
    pub nodes: usize,
    /// The path's first node.
    pub start: usize,
    costs: Vec<f64>,
}

impl TourProblem {
    /// The problem of `matrix`; where it is asymmetric, the cheaper way counts for both.
    pub(super) fn of(matrix: &CostMatrix, start: usize) -> TourProblem {
        let n = matrix.len();
        let nodes = n + 1;
        let mut costs = vec![0.0; nodes * nodes];
        for i in 0..n {
            for j in 0..n {
                if i != j {
                    costs[i * nodes + j] = matrix.get(i, j).min(matrix.get(j, i));
                }
            }
        }
        TourProblem { nodes, start, costs }
    }

    /// The node that is no point.
    pub(super) fn home(&self) -> usize {
        self.nodes - 1
    }

    /// Cost of an edge; 0 at `home`.
    #[inline]
    pub(super) fn cost(&self, a: usize, b: usize) -> f64 {
        self.costs[a * self.nodes + b]
    }

    /// Costs of the edges at `a`.
    #[inline]
    pub(super) fn row(&self, a: usize) -> &[f64] {
        &self.costs[a * self.nodes..(a + 1) * self.nodes]
    }

    /// Cost of the closed tour, or of the path it stands for.
    pub(super) fn tour_cost(&self, tour: &[usize]) -> f64 {
        let closing = match (tour.first(), tour.last()) {
            (Some(&first), Some(&last)) if tour.len() > 1 => self.cost(last, first),
            _ => 0.0,
        };
        tour.windows(2).map(|pair| self.cost(pair[0], pair[1])).sum::<f64>() + closing
    }

    /// The same tour, as the path from the start to its free end and `home` last.
    pub(super) fn starting_at_home(&self, mut tour: Vec<usize>) -> Vec<usize> {
        if let Some(at) = tour.iter().position(|&k| k == self.start) {
            tour.rotate_left(at);
        }
        if tour.get(1) == Some(&self.home()) {
            tour[1..].reverse();
        }
        tour
    }
}

//! The exact solver for symmetric costs.
//!
//! 1. A first tour, and the Held-Karp bound with its prices ([`held_karp`]).
//! 2. Local search under these prices ([`tour_search`]).
//! 3. Most edges cannot be in a better tour; on the rest, branch and cut ([`branch`], [`cuts`],
//!    [`linear_program`]).

mod branch;
mod cuts;
mod held_karp;
mod linear_program;
mod tour_problem;
mod tour_search;

use super::{CostMatrix, OPTIMALITY_TOLERANCE};
use tour_problem::TourProblem;
use tour_search::TourSearch;

/// Kicks of the local search, per node.
const KICKS_PER_NODE: usize = 6;
/// Most trees of the Held-Karp ascent.
const TREES: usize = 150;

/// A path and a bound.
pub(super) struct Solved {
    pub order: Vec<usize>,
    pub lower_bound: f64,
}

/// The cheapest path from `start` through all points of a symmetric `matrix`, or the best one
/// found and proven with `work` multiplications.
pub(super) fn solve(matrix: &CostMatrix, start: usize, first: Vec<usize>, mut work: u64) -> Solved {
    let problem = TourProblem::of(matrix, start);
    let mut tour = first;
    tour.push(problem.home());
    let zero = vec![0.0; problem.nodes];
    tour = problem.starting_at_home(TourSearch::new(&problem, &zero, &tour).run(0));
    let mut upper = problem.tour_cost(&tour);
    // Half, since the final path may be shorter than this one.
    let tolerance = 0.5 * OPTIMALITY_TOLERANCE * upper;
    let dense = (problem.nodes * problem.nodes) as u64;
    let trees = TREES.min((work / (2 * dense)) as usize).max(1);
    let ascent = held_karp::ascend(&problem, upper, tolerance, trees);
    work = work.saturating_sub(trees as u64 * dense);
    if ascent.bound < upper - tolerance {
        let kicks = (KICKS_PER_NODE * problem.nodes).min((work / (8 * dense)) as usize);
        let mut search = TourSearch::new(&problem, &ascent.prices, &tour);
        let found = problem.starting_at_home(search.run(kicks));
        work = work.saturating_sub(search.work);
        if problem.tour_cost(&found) < upper {
            upper = problem.tour_cost(&found);
            tour = found;
        }
    }
    let mut lower_bound = ascent.bound;
    if ascent.bound < upper - tolerance && work > 0 {
        let edges = held_karp::useful_edges(&problem, &ascent.prices, upper - tolerance);
        let searched = branch::search(&problem, &edges, &ascent.prices, upper, tolerance, &mut work);
        lower_bound = lower_bound.max(searched.bound);
        if let Some(found) = searched.tour {
            tour = problem.starting_at_home(found);
        }
    }
    Solved { order: tour.into_iter().filter(|&k| k != problem.home()).collect(), lower_bound }
}

//! Branch and cut: a linear relaxation, tightened by cuts, split where it stays fractional.

use super::cuts::separate;
use super::held_karp::Edge;
use super::linear_program::{LinearProgram, Outcome, Row};
use super::tour_problem::TourProblem;

/// Values this close to 0 or 1 are whole.
const WHOLE: f64 = 1e-6;
/// Most pivots for one relaxation.
const PIVOTS: usize = 20_000;
/// Pivots for each side of a trial branch.
const TRIAL_PIVOTS: usize = 15;
/// Edges tried before branching.
const TRIALS: usize = 4;
/// Rounds of cuts that may pass with little gain before the node is split.
const IDLE_ROUNDS: usize = 3;

/// What the search found.
pub(super) struct Searched {
    /// A tour better than the cutoff, if there is one.
    pub tour: Option<Vec<usize>>,
    /// No tour that uses only the given edges costs less than this, or than the cutoff.
    pub bound: f64,
}

struct Node {
    relaxation: LinearProgram,
    bound: f64,
}

/// Finds the cheapest tour made of `edges` that costs less than `cutoff`; `tolerance` is what a
/// tour must gain to be of interest. `work` is a number of multiplications; it is counted down,
/// and the search stops when there is none left.
pub(super) fn search(
    problem: &TourProblem,
    edges: &[Edge],
    prices: &[f64],
    mut upper: f64,
    tolerance: f64,
    work: &mut u64,
) -> Searched {
    let mut best = None;
    let mut open = vec![root(problem, edges, prices)];
    // Costs reduced by prices differ from costs by this constant.
    let shift = 2.0 * prices.iter().sum::<f64>();
    let mut abandoned = f64::INFINITY;
    while let Some(mut node) = open.pop() {
        if node.bound >= upper - tolerance {
            continue;
        }
        if *work == 0 {
            abandoned = abandoned.min(node.bound);
            continue;
        }
        let mut idle = 0;
        loop {
            let spent = node.relaxation.work;
            let outcome = node.relaxation.solve(upper - tolerance + shift, PIVOTS, *work);
            let bound = node.relaxation.safe_bound() - shift;
            *work = work.saturating_sub(node.relaxation.work - spent + (problem.nodes * edges.len()) as u64);
            if outcome == Outcome::Infeasible || bound >= upper - tolerance {
                break;
            }
            let gained = bound - node.bound;
            node.bound = node.bound.max(bound);
            if outcome != Outcome::Optimal || *work == 0 {
                abandoned = abandoned.min(node.bound);
                break;
            }
            node.relaxation.fix_by_reduced_cost(bound + shift, upper - tolerance + shift);
            let x = node.relaxation.values();
            idle = if gained < 0.02 * (upper - bound) { idle + 1 } else { 0 };
            let cuts = separate(problem.nodes, edges, x);
            let subtours = cuts.iter().any(|cut| cut.sets.len() == 1);
            if !cuts.is_empty() && (subtours || idle < IDLE_ROUNDS) {
                node.relaxation.drop_loose_rows(problem.nodes, 0.1);
                for cut in &cuts {
                    let entries = edges
                        .iter()
                        .enumerate()
                        .map(|(k, edge)| (k, cut.coefficient(edge)))
                        .filter(|(_, c)| *c != 0.0)
                        .collect();
                    node.relaxation.add_row(&Row { entries, right: cut.right, equality: false });
                }
                continue;
            }
            if x.iter().all(|v| *v < WHOLE || *v > 1.0 - WHOLE) {
                if let Some(tour) = tour_of(problem.nodes, edges, x) {
                    let cost = problem.tour_cost(&tour);
                    if cost < upper {
                        upper = cost;
                        best = Some(tour);
                    }
                }
                break;
            }
            let (column, spent) = branching_edge(&node.relaxation, upper - tolerance + shift, *work);
            *work = work.saturating_sub(spent);
            let Some(column) = column else { break };
            let mut without = Node { relaxation: node.relaxation.clone(), bound: node.bound };
            without.relaxation.fix(column, 0.0);
            node.relaxation.fix(column, 1.0);
            open.push(without);
            open.push(node);
            break;
        }
    }
    Searched { tour: best, bound: abandoned.min(upper - tolerance) }
}

/// Every node has two edges; the edge from home to the start is used.
fn root(problem: &TourProblem, edges: &[Edge], prices: &[f64]) -> Node {
    let costs = edges.iter().map(|edge| edge.cost + prices[edge.a] + prices[edge.b]).collect();
    let mut relaxation = LinearProgram::new(costs);
    for node in 0..problem.nodes {
        let entries = edges
            .iter()
            .enumerate()
            .filter(|(_, edge)| edge.a == node || edge.b == node)
            .map(|(k, _)| (k, 1.0))
            .collect();
        relaxation.add_row(&Row { entries, right: 2.0, equality: true });
    }
    for (k, edge) in edges.iter().enumerate() {
        if edge.a.min(edge.b) == problem.start && edge.a.max(edge.b) == problem.home() {
            relaxation.fix(k, 1.0);
        }
    }
    Node { relaxation, bound: f64::NEG_INFINITY }
}

/// The fractional edge whose two branches raise the bound most (short trial solves), and the work
/// that took. None if a trial showed that nothing is left here.
fn branching_edge(relaxation: &LinearProgram, cutoff: f64, most: u64) -> (Option<usize>, u64) {
    let mut fractional: Vec<(f64, usize)> = relaxation
        .values()
        .iter()
        .enumerate()
        .filter(|(_, v)| **v > WHOLE && **v < 1.0 - WHOLE)
        .map(|(k, v)| ((v - 0.5).abs(), k))
        .collect();
    fractional.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let mut best: Option<(f64, usize)> = None;
    let mut work = 0;
    for &(_, column) in fractional.iter().take(TRIALS) {
        let mut gains = [0.0; 2];
        for (gain, value) in gains.iter_mut().zip([0.0, 1.0]) {
            let mut trial = relaxation.clone();
            trial.fix(column, value);
            let outcome = trial.solve(cutoff, TRIAL_PIVOTS, most);
            *gain = if outcome == Outcome::Infeasible { cutoff } else { trial.safe_bound().min(cutoff) };
            work += trial.work - relaxation.work;
        }
        // The weaker side counts most.
        let score = gains[0].min(gains[1]) + 0.2 * gains[0].max(gains[1]);
        if best.is_none_or(|(highest, _)| score > highest) {
            best = Some((score, column));
        }
    }
    (best.map(|(_, column)| column), work)
}

/// The tour that whole values stand for, if they do.
fn tour_of(nodes: usize, edges: &[Edge], x: &[f64]) -> Option<Vec<usize>> {
    let mut beside = vec![Vec::with_capacity(2); nodes];
    for (edge, _) in edges.iter().zip(x).filter(|(_, v)| **v > 0.5) {
        beside[edge.a].push(edge.b);
        beside[edge.b].push(edge.a);
    }
    if beside.iter().any(|b| b.len() != 2) {
        return None;
    }
    let mut tour = vec![0];
    let (mut previous, mut at) = (0, beside[0][0]);
    while at != 0 && tour.len() <= nodes {
        tour.push(at);
        let next = if beside[at][0] == previous { beside[at][1] } else { beside[at][0] };
        (previous, at) = (at, next);
    }
    (tour.len() == nodes).then_some(tour)
}

//! The shortest path by a general solver: HiGHS on an integer programme with subtour cuts.
//!
//! A virtual node, free to reach, closes the path to a tour; its edge to the start is given. Every node has degree
//! two, every edge is taken or not. What comes out may be several cycles: each is forbidden (Dantzig, Fulkerson,
//! Johnson 1954: k nodes are joined by at most k - 1 edges) and the programme is solved again until one is left.

use highs::{Col, HighsModelStatus, HighsStatus, Model, RowProblem, Sense};
use prv::order::CostMatrix;

/// Seconds that one integer programme may take.
const TIME_LIMIT_S: f64 = 120.0;

/// What HiGHS found.
pub struct HighsPath {
    /// All points in order, the start first.
    pub order: Vec<usize>,
    /// Integer programmes solved until the path was one piece.
    pub programmes: usize,
}

/// The cheapest path from `start` through all points, each programme solved to within `gap`, a share of its
/// optimum, by one thread. Costs are symmetric. Nothing if HiGHS fails or runs out of time.
pub fn highs_path(matrix: &CostMatrix, start: usize, gap: f64) -> Option<HighsPath> {
    let virtual_node = matrix.len();
    let mut problem = RowProblem::default();
    let mut edges: Vec<(usize, usize, Col)> = Vec::new();
    for a in 0..=virtual_node {
        for b in 0..a {
            let cost = if a == virtual_node { 0.0 } else { matrix.get(a, b) };
            let least = if a == virtual_node && b == start { 1 } else { 0 };
            edges.push((a, b, problem.add_integer_column(cost, least..=1)));
        }
    }
    for node in 0..=virtual_node {
        let at_node = edges.iter().filter(|&&(a, b, _)| a == node || b == node);
        problem.add_row(2..=2, at_node.map(|&(_, _, edge)| (edge, 1.0)));
    }
    let mut model = prepared(problem, gap).ok()?;
    for programmes in 1.. {
        let solved = model.try_solve().ok()?;
        if solved.status() != HighsModelStatus::Optimal {
            return None;
        }
        let taken = solved.get_solution();
        let mut neighbours = vec![Vec::with_capacity(2); virtual_node + 1];
        for &(a, b, _) in edges.iter().filter(|&&(_, _, edge)| taken[edge] > 0.5) {
            neighbours[a].push(b);
            neighbours[b].push(a);
        }
        let cycles = cycles(&neighbours, virtual_node, start);
        if let [tour] = &cycles[..] {
            return Some(HighsPath { order: tour[1..].to_vec(), programmes });
        }
        model = Model::from(solved);
        for cycle in &cycles {
            let inside = edges.iter().filter(|(a, b, _)| cycle.contains(a) && cycle.contains(b));
            let most = cycle.len() as f64 - 1.0;
            model.try_add_row(..=most, inside.map(|&(_, _, edge)| (edge, 1.0))).ok()?;
        }
    }
    None
}

fn prepared(problem: RowProblem, gap: f64) -> Result<Model, HighsStatus> {
    let mut model = problem.try_optimise(Sense::Minimise)?;
    let options = [("mip_rel_gap", gap), ("mip_abs_gap", 0.0), ("time_limit", TIME_LIMIT_S)];
    for (option, value) in options {
        model.try_set_option(option, value).map_err(|_| HighsStatus::Error)?;
    }
    model.try_set_option("threads", 1).map_err(|_| HighsStatus::Error)?;
    Ok(model)
}

/// The cycles of a graph whose nodes have two neighbours each; the first begins at `first` and leaves it for `next`.
fn cycles(neighbours: &[Vec<usize>], first: usize, next: usize) -> Vec<Vec<usize>> {
    let mut seen = vec![false; neighbours.len()];
    let mut cycles = Vec::new();
    for from in std::iter::once(first).chain(0..neighbours.len()) {
        if seen[from] {
            continue;
        }
        seen[from] = true;
        let mut cycle = vec![from];
        let mut ahead = if from == first { Some(next) } else { neighbours[from].first().copied() };
        while let Some(node) = ahead.filter(|&node| !seen[node]) {
            seen[node] = true;
            cycle.push(node);
            ahead = neighbours[node].iter().copied().find(|&other| !seen[other]);
        }
        cycles.push(cycle);
    }
    cycles
}

//! The Held-Karp bound: the best Lagrangian bound from 1-trees.
//!
//! A closed tour is a spanning tree of the points plus two edges at `home`, with two edges at
//! every node. Without the last condition the cheapest is easy to find; prices on the nodes
//! push it towards two edges each, and every price vector gives a lower bound.

use super::tour_problem::TourProblem;

/// Lower bound on the cost of a tour and the prices that prove it.
#[derive(Debug, Clone)]
pub(super) struct HeldKarp {
    pub bound: f64,
    pub prices: Vec<f64>,
}

/// Raises the bound for at most `iterations` trees; stops when `upper` is met within `tolerance`.
pub(super) fn ascend(problem: &TourProblem, upper: f64, tolerance: f64, iterations: usize) -> HeldKarp {
    let n = problem.nodes;
    let mut prices = vec![0.0; n];
    let mut best = HeldKarp { bound: f64::NEG_INFINITY, prices: prices.clone() };
    let mut tree = Tree::new(n);
    let mut previous = vec![0i32; n];
    let mut scale = 1.0f64;
    let mut stalled = 0;
    for iteration in 0..iterations {
        let bound = tree.build(problem, &prices);
        if bound > best.bound + 1e-12 * upper.abs() {
            best.bound = bound;
            best.prices.copy_from_slice(&prices);
            stalled = 0;
        } else {
            stalled += 1;
            if stalled >= 8 {
                scale *= 0.7;
                stalled = 0;
            }
        }
        let square: i32 = tree.degree.iter().map(|d| (d - 2) * (d - 2)).sum();
        if square == 0 || best.bound >= upper - tolerance || scale < 1e-4 {
            break;
        }
        let step = scale * (1.01 * upper - bound).max(1e-9 * upper.abs()) / square as f64;
        for k in 0..n {
            let slope = tree.degree[k] - 2;
            let mixed =
                if iteration == 0 { slope as f64 } else { 0.7 * slope as f64 + 0.3 * previous[k] as f64 };
            prices[k] += step * mixed;
            previous[k] = slope;
        }
    }
    best
}

/// Cheapest 1-tree under prices.
struct Tree {
    degree: Vec<i32>,
    nearest: Vec<f64>,
    parent: Vec<u32>,
    outside: Vec<u32>,
    /// Points in the order they joined the tree, without the first.
    joined: Vec<u32>,
}

impl Tree {
    fn new(n: usize) -> Tree {
        Tree {
            degree: vec![0; n],
            nearest: vec![0.0; n],
            parent: vec![0; n],
            outside: Vec::with_capacity(n),
            joined: Vec::with_capacity(n),
        }
    }

    /// Prim's algorithm on the points, then the two edges at `home`: the one to the start and the
    /// cheapest other. Returns the bound.
    fn build(&mut self, problem: &TourProblem, prices: &[f64]) -> f64 {
        let home = problem.home();
        self.degree.fill(0);
        self.outside.clear();
        self.joined.clear();
        let root = problem.start;
        let mut total = 0.0;
        for k in (0..home).filter(|&k| k != root) {
            self.outside.push(k as u32);
            self.nearest[k] = problem.cost(root, k) + prices[root] + prices[k];
            self.parent[k] = root as u32;
        }
        while !self.outside.is_empty() {
            let (mut at, mut least) = (0, f64::INFINITY);
            for (position, &k) in self.outside.iter().enumerate() {
                if self.nearest[k as usize] < least {
                    (at, least) = (position, self.nearest[k as usize]);
                }
            }
            let node = self.outside.swap_remove(at) as usize;
            total += self.nearest[node];
            self.joined.push(node as u32);
            self.degree[node] += 1;
            self.degree[self.parent[node] as usize] += 1;
            let row = problem.row(node);
            for &k in &self.outside {
                let k = k as usize;
                let cost = row[k] + prices[node] + prices[k];
                if cost < self.nearest[k] {
                    self.nearest[k] = cost;
                    self.parent[k] = node as u32;
                }
            }
        }
        let end = (0..home)
            .filter(|&k| k != root || home == 1)
            .min_by(|&a, &b| prices[a].total_cmp(&prices[b]))
            .unwrap_or(root);
        for node in [root, end] {
            total += prices[home] + prices[node];
            self.degree[node] += 1;
            self.degree[home] += 1;
        }
        total - 2.0 * prices.iter().sum::<f64>()
    }
}

/// An edge that a tour cheaper than some cutoff may use.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Edge {
    pub a: usize,
    pub b: usize,
    pub cost: f64,
    /// What a 1-tree costs more if it must hold this edge.
    pub excess: f64,
}

/// All edges that some tour cheaper than `cutoff` may hold: forcing any other into the 1-tree of
/// these prices raises its cost to the cutoff at least.
pub(super) fn useful_edges(problem: &TourProblem, prices: &[f64], cutoff: f64) -> Vec<Edge> {
    let mut tree = Tree::new(problem.nodes);
    let bound = tree.build(problem, prices);
    let (home, start) = (problem.home(), problem.start);
    // The dearest edge on the tree's path between any two points; nodes in the order they joined.
    let n = home;
    let mut dearest = vec![f64::NEG_INFINITY; n * n];
    for (joined, &node) in tree.joined.iter().enumerate() {
        let (node, parent) = (node as usize, tree.parent[node as usize] as usize);
        let edge = tree.nearest[node];
        for &other in std::iter::once(&(start as u32)).chain(&tree.joined[..joined]) {
            let other = other as usize;
            let worst = if other == parent { edge } else { edge.max(dearest[parent * n + other]) };
            dearest[node * n + other] = worst;
            dearest[other * n + node] = worst;
        }
    }
    let mut edges = vec![Edge { a: start, b: home, cost: 0.0, excess: 0.0 }];
    let cheapest_end = (0..n).filter(|&k| k != start).map(|k| prices[k]).fold(f64::INFINITY, f64::min);
    for a in 0..n {
        for b in a + 1..n {
            let excess = problem.cost(a, b) + prices[a] + prices[b] - dearest[a * n + b];
            if bound + excess <= cutoff {
                edges.push(Edge { a, b, cost: problem.cost(a, b), excess: excess.max(0.0) });
            }
        }
        let excess = prices[a] - cheapest_end;
        if a != start && bound + excess <= cutoff {
            edges.push(Edge { a, b: home, cost: 0.0, excess });
        }
    }
    edges
}

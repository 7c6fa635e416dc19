//! A way around obstacles between two joint states: RRT-Connect and shortcuts.
//!
//! Two trees grow towards each other from both ends (Kuffner and LaValle 2000).
//! Every edge is checked continuously. Seeded and bounded: the same question
//! gets the same answer, and a question without an answer ends.

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::joints::{Joints, difference, lerp, norm};
use super::scene::Scene;
use super::sweep::Sweeper;
use super::work::cost;

/// Longest edge of a tree, radians in joint space.
const STEP_RAD: f64 = 0.5;
/// How far beyond the box around both ends samples are drawn, radians a joint.
const AROUND_RAD: f64 = 1.0;
/// Every so many samples one is drawn from a wider box.
const WIDE_EVERY: usize = 4;
/// Half the width of the wider box around the middle, radians a joint.
const WIDE_RAD: f64 = 3.2;
/// Shortcuts tried on a found path.
const SHORTCUTS: usize = 60;

/// Bounds and randomness of one search.
pub(crate) struct Search {
    pub seed: u64,
    pub iterations: usize,
}

/// Checks of straight moves.
struct Moves<'a, 's> {
    scene: &'a Scene<'s>,
    sweeper: &'a mut Sweeper,
    relief_m: f64,
}

impl Moves<'_, '_> {
    fn is_free(&mut self, from: &Joints, to: &Joints) -> bool {
        self.sweeper.is_free(self.scene, from, to, &[0.0; 8], self.relief_m)
    }
}

struct Tree {
    nodes: Vec<Joints>,
    parents: Vec<usize>,
}

/// Waypoints from `from` to `to`, both included, with every straight piece free
/// (margins less by `relief_m`); the iterations used either way.
pub(crate) fn detour(
    scene: &Scene,
    sweeper: &mut Sweeper,
    from: &Joints,
    to: &Joints,
    relief_m: f64,
    search: &Search,
) -> (Option<Vec<Joints>>, usize) {
    let mut rng = ChaCha8Rng::seed_from_u64(search.seed);
    let mut moves = Moves { scene, sweeper, relief_m };
    let limits = scene.limits();
    let mut trees = [Tree::rooted(from), Tree::rooted(to)];
    for iteration in 0..search.iterations {
        if moves.sweeper.work().is_over() {
            return (None, iteration);
        }
        let wide = iteration % WIDE_EVERY == WIDE_EVERY - 1;
        let target = sample(&mut rng, from, to, &limits, wide);
        let [growing, other] = if iteration % 2 == 0 {
            let [a, b] = &mut trees;
            [a, b]
        } else {
            let [a, b] = &mut trees;
            [b, a]
        };
        let Some(tip) = growing.extend(&target, &mut moves) else { continue };
        let goal = growing.nodes[tip];
        let Some(met) = other.connect(&goal, &mut moves) else { continue };
        let (first, second) = if iteration % 2 == 0 {
            (growing.path_to(tip), other.path_to(met))
        } else {
            (other.path_to(met), growing.path_to(tip))
        };
        let mut path = first;
        path.extend(second.into_iter().rev().skip(1));
        return (Some(shortened(path, &mut rng, &mut moves)), iteration + 1);
    }
    (None, search.iterations)
}

impl Tree {
    fn rooted(at: &Joints) -> Self {
        Self { nodes: vec![*at], parents: vec![0] }
    }

    fn nearest(&self, target: &Joints) -> usize {
        let distance = |q: &Joints| norm(&difference(q, target));
        let nodes = self.nodes.iter().enumerate().map(|(i, q)| (i, distance(q)));
        nodes.min_by(|a, b| a.1.total_cmp(&b.1)).map_or(0, |(i, _)| i)
    }

    /// One step towards `target`; the new node.
    fn extend(&mut self, target: &Joints, moves: &mut Moves) -> Option<usize> {
        moves.sweeper.work().spend(cost::LEG * self.nodes.len() as u64);
        let parent = self.nearest(target);
        let from = self.nodes[parent];
        let length = norm(&difference(&from, target));
        if length < 1e-9 {
            return Some(parent);
        }
        let to = if length <= STEP_RAD { *target } else { lerp(&from, target, STEP_RAD / length) };
        moves.is_free(&from, &to).then(|| {
            self.nodes.push(to);
            self.parents.push(parent);
            self.nodes.len() - 1
        })
    }

    /// Steps towards `target` until it is reached (its node) or something is in the way.
    fn connect(&mut self, target: &Joints, moves: &mut Moves) -> Option<usize> {
        loop {
            let before = self.nodes.len();
            let tip = self.extend(target, moves)?;
            if self.nodes[tip] == *target || self.nodes.len() == before {
                return Some(tip);
            }
        }
    }

    fn path_to(&self, node: usize) -> Vec<Joints> {
        let mut path = vec![self.nodes[node]];
        let mut at = node;
        while at != 0 {
            at = self.parents[at];
            path.push(self.nodes[at]);
        }
        path.reverse();
        path
    }
}

fn sample(rng: &mut ChaCha8Rng, from: &Joints, to: &Joints, limits: &(Joints, Joints), wide: bool) -> Joints {
    std::array::from_fn(|j| {
        let (low, high) = if wide {
            let middle = 0.5 * (from[j] + to[j]);
            (middle - WIDE_RAD, middle + WIDE_RAD)
        } else {
            (from[j].min(to[j]) - AROUND_RAD, from[j].max(to[j]) + AROUND_RAD)
        };
        let (low, high) = (low.max(limits.0[j]), high.min(limits.1[j]));
        low + (high - low).max(0.0) * rng.random::<f64>()
    })
}

/// The path with corners cut wherever a straight move is free.
fn shortened(mut path: Vec<Joints>, rng: &mut ChaCha8Rng, moves: &mut Moves) -> Vec<Joints> {
    drop_needless(&mut path, moves);
    for _ in 0..SHORTCUTS {
        if path.len() <= 2 {
            break;
        }
        let pieces = (path.len() - 1) as f64;
        let (u, v) = (rng.random::<f64>() * pieces, rng.random::<f64>() * pieces);
        let (u, v) = if u < v { (u, v) } else { (v, u) };
        let (i, k) = (u as usize, v as usize);
        if i == k {
            continue;
        }
        let a = lerp(&path[i], &path[i + 1], u - i as f64);
        let b = lerp(&path[k], &path[k + 1], v - k as f64);
        if moves.is_free(&a, &b) {
            path.splice(i + 1..=k, [a, b]);
        }
    }
    drop_needless(&mut path, moves);
    path
}

/// Leaves out waypoints whose neighbours a free straight move joins.
fn drop_needless(path: &mut Vec<Joints>, moves: &mut Moves) {
    let mut i = 1;
    while i + 1 < path.len() {
        if moves.is_free(&path[i - 1], &path[i + 1]) {
            path.remove(i);
        } else {
            i += 1;
        }
    }
}

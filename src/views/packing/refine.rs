//! From nearly the best to the best nearby: repeated exact steps (sequential linear programming).
//!
//! At a local optimum of the least distance the touching pairs hold each other; the linearised
//! problem then has its optimum at a corner and the steps converge quadratically.

use super::step_program::{MOVES, Pair, best_moves};
use super::{Region, least_squared_distance};
use crate::geometry::Vector;

/// Gain in squared distance, relative, below which the optimum counts as reached.
const LEAST_GAIN: f64 = 1e-13;
/// Most steps.
const STEPS: usize = 60;
/// Pairs further apart than this many least distances cannot meet in one step.
const REACH: f64 = 1.5;

/// Moves all points but the first to the nearby set with the largest least distance.
pub(super) fn refine(points: &[Vector], region: &Region) -> Vec<Vector> {
    // Neighbours get near numbers, which keeps the linear algebra narrow. The fixed point stays first.
    let mut order: Vec<usize> = (1..points.len()).collect();
    order.sort_by(|&a, &b| points[a].x.total_cmp(&points[b].x).then(a.cmp(&b)));
    let mut current: Vec<Vector> = std::iter::once(0).chain(order).map(|k| points[k]).collect();
    let mut square = least_squared_distance(&current);
    let mut trust = 0.1 * square.sqrt();
    for _ in 0..STEPS {
        let (moves, predicted) = step(&current, square, trust, region);
        if predicted - square < LEAST_GAIN * square || trust < 1e-13 {
            break;
        }
        let moved = apply(&current, &moves, region);
        let reached = least_squared_distance(&moved);
        let share = (reached - square) / (predicted - square);
        if reached > square {
            current = moved;
            square = reached;
        }
        if share < 0.25 {
            trust *= 0.25;
        } else if share > 0.75 {
            trust = (2.0 * trust).min(0.2 * square.sqrt());
        }
    }
    current
}

fn step(points: &[Vector], square: f64, trust: f64, region: &Region) -> (Vec<f64>, f64) {
    let reach = (square.sqrt() + 3.0 * trust).min(REACH * square.sqrt());
    let mut pairs = Vec::new();
    for (i, a) in points.iter().enumerate() {
        for (j, b) in points.iter().enumerate().take(i) {
            let distance = (a - b).norm_squared();
            if distance < reach * reach {
                pairs.push(Pair {
                    square: distance,
                    points: [Some(i - 1), j.checked_sub(1)],
                    slopes: [slopes(a, b), slopes(b, a)],
                });
            }
        }
    }
    let mut low = vec![-trust; MOVES * (points.len() - 1)];
    let mut high = vec![trust; low.len()];
    for (k, point) in points[1..].iter().enumerate() {
        // The meridian's slope turns a bound on the height into one on the move.
        let horizontal = horizontal(point).max(1e-6);
        let meridian = MOVES * k + 1;
        low[meridian] = ((region.low - point.z) / horizontal).clamp(-trust, 0.0);
        high[meridian] = ((region.high - point.z) / horizontal).clamp(0.0, trust);
        // Where both rims meet there is no interior; the move is cut back afterwards.
        if high[meridian] - low[meridian] < 1e-9 * trust {
            low[meridian] -= 0.5e-9 * trust;
            high[meridian] += 0.5e-9 * trust;
        }
    }
    best_moves(&pairs, &low, &high, 0.01 * LEAST_GAIN * square)
}

/// Change of the squared distance to `b` when `a` moves east and north.
fn slopes(a: &Vector, b: &Vector) -> [f64; MOVES] {
    let (east, north) = axes(a);
    [-2.0 * east.dot(b), -2.0 * north.dot(b)]
}

fn horizontal(point: &Vector) -> f64 {
    (point.x * point.x + point.y * point.y).sqrt()
}

/// Unit vectors along the parallel and the meridian; x and y at a pole.
fn axes(point: &Vector) -> (Vector, Vector) {
    let horizontal = horizontal(point);
    if horizontal < 1e-9 {
        return (Vector::x(), Vector::y());
    }
    let east = Vector::new(-point.y / horizontal, point.x / horizontal, 0.0);
    (east, point.cross(&east))
}

fn apply(points: &[Vector], moves: &[f64], region: &Region) -> Vec<Vector> {
    let mut moved = vec![points[0]];
    for (point, change) in points[1..].iter().zip(moves.chunks_exact(MOVES)) {
        let (east, north) = axes(point);
        let target = point + east * change[0] + north * change[1];
        let z = (point.z + north.z * change[1]).clamp(region.low, region.high);
        let scale = (1.0 - z * z).max(0.0).sqrt() / horizontal(&target).max(1e-12);
        moved.push(Vector::new(target.x * scale, target.y * scale, z));
    }
    moved
}

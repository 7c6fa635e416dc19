//! Good paths quickly: nearest neighbour, then 2-opt and or-opt moves, then kicks.
//!
//! A path is an array whose first entry is the start and stays there; the end is free, so a
//! move may also reverse or extend the tail at the cost of a single edge.

use rand::Rng;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

use super::CostMatrix;

/// A change must gain more than this share of the longest edge, or rounding could loop.
const LEAST_GAIN: f64 = 1e-12;

/// From the start always to the nearest point not yet visited.
pub fn nearest_neighbour(matrix: &CostMatrix, start: usize) -> Vec<usize> {
    let n = matrix.len();
    let mut visited = vec![false; n];
    let mut order = vec![start];
    visited[start] = true;
    let mut last = start;
    while order.len() < n {
        let row = matrix.row(last);
        let next =
            (0..n).filter(|&k| !visited[k]).min_by(|&a, &b| row[a].total_cmp(&row[b])).unwrap_or(start);
        visited[next] = true;
        order.push(next);
        last = next;
    }
    order
}

/// Reverses stretches of `order` as long as that shortens it (2-opt).
pub fn two_opt(matrix: &CostMatrix, order: &mut [usize]) {
    let least = least_gain(matrix);
    while improve_by_reversal(matrix, order, least) {}
}

/// A short path: 2-opt and or-opt from the nearest-neighbour path, then `kicks` random
/// perturbations, each repaired and kept if not worse. Deterministic.
pub(super) fn search(matrix: &CostMatrix, start: usize, kicks: usize) -> Vec<usize> {
    let least = least_gain(matrix);
    let mut best = nearest_neighbour(matrix, start);
    descend(matrix, &mut best, least);
    let mut best_length = matrix.path_length(&best);
    let mut rng = ChaCha8Rng::seed_from_u64(best.len() as u64);
    for _ in 0..if best.len() < 5 { 0 } else { kicks } {
        let mut candidate = best.clone();
        exchange_neighbours(&mut candidate, &mut rng);
        descend(matrix, &mut candidate, least);
        let length = matrix.path_length(&candidate);
        if length < best_length {
            best = candidate;
            best_length = length;
        }
    }
    best
}

fn least_gain(matrix: &CostMatrix) -> f64 {
    let longest = (0..matrix.len()).flat_map(|i| matrix.row(i).iter().copied()).fold(0.0f64, f64::max);
    LEAST_GAIN * longest
}

fn descend(matrix: &CostMatrix, order: &mut [usize], least: f64) {
    while improve_by_reversal(matrix, order, least) || improve_by_moving(matrix, order, least) {}
}

fn improve_by_reversal(matrix: &CostMatrix, order: &mut [usize], least: f64) -> bool {
    let n = order.len();
    let symmetric = matrix.is_symmetric();
    let mut improved = false;
    for i in 1..n {
        for j in i + 1..n {
            let (before, first, last) = (order[i - 1], order[i], order[j]);
            let after = order.get(j + 1).copied();
            let mut gain = matrix.get(before, first) - matrix.get(before, last);
            if let Some(after) = after {
                gain += matrix.get(last, after) - matrix.get(first, after);
            }
            if !symmetric {
                for pair in order[i..=j].windows(2) {
                    gain += matrix.get(pair[0], pair[1]) - matrix.get(pair[1], pair[0]);
                }
            }
            if gain > least {
                order[i..=j].reverse();
                improved = true;
            }
        }
    }
    improved
}

/// Moves stretches of one to three points elsewhere.
fn improve_by_moving(matrix: &CostMatrix, order: &mut [usize], least: f64) -> bool {
    let n = order.len();
    let mut improved = false;
    for length in 1..=3usize {
        for i in 1..n {
            let j = i + length;
            if j > n {
                break;
            }
            let (before, first, last) = (order[i - 1], order[i], order[j - 1]);
            let mut freed = matrix.get(before, first);
            if let Some(&after) = order.get(j) {
                freed += matrix.get(last, after) - matrix.get(before, after);
            }
            // Between order[k] and order[k + 1], outside the stretch.
            for k in (0..i - 1).chain(j..n) {
                let left = order[k];
                let mut cost = matrix.get(left, first);
                if let Some(&right) = order.get(k + 1) {
                    cost += matrix.get(last, right) - matrix.get(left, right);
                }
                if freed - cost > least {
                    if k < i {
                        order[k + 1..j].rotate_right(length);
                    } else {
                        order[i..=k].rotate_left(length);
                    }
                    improved = true;
                    break;
                }
            }
        }
    }
    improved
}

/// Exchanges two stretches that follow each other (double bridge), each up to 50 points.
fn exchange_neighbours(order: &mut [usize], rng: &mut impl Rng) {
    let n = order.len();
    let first = rng.random_range(1..n - 1);
    let left = rng.random_range(1..=(n - 1 - first).min(50));
    let right = rng.random_range(1..=(n - first - left).clamp(1, 50));
    let end = (first + left + right).min(n);
    order[first..end].rotate_left(left);
}

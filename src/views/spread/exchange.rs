//! The tightest view to the largest hole, as long as that separates the set better.

use super::repulsion::least_squared_distance;
use super::settle::{Ground, settle};
use crate::geometry::Vector;

/// Most views moved.
const MOVES: usize = 12;

/// Improves a set of spots, the first of which stays.
pub(super) fn exchange(ground: &mut Ground, set: &mut Vec<usize>) {
    let mut square = least_square(&ground.spots, set);
    for _ in 0..MOVES {
        let Some((a, b)) = tightest(&ground.spots, set) else { return };
        let better = [a, b].into_iter().filter(|view| *view != 0).find_map(|view| {
            let mut tried = set.clone();
            tried.remove(view);
            tried.push(farthest(&nearest(&ground.spots, &tried)));
            let tried = settle(ground, tried, true);
            let reached = least_square(&ground.spots, &tried);
            (reached > square * (1.0 + 1e-9)).then_some((reached, tried))
        });
        let Some((reached, found)) = better else { return };
        square = reached;
        *set = found;
    }
}

/// Square of the least distance between two views.
pub(super) fn least_square(spots: &[Vector], set: &[usize]) -> f64 {
    let points: Vec<Vector> = set.iter().map(|spot| spots[*spot]).collect();
    least_squared_distance(&points)
}

/// The spot with the largest value, the first of equals.
pub(super) fn farthest(nearest: &[f64]) -> usize {
    let mut best = (0, f64::NEG_INFINITY);
    for (spot, square) in nearest.iter().enumerate() {
        if *square > best.1 {
            best = (spot, *square);
        }
    }
    best.0
}

/// Squared distance from each spot to the nearest view.
fn nearest(spots: &[Vector], set: &[usize]) -> Vec<f64> {
    let to_view = |spot: &Vector, view: &usize| (spot - spots[*view]).norm_squared();
    spots.iter().map(|spot| set.iter().map(|v| to_view(spot, v)).fold(f64::INFINITY, f64::min)).collect()
}

fn tightest(spots: &[Vector], set: &[usize]) -> Option<(usize, usize)> {
    let pairs = (0..set.len()).flat_map(|i| (0..i).map(move |j| (i, j)));
    let square = |(i, j): &(usize, usize)| (spots[set[*i]] - spots[set[*j]]).norm_squared();
    pairs.min_by(|p, q| square(p).total_cmp(&square(q)))
}

//! What a view at a place would suffer from the others.

use crate::geometry::Vector;

/// `sum over points but skip of (reference / squared distance)^(2^doublings)` at `place`; only the
/// terms up to the first that exceeds `enough` when the sum is more than that.
pub(super) fn repulsion(
    place: &Vector,
    points: &[Vector],
    skip: usize,
    reference: f64,
    doublings: u32,
    enough: f64,
) -> f64 {
    let mut sum = 0.0;
    for (index, point) in points.iter().enumerate() {
        if index == skip {
            continue;
        }
        let mut power = reference / (place - point).norm_squared().max(1e-30);
        for _ in 0..doublings {
            power *= power;
        }
        sum += power;
        if sum > enough {
            break;
        }
    }
    sum
}

/// Square of the least distance between two points.
pub(super) fn least_squared_distance(points: &[Vector]) -> f64 {
    let pairs = points.iter().enumerate().flat_map(|(i, a)| points.iter().take(i).map(move |b| (a, b)));
    pairs.map(|(a, b)| (a - b).norm_squared()).fold(f64::INFINITY, f64::min)
}

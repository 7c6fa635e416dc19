//! The generator: `n` points of a band as far apart as possible, one of them fixed.
//!
//! Many starts are relaxed under a repulsion whose exponent grows ([`energy`], minimised by
//! [`lbfgs`]); the best are then pushed to the exact local optimum of the least distance.
//! Only operations that IEEE 754 defines exactly are used (no libm), so that every machine finds
//! the same set.

mod energy;
mod lbfgs;
mod relax;
mod start;

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

use super::Band;
use crate::geometry::{Direction, Vector};

/// The part of the unit sphere to pack, in heights (z), and the fixed point.
#[derive(Debug, Clone, Copy)]
pub(super) struct Region {
    low: f64,
    high: f64,
    top: Vector,
}

impl Region {
    fn of(band: Band) -> Region {
        let (low, high) = band.heights();
        Region { low, high, top: Vector::new((1.0 - high * high).max(0.0).sqrt(), 0.0, high) }
    }
}

/// How long to search.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Effort {
    /// Pair distances the relaxations may compute, in all.
    pair_evaluations: u64,
    /// Least number of starts, whatever they cost.
    min_starts: usize,
    /// Largest number of starts.
    max_starts: usize,
}

impl Effort {
    /// About a second for a hundred points.
    pub(super) const INTERACTIVE: Effort =
        Effort { pair_evaluations: 100_000_000, min_starts: 4, max_starts: 200 };
}

/// `n >= 1` points of `band`, the first fixed at its top.
pub(super) fn pack(n: usize, band: Band, effort: Effort) -> Vec<Direction> {
    let region = Region::of(band);
    let mut best: Option<(f64, Vec<Vector>)> = None;
    let mut spent = 0;
    for attempt in 0..effort.max_starts {
        if n < 2 || (attempt >= effort.min_starts && spent >= effort.pair_evaluations) {
            break;
        }
        let mut rng = ChaCha8Rng::seed_from_u64((n as u64) << 32 | attempt as u64);
        let relaxed = relax::relax(start::random_points(n, &region, &mut rng), &region);
        spent += relaxed.pair_evaluations;
        let distance = least_squared_distance(&relaxed.points);
        if best.as_ref().is_none_or(|(least, _)| distance > *least) {
            best = Some((distance, relaxed.points));
        }
    }
    let points = best.map_or_else(|| vec![region.top], |(_, points)| points);
    points.into_iter().map(Direction::new_normalize).collect()
}

/// Square of the least distance between two points.
fn least_squared_distance(points: &[Vector]) -> f64 {
    let mut least = f64::INFINITY;
    for (i, a) in points.iter().enumerate() {
        for b in &points[..i] {
            least = least.min((a - b).norm_squared());
        }
    }
    least
}

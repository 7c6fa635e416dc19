//! The generator: `n` points of a band as far apart as possible, one of them fixed.
//!
//! Many starts are relaxed under a repulsion whose exponent grows ([`energy`], minimised by
//! [`lbfgs`]); the best are then pushed to the exact local optimum of the least distance ([`refine`]).
//! Only operations that IEEE 754 defines exactly are used (no libm), so that every machine finds
//! the same set.

mod cholesky;
mod energy;
mod lbfgs;
mod refine;
mod relax;
mod start;
mod step_program;

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
    pub pair_evaluations: u64,
    /// Least number of starts, whatever they cost.
    pub min_starts: usize,
    /// Largest number of starts.
    pub max_starts: usize,
}

impl Effort {
    /// About a second for a hundred points.
    pub(super) const INTERACTIVE: Effort =
        Effort { pair_evaluations: 600_000_000, min_starts: 4, max_starts: 300 };
    /// Some seconds: for tables.
    pub(super) const THOROUGH: Effort =
        Effort { pair_evaluations: 700_000_000, min_starts: 20, max_starts: 800 };
    /// One round of a long search.
    pub(super) const ROUND: Effort =
        Effort { pair_evaluations: 1_000_000_000, min_starts: 20, max_starts: 800 };
}

/// What refining a set costs beside a pair evaluation, per square of the number of points.
const REFINING: usize = 1500;
/// A relaxed set this much closer than the best (squared distance) is not worth refining.
const PROMISING: f64 = 0.985;

/// `n >= 1` points of `band`, the first fixed at its top.
pub(super) fn pack(n: usize, band: Band, effort: Effort) -> Vec<Direction> {
    pack_series(n, band, effort, 0)
}

/// As [`pack`], with other random draws for each `series`; 0 holds those of [`pack`].
pub(super) fn pack_series(n: usize, band: Band, effort: Effort, series: u16) -> Vec<Direction> {
    let [points] = pack_for(n, band, [effort], series);
    points
}

/// What [`pack`] finds with each of several efforts, least first, in one search.
///
/// Half of the attempts start at random; the other half move a few points of the best set so far,
/// which keeps the parts of it that are already good.
pub(super) fn pack_for<const K: usize>(
    n: usize,
    band: Band,
    efforts: [Effort; K],
    series: u16,
) -> [Vec<Direction>; K] {
    let region = Region::of(band);
    let mut best: Vec<Vector> = vec![region.top];
    let mut best_square = 0.0;
    let mut spent = 0;
    let mut attempt = 0;
    efforts.map(|effort| {
        // Few points have few arrangements.
        let most = if n < 2 { 0 } else { effort.max_starts.min(STARTS_PER_POINT * n) };
        while attempt < most && (attempt < effort.min_starts || spent < effort.pair_evaluations) {
            let mut rng =
                ChaCha8Rng::seed_from_u64((u64::from(series) << 48) | ((n as u64) << 32) | attempt as u64);
            let disturb = attempt >= FIRST_RANDOM && attempt % 2 == 1 && best.len() == n;
            let begin = if disturb {
                start::disturbed(&best, &region, &mut rng)
            } else {
                start::random_points(n, &region, &mut rng)
            };
            attempt += 1;
            let relaxed = relax::relax(begin, &region, disturb);
            spent += relaxed.pair_evaluations;
            if !(least_squared_distance(&relaxed.points) >= PROMISING * best_square) {
                continue;
            }
            let refined = refine::refine(&relaxed.points, &region);
            spent += (REFINING * n * n) as u64;
            let square = least_squared_distance(&refined);
            if square > best_square * (1.0 + 1e-12) {
                best_square = square;
                best = refined;
            }
        }
        canonical(best.clone()).into_iter().map(Direction::new_normalize).collect()
    })
}

/// Attempts per point after which nothing new is to be expected.
const STARTS_PER_POINT: usize = 10;
/// Attempts before the best set is worth disturbing.
const FIRST_RANDOM: usize = 6;

/// From the top down; where heights agree, by azimuth. The fixed point stays first.
fn canonical(mut points: Vec<Vector>) -> Vec<Vector> {
    let below = |a: &Vector, b: &Vector| {
        let rank = |v: &Vector| (-(v.z * 1e9).round(), (v.y < 0.0) as u8 as f64);
        rank(a).0.total_cmp(&rank(b).0).then(rank(a).1.total_cmp(&rank(b).1)).then_with(|| {
            // Upper half plane: x falls as the azimuth grows; lower half plane: it rises.
            if a.y < 0.0 { a.x.total_cmp(&b.x) } else { b.x.total_cmp(&a.x) }
        })
    };
    if let Some(free) = points.get_mut(1..) {
        free.sort_by(below);
    }
    points
}

/// Square of the least distance between two points; NaN if a point is NaN.
fn least_squared_distance(points: &[Vector]) -> f64 {
    let mut least = f64::INFINITY;
    for (i, a) in points.iter().enumerate() {
        for b in &points[..i] {
            let square = (a - b).norm_squared();
            if square.is_nan() {
                return square;
            }
            least = least.min(square);
        }
    }
    least
}

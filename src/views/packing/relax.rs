//! One start relaxed through growing exponents.

use super::Region;
use super::energy::Repulsion;
use super::lbfgs::{Stop, minimise};
use crate::geometry::Vector;

/// Stages: binary logarithm of the exponent, how far pairs are looked at (in least distances),
/// most evaluations. A soft repulsion first orders the points globally, hard ones then only
/// see neighbours and approach the largest least distance.
const STAGES: [(u32, f64, usize, f64); 5] =
    [(1, 1e9, 60, 1e-4), (3, 1e9, 80, 1e-4), (5, 3.5, 120, 1e-4), (7, 2.0, 150, 1e-4), (9, 1.5, 200, 1e-4)];

/// Points at rest, and what they cost.
pub(super) struct Relaxed {
    pub points: Vec<Vector>,
    /// Pair distances computed.
    pub pair_evaluations: u64,
}

/// Relaxes `points`, the first of which stays where it is. A set that is nearly in order skips the
/// softest repulsion, which would undo that.
pub(super) fn relax(mut points: Vec<Vector>, region: &Region, nearly_ordered: bool) -> Relaxed {
    let mut pair_evaluations = 0;
    for (doublings, reach, evaluations, decrease) in STAGES.into_iter().skip(usize::from(nearly_ordered)) {
        let mut repulsion = Repulsion::at(&points, region, doublings, reach);
        let mut coordinates = repulsion.coordinates();
        let max_step = 0.3 * repulsion.reference.sqrt().max(0.5 / (points.len() as f64).sqrt());
        let used = minimise(&mut coordinates, max_step, Stop { evaluations, decrease }, |x, gradient| {
            repulsion.evaluate(x, gradient)
        });
        pair_evaluations += (used * repulsion.pairs.len()) as u64;
        points = repulsion.points(&coordinates).to_vec();
    }
    Relaxed { points, pair_evaluations }
}

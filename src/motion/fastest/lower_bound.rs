//! A proven lower bound on the time of any order and choice of states.
//!
//! Between two views no leg is faster than the fastest between any two of
//! their states. With these times as costs, the shortest path through the
//! views (which may leave a view in another state than it came in) is a bound.

use std::time::Duration;

use super::states::StateTable;
use crate::order::{CostMatrix, shortest_path};

/// Most states for which the bound is computed: their pairs are looked at one by one.
const MOST_STATES: usize = 4000;
/// Relative error of a leg's time in single precision, with room to spare.
const ROUNDING: f64 = 1e-5;
/// Work after which the bound that is proven so far is taken; it is counted, not timed.
const BUDGET: Duration = Duration::from_millis(100);

/// Seconds that all legs together take at least, from the first cluster through all others;
/// `None` for tables that are too large.
pub(super) fn lower_bound_s(table: &StateTable) -> Option<f64> {
    let n = table.clusters();
    if n < 2 || table.range(n - 1).end > MOST_STATES {
        return None;
    }
    let mut costs = vec![0.0; n * n];
    for a in 0..n {
        for b in 0..a {
            let fastest = f64::from(table.fastest(a, b));
            costs[a * n + b] = fastest;
            costs[b * n + a] = fastest;
        }
    }
    let matrix = CostMatrix::from_rows(n, costs).ok()?;
    // Times are in single precision: what they may be too long by comes off.
    shortest_path(&matrix, 0, BUDGET).ok().map(|path| path.lower_bound * (1.0 - ROUNDING))
}

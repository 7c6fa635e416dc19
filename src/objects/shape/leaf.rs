//! Thin sheets: leaves, petals, paper. They have an end, so they are seen from both sides.

use super::assembly::{Assembly, WHOLE};
use crate::objects::frame::V;

impl Assembly {
    /// A sheet of `cells` (across, along) cells; `point(s, t)` for s from -1 to 1 across and t from 0 to 1 along.
    pub(in crate::objects) fn sheet(
        &mut self,
        cells: (usize, usize),
        paint: u32,
        point: impl Fn(f64, f64) -> V,
    ) {
        let rings: Vec<Vec<V>> = (0..=cells.1)
            .map(|j| {
                let t = j as f64 / cells.1 as f64;
                (0..=cells.0).map(|i| point(2.0 * i as f64 / cells.0 as f64 - 1.0, t)).collect()
            })
            .collect();
        self.part(false, |a| a.skin(&rings, false, WHOLE, paint));
    }
}

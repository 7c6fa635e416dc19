//! The transpose of the look-up: adds feature gradients to the grid's gradient.

use super::block::Block;
use super::gradients::GridGradient;
use super::hash_grid::{Corners, ENTRY, HashGrid};
use crate::nerf::simd::{LINE, Simd};

/// Adds what `block.d_features` means for the table, and marks the lines touched.
#[inline(always)]
pub(super) fn scatter<S: Simd>(s: S, grid: &HashGrid, block: &Block, gradient: &mut GridGradient) {
    // The entries are in range of `grid.table`; equal lengths make them so here.
    assert_eq!(gradient.table.len(), grid.table.len());
    assert_eq!(gradient.touched.len(), grid.table.len());
    let table = gradient.table.as_mut_ptr().cast::<f32>();
    let touched = gradient.touched.as_mut_ptr();
    let mut corners = Corners::EMPTY;
    for (level, rows) in grid.levels.iter().zip(block.d_features.chunks_exact(ENTRY)) {
        corners.find(level, &block.position);
        for first in (0..block.used).step_by(4) {
            let quads = s.transpose([0, 1, 2, 3].map(|f| s.load_quad(&rows[f].0, first)));
            for (k, quad) in quads.into_iter().enumerate() {
                let i = first + k;
                let pair = s.spread_halves(quad, corners.along_x.0[i]);
                for (entries, weights) in corners.entry.iter().zip(&corners.weight) {
                    let entry = entries[i] as usize;
                    // SAFETY: `Corners::find` yields entries that, with their
                    // successor, lie in the table; a line holds LINE / ENTRY of them.
                    unsafe {
                        s.add_to_pair(table.add(entry * ENTRY), weights.0[i], pair);
                        *touched.add(entry / (LINE / ENTRY)) = 1;
                        *touched.add((entry + 1) / (LINE / ENTRY)) = 1;
                    }
                }
            }
        }
    }
}

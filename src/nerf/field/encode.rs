//! Looks up the hash grid: trilinear interpolation on every level.

use super::block::FEATURES;
use super::hash_grid::{Corners, ENTRY, HashGrid};
use crate::nerf::simd::{LINE, Lanes, Simd};

/// Features of the first `used` samples at `position`, rounded up to four.
#[inline(always)]
pub(super) fn encode<S: Simd>(
    s: S,
    grid: &HashGrid,
    position: &[Lanes; 3],
    used: usize,
    features: &mut [Lanes; FEATURES],
) {
    let table = grid.table.as_ptr().cast::<f32>();
    let entries = grid.table.len() * LINE / ENTRY;
    let mut corners = Corners::EMPTY;
    for (level, rows) in grid.levels.iter().zip(features.chunks_exact_mut(ENTRY)) {
        corners.find(level, position);
        for first in (0..used).step_by(4) {
            let mut quads = [s.load_quad(&rows[0].0, first); 4];
            for (k, quad) in quads.iter_mut().enumerate() {
                let i = first + k;
                let load = |pair: usize| {
                    let entry = corners.entry[pair][i] as usize;
                    debug_assert!(entry + 1 < entries);
                    // SAFETY: `Corners::find` yields entries that, with their
                    // successor, lie in the level and so in the table.
                    unsafe { s.load_pair(table.add(entry * ENTRY)) }
                };
                let mut sum = s.scale_pair(load(0), corners.weight[0].0[i]);
                sum = s.fma_pair(load(1), corners.weight[1].0[i], sum);
                sum = s.fma_pair(load(2), corners.weight[2].0[i], sum);
                sum = s.fma_pair(load(3), corners.weight[3].0[i], sum);
                *quad = s.blend_halves(sum, corners.along_x.0[i]);
            }
            for (row, quad) in rows.iter_mut().zip(s.transpose(quads)) {
                s.store_quad(&mut row.0, first, quad);
            }
        }
    }
}

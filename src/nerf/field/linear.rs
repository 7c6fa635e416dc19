//! Small matrix products on blocks of 64 samples, in register tiles.

use super::Block;
use super::layer::TILE;
use crate::nerf::simd::{LANES, Lanes, Line, Simd};

/// What happens to a product before it is stored.
pub(super) trait Finish: Copy {
    fn apply<S: Simd>(self, s: S, x: S::V, row: usize, at: usize) -> S::V;
}

/// Stores it as it is.
#[derive(Clone, Copy)]
pub(super) struct Plain;
/// Rectifies it.
#[derive(Clone, Copy)]
pub(super) struct Rectify;
/// Lets it through where the forward activation was positive.
#[derive(Clone, Copy)]
pub(super) struct Mask<'a>(pub &'a [Lanes]);

impl Finish for Plain {
    #[inline(always)]
    fn apply<S: Simd>(self, _: S, x: S::V, _: usize, _: usize) -> S::V {
        x
    }
}
impl Finish for Rectify {
    #[inline(always)]
    fn apply<S: Simd>(self, s: S, x: S::V, _: usize, _: usize) -> S::V {
        s.max(x, s.splat(0.0))
    }
}
impl Finish for Mask<'_> {
    #[inline(always)]
    fn apply<S: Simd>(self, s: S, x: S::V, row: usize, at: usize) -> S::V {
        s.where_positive(s.load(&self.0[row].0, at), x)
    }
}

/// `y = finish(W x)` for the first `y.len()` rows of `W` (a multiple of four),
/// packed as in [`super::Layer`]. A tile is four rows by `T` vectors.
#[inline(always)]
pub(super) fn linear<S: Simd, const T: usize>(
    s: S,
    packed: &[[f32; TILE]],
    x: &[Lanes],
    y: &mut [Lanes],
    finish: impl Finish,
) {
    let tiles = packed.chunks_exact(x.len()).zip(y.chunks_exact_mut(TILE));
    for (tile, (weights, rows)) in tiles.enumerate() {
        for first in (0..LANES).step_by(S::WIDTH * T) {
            let mut sums = [[s.splat(0.0); T]; TILE];
            for (w, x) in weights.iter().zip(x) {
                let mut input = [s.splat(0.0); T];
                for (v, input) in input.iter_mut().enumerate() {
                    *input = s.load(&x.0, first + v * S::WIDTH);
                }
                for r in 0..TILE {
                    let w = s.splat(w[r]);
                    for v in 0..T {
                        sums[r][v] = s.fma(w, input[v], sums[r][v]);
                    }
                }
            }
            for (r, (row, sums)) in rows.iter_mut().zip(sums).enumerate() {
                for (v, sum) in sums.into_iter().enumerate() {
                    let at = first + v * S::WIDTH;
                    s.store(&mut row.0, at, finish.apply(s, sum, tile * TILE + r, at));
                }
            }
        }
    }
}

/// Adds `sum over samples of dy[o] x[i]` to the weight gradient `[o][i]`, kept as
/// partial sums: one line a weight. A tile is four outputs by `T` inputs.
#[inline(always)]
pub(super) fn add_outer_products<S: Simd, const T: usize>(
    s: S,
    blocks: &[Block],
    dy: impl Fn(&Block) -> &[Lanes],
    x: impl Fn(&Block) -> &[Lanes],
    sums: &mut [Line],
) {
    let Some(first) = blocks.first() else { return };
    let (outputs, inputs) = (dy(first).len(), x(first).len());
    for o in (0..outputs).step_by(TILE) {
        for i in (0..inputs).step_by(T) {
            let mut tile = [[s.splat(0.0); T]; TILE];
            for r in 0..TILE {
                for c in 0..T {
                    tile[r][c] = s.load(&sums[(o + r) * inputs + i + c].0, 0);
                }
            }
            for block in blocks {
                let (dy, x) = (&dy(block)[o..o + TILE], &x(block)[i..i + T]);
                for at in (0..LANES).step_by(S::WIDTH) {
                    let mut columns = [s.splat(0.0); T];
                    for c in 0..T {
                        columns[c] = s.load(&x[c].0, at);
                    }
                    for r in 0..TILE {
                        let d = s.load(&dy[r].0, at);
                        for c in 0..T {
                            tile[r][c] = s.fma(d, columns[c], tile[r][c]);
                        }
                    }
                }
            }
            for r in 0..TILE {
                for c in 0..T {
                    s.store(&mut sums[(o + r) * inputs + i + c].0, 0, tile[r][c]);
                }
            }
        }
    }
}

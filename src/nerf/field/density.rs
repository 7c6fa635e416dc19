//! Opacity alone: what decides which samples are worth a colour.

use super::block::{DensityBlock, HIDDEN};
use super::encode::encode;
use super::linear::{Rectify, linear};
use super::{DENSITY_SLOPE, Field};
use crate::nerf::simd::{LANES, Lanes, Simd, kernel};

kernel! {
    /// Fills `features` and `alpha` of the first `samples` lanes of `blocks` from
    /// their positions; `step` is the length of a step in units of the cube's edge.
    fn density(
        field: &Field,
        step: f32,
        blocks: &mut [DensityBlock],
        samples: usize,
    ) = density_body
}

#[inline(always)]
fn density_body<S: Simd, const T: usize>(
    s: S,
    field: &Field,
    step: f32,
    blocks: &mut [DensityBlock],
    samples: usize,
) {
    let mut hidden = [Lanes::ZERO; HIDDEN];
    let used = samples.div_ceil(LANES);
    for (b, block) in blocks[..used].iter_mut().enumerate() {
        let used = (samples - b * LANES).min(LANES);
        encode(s, &field.grid, &block.position, used, &mut block.features);
        linear::<S, T>(s, &field.density_in.packed, &block.features, &mut hidden, Rectify);
        for at in (0..LANES).step_by(S::WIDTH) {
            let mut raw = s.splat(0.0);
            for (w, h) in field.density_out.packed.iter().zip(&hidden) {
                raw = s.fma(s.splat(w[0]), s.load(&h.0, at), raw);
            }
            let depth = optical_depth(s, raw, step);
            let alpha = s.sub(s.splat(1.0), s.exp(s.sub(s.splat(0.0), depth)));
            s.store(&mut block.alpha.0, at, alpha);
        }
    }
}

/// `step * exp(2 raw)`
#[inline(always)]
pub(super) fn optical_depth<S: Simd>(s: S, raw: S::V, step: f32) -> S::V {
    s.mul(s.exp(s.mul(raw, s.splat(DENSITY_SLOPE))), s.splat(step))
}

//! Density and colour of the samples that matter.

use super::Field;
use super::block::{Block, GEOMETRY};
use super::density::optical_depth;
use super::linear::{Plain, Rectify, linear};
use crate::nerf::simd::{LANES, Simd, kernel};

kernel! {
    /// From `features` and the harmonics in `middle` to `optical_depth`, `alpha`
    /// and `colour` of each block; `step` in units of the cube's edge.
    fn forward(field: &Field, step: f32, blocks: &mut [Block]) = forward_body
}

#[inline(always)]
fn forward_body<S: Simd, const T: usize>(s: S, field: &Field, step: f32, blocks: &mut [Block]) {
    for block in blocks {
        linear::<S, T>(s, &field.density_in.packed, &block.features, &mut block.density_hidden, Rectify);
        let density = &mut block.middle[..GEOMETRY];
        linear::<S, T>(s, &field.density_out.packed, &block.density_hidden, density, Plain);
        linear::<S, T>(s, &field.colour_in.packed, &block.middle[1..], &mut block.colour_hidden, Rectify);
        linear::<S, T>(s, &field.colour_out.packed, &block.colour_hidden, &mut block.colour, Plain);
        let one = s.splat(1.0);
        for at in (0..LANES).step_by(S::WIDTH) {
            let depth = optical_depth(s, s.load(&block.middle[0].0, at), step);
            s.store(&mut block.optical_depth.0, at, depth);
            s.store(&mut block.alpha.0, at, s.sub(one, s.exp(s.sub(s.splat(0.0), depth))));
            for channel in &mut block.colour[..3] {
                let x = s.load(&channel.0, at);
                let sigmoid = s.div(one, s.add(one, s.exp(s.sub(s.splat(0.0), x))));
                s.store(&mut channel.0, at, sigmoid);
            }
        }
    }
}

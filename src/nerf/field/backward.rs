//! From gradients of colour and density to gradients of every parameter.

use super::Field;
use super::block::{Block, GEOMETRY};
use super::gradients::Gradients;
use super::linear::{Mask, Plain, add_outer_products, linear};
use super::scatter::scatter;
use crate::nerf::simd::{Simd, kernel};

kernel! {
    /// Adds to `gradients` what `d_colour` (before the sigmoid) and row 0 of
    /// `d_middle` (raw density) of each block mean for the parameters.
    fn backward(field: &Field, blocks: &mut [Block], gradients: &mut Gradients) = backward_body
}

#[inline(always)]
fn backward_body<S: Simd, const T: usize>(
    s: S,
    field: &Field,
    blocks: &mut [Block],
    gradients: &mut Gradients,
) {
    for b in blocks.iter_mut() {
        let transpose = &field.colour_out.packed_transpose;
        linear::<S, T>(s, transpose, &b.d_colour, &mut b.d_colour_hidden, Mask(&b.colour_hidden));
        let transpose = &field.colour_in.packed_transpose;
        linear::<S, T>(s, transpose, &b.d_colour_hidden, &mut b.d_middle[1..], Plain);
        let transpose = &field.density_out.packed_transpose;
        let d_density = &b.d_middle[..GEOMETRY];
        linear::<S, T>(s, transpose, d_density, &mut b.d_density_hidden, Mask(&b.density_hidden));
        let transpose = &field.density_in.packed_transpose;
        linear::<S, T>(s, transpose, &b.d_density_hidden, &mut b.d_features, Plain);
        scatter(s, &field.grid, b, &mut gradients.grid);
    }
    let g = gradients;
    add_outer_products::<S, T>(s, blocks, |b| &b.d_colour, |b| &b.colour_hidden, &mut g.colour_out);
    add_outer_products::<S, T>(s, blocks, |b| &b.d_colour_hidden, |b| &b.middle[1..], &mut g.colour_in);
    add_outer_products::<S, T>(
        s,
        blocks,
        |b| &b.d_middle[..GEOMETRY],
        |b| &b.density_hidden,
        &mut g.density_out,
    );
    add_outer_products::<S, T>(s, blocks, |b| &b.d_density_hidden, |b| &b.features, &mut g.density_in);
}

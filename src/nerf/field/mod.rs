//! The radiance field: hash grid, two small networks, their gradients and Adam.

mod adam;
mod backward;
mod block;
mod density;
mod encode;
mod forward;
mod gradients;
mod hash_grid;
mod layer;
mod linear;
mod scatter;
mod spherical_harmonics;

pub(super) use adam::{Adam, Rate};
pub(super) use backward::backward;
pub(super) use block::{Block, COLOUR_INPUTS, DensityBlock, FEATURES, GEOMETRY, HIDDEN, RGB};
pub(super) use density::density;
pub(super) use forward::forward;
pub(super) use gradients::Gradients;
pub(super) use hash_grid::HashGrid;
pub(super) use layer::Layer;
pub(super) use spherical_harmonics::{HARMONICS, spherical_harmonics};

use rand_chacha::ChaCha8Rng;

/// Raw density is the logarithm of the density divided by this.
pub(super) const DENSITY_SLOPE: f32 = 2.0;

/// Every parameter of a NeRF.
#[derive(Clone, Debug)]
pub(super) struct Field {
    pub grid: HashGrid,
    /// 20 features -> 32, rectified.
    pub density_in: Layer,
    /// 32 -> raw density and 15 numbers for the colour.
    pub density_out: Layer,
    /// 15 numbers and 9 spherical harmonics -> 32, rectified.
    pub colour_in: Layer,
    /// 32 -> red, green, blue before the sigmoid, and one unused row.
    pub colour_out: Layer,
}

impl Field {
    /// With `2^table_bits` entries in a hashed level of the grid.
    pub fn new(table_bits: u32, rng: &mut ChaCha8Rng) -> Field {
        Field {
            grid: HashGrid::new(table_bits, rng),
            density_in: Layer::new(FEATURES, HIDDEN, rng),
            density_out: Layer::new(HIDDEN, GEOMETRY, rng),
            colour_in: Layer::new(COLOUR_INPUTS, HIDDEN, rng),
            colour_out: Layer::new(HIDDEN, RGB, rng),
        }
    }
}

//! Sixty-four samples and everything the kernels compute for them.

use super::HARMONICS;
use super::hash_grid::{ENTRY, LEVELS};
use crate::nerf::simd::{LANES, Lanes};

/// Inputs of the density network.
pub(in crate::nerf) const FEATURES: usize = LEVELS * ENTRY;
/// Width of the hidden layer of both networks.
pub(in crate::nerf) const HIDDEN: usize = 32;
/// Outputs of the density network: raw density, then 15 inputs of the colour network.
pub(in crate::nerf) const GEOMETRY: usize = 16;
/// Inputs of the colour network.
pub(in crate::nerf) const COLOUR_INPUTS: usize = GEOMETRY - 1 + HARMONICS;
/// Outputs of the colour network; the fourth fills the tile.
pub(in crate::nerf) const RGB: usize = 4;

/// Samples of which only the density is asked.
#[derive(Clone)]
#[repr(C, align(64))]
pub(in crate::nerf) struct DensityBlock {
    /// In the unit cube.
    pub position: [Lanes; 3],
    pub features: [Lanes; FEATURES],
    /// Opacity of one step, `1 - exp(-optical depth)`.
    pub alpha: Lanes,
}

impl DensityBlock {
    pub const EMPTY: DensityBlock =
        DensityBlock { position: [Lanes::ZERO; 3], features: [Lanes::ZERO; FEATURES], alpha: Lanes::ZERO };
}

/// Samples that carry colour and gradients. Lanes from `used` on hold finite
/// leftovers whose gradients are zero.
#[derive(Clone)]
#[repr(C, align(64))]
pub(in crate::nerf) struct Block {
    pub position: [Lanes; 3],
    pub features: [Lanes; FEATURES],
    pub density_hidden: [Lanes; HIDDEN],
    /// Raw density, then the inputs of the colour network: 15 numbers and the
    /// spherical harmonics, which whoever adds a sample writes.
    pub middle: [Lanes; 1 + COLOUR_INPUTS],
    pub colour_hidden: [Lanes; HIDDEN],
    /// Red, green, blue in 0..1, and one unused row.
    pub colour: [Lanes; RGB],
    /// Density times step.
    pub optical_depth: Lanes,
    pub alpha: Lanes,
    /// Gradient of the loss before the sigmoid.
    pub d_colour: [Lanes; RGB],
    pub d_colour_hidden: [Lanes; HIDDEN],
    /// Row 0 is the raw density's; the last row (of the first harmonic) is not used.
    pub d_middle: [Lanes; GEOMETRY + 1],
    pub d_density_hidden: [Lanes; HIDDEN],
    pub d_features: [Lanes; FEATURES],
    /// The ray a sample lies on.
    pub ray: [u32; LANES],
    pub used: usize,
}

impl Block {
    pub const EMPTY: Block = Block {
        position: [Lanes::ZERO; 3],
        features: [Lanes::ZERO; FEATURES],
        density_hidden: [Lanes::ZERO; HIDDEN],
        middle: [Lanes::ZERO; 1 + COLOUR_INPUTS],
        colour_hidden: [Lanes::ZERO; HIDDEN],
        colour: [Lanes::ZERO; RGB],
        optical_depth: Lanes::ZERO,
        alpha: Lanes::ZERO,
        d_colour: [Lanes::ZERO; RGB],
        d_colour_hidden: [Lanes::ZERO; HIDDEN],
        d_middle: [Lanes::ZERO; GEOMETRY + 1],
        d_density_hidden: [Lanes::ZERO; HIDDEN],
        d_features: [Lanes::ZERO; FEATURES],
        ray: [0; LANES],
        used: 0,
    };
}

//! A fully connected layer without bias, stored as the kernels read it.

use rand::Rng;
use rand_chacha::ChaCha8Rng;

use crate::nerf::simd::{LINE, Line, flat};

/// Rows in a register tile.
pub(super) const TILE: usize = 4;

/// `outputs x inputs` weights.
#[derive(Clone, Debug)]
pub(in crate::nerf) struct Layer {
    pub inputs: usize,
    pub outputs: usize,
    /// Row-major; the product of the sizes is a multiple of 16.
    pub weights: Vec<Line>,
    /// Four outputs side by side: `[output / 4][input][output % 4]`.
    pub packed: Vec<[f32; TILE]>,
    /// The transpose in the same form: `[input / 4][output][input % 4]`.
    pub packed_transpose: Vec<[f32; TILE]>,
}

impl Layer {
    /// Uniform weights after Glorot and Bengio (2010). Sizes are multiples of 4.
    pub fn new(inputs: usize, outputs: usize, rng: &mut ChaCha8Rng) -> Layer {
        let bound = (6.0 / (inputs + outputs) as f32).sqrt();
        let mut weights = vec![Line::ZERO; inputs * outputs / LINE];
        for w in weights.iter_mut().flat_map(|line| &mut line.0) {
            *w = (rng.random::<f32>() * 2.0 - 1.0) * bound;
        }
        let cells = inputs * outputs / TILE;
        let mut layer = Layer {
            inputs,
            outputs,
            weights,
            packed: vec![[0.0; TILE]; cells],
            packed_transpose: vec![[0.0; TILE]; cells],
        };
        layer.pack();
        layer
    }

    /// Copies `weights` to the packed forms; to be called after each change.
    pub fn pack(&mut self) {
        let weights = flat(&self.weights);
        for (cell, packed) in self.packed.iter_mut().enumerate() {
            let (tile, input) = (cell / self.inputs, cell % self.inputs);
            *packed = std::array::from_fn(|r| weights[(tile * TILE + r) * self.inputs + input]);
        }
        for (cell, packed) in self.packed_transpose.iter_mut().enumerate() {
            let (tile, output) = (cell / self.outputs, cell % self.outputs);
            *packed = std::array::from_fn(|r| weights[output * self.inputs + tile * TILE + r]);
        }
    }
}

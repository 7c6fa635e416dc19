//! Gradients of every parameter, summed over a step.

use super::Field;
use crate::nerf::simd::{Line, Lines};

/// Gradient of the hash grid.
pub(in crate::nerf) struct GridGradient {
    pub table: Lines,
    /// One a line: 1 if the line has a gradient.
    pub touched: Vec<u8>,
}

/// Gradients of a [`Field`]; those of the networks as partial sums, one line a
/// weight in row-major order.
pub(in crate::nerf) struct Gradients {
    pub grid: GridGradient,
    pub density_in: Vec<Line>,
    pub density_out: Vec<Line>,
    pub colour_in: Vec<Line>,
    pub colour_out: Vec<Line>,
}

impl Gradients {
    /// Zero.
    pub fn new(field: &Field) -> Gradients {
        let lines = field.grid.table.len();
        let sums = |layer: &super::Layer| vec![Line::ZERO; layer.inputs * layer.outputs];
        Gradients {
            grid: GridGradient { table: Lines::new(lines), touched: vec![0; lines] },
            density_in: sums(&field.density_in),
            density_out: sums(&field.density_out),
            colour_in: sums(&field.colour_in),
            colour_out: sums(&field.colour_out),
        }
    }
}

/// Moves the partial sums to one gradient a weight and zeroes them.
pub(super) fn take_sums(sums: &mut [Line], gradient: &mut [f32]) {
    for (sum, g) in sums.iter_mut().zip(gradient) {
        let eight: [f32; 8] = std::array::from_fn(|i| sum.0[i] + sum.0[i + 8]);
        *g =
            ((eight[0] + eight[4]) + (eight[1] + eight[5])) + ((eight[2] + eight[6]) + (eight[3] + eight[7]));
        *sum = Line::ZERO;
    }
}

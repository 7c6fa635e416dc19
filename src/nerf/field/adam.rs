//! Adam (Kingma and Ba 2015), sparse on the hash grid: a line without a gradient
//! is left alone, moments and all.

use super::gradients::{Gradients, take_sums};
use super::{Field, Layer};
use crate::nerf::simd::{InstructionSet, LINE, Line, Lines, Simd, flat_mut, kernel};

const BETA_1: f32 = 0.9;
const EPSILON: f32 = 1e-10;

/// First and second moments of a line.
type Moments = [Line; 2];

/// State of the optimiser.
pub(in crate::nerf) struct Adam {
    steps: i32,
    square_decay: f32,
    /// [`Moments`] one after the other.
    grid: Lines,
    layers: [LayerState; 4],
}

struct LayerState {
    moments: Vec<Moments>,
    gradient: Vec<Line>,
    touched: Vec<u8>,
}

/// How far a step goes.
#[derive(Clone, Copy)]
pub(in crate::nerf) struct Rate {
    /// Learning rate of the hash grid.
    pub grid: f32,
    /// Learning rate of the networks.
    pub networks: f32,
    /// Factor on the gradients, one over the number of rays.
    pub scale: f32,
}

impl Adam {
    /// `square_decay` is the part of the second moments that stays in a step.
    pub fn new(field: &Field, square_decay: f32) -> Adam {
        let layers = [&field.density_in, &field.density_out, &field.colour_in, &field.colour_out];
        Adam {
            steps: 0,
            square_decay,
            grid: Lines::new(2 * field.grid.table.len()),
            layers: layers.map(|layer| LayerState {
                moments: vec![[Line::ZERO; 2]; layer.weights.len()],
                gradient: vec![Line::ZERO; layer.weights.len()],
                touched: vec![1; layer.weights.len()],
            }),
        }
    }

    /// One step along `gradients`, which it zeroes.
    pub fn step(&mut self, set: InstructionSet, field: &mut Field, gradients: &mut Gradients, rate: Rate) {
        self.steps = self.steps.saturating_add(1);
        // Undoes the moments' bias towards their initial zero.
        let bias = (1.0 - self.square_decay.powi(self.steps)).sqrt() / (1.0 - BETA_1.powi(self.steps));
        let grid = &mut gradients.grid;
        let factors = Factors { square_decay: self.square_decay, scale: rate.scale, size: rate.grid * bias };
        let (moments, _) = self.grid.as_chunks_mut();
        adam(set, &mut field.grid.table, &mut grid.table, moments, &mut grid.touched, factors);
        let factors = Factors { size: rate.networks * bias, ..factors };
        let layers: [(&mut Layer, &mut Vec<Line>); 4] = [
            (&mut field.density_in, &mut gradients.density_in),
            (&mut field.density_out, &mut gradients.density_out),
            (&mut field.colour_in, &mut gradients.colour_in),
            (&mut field.colour_out, &mut gradients.colour_out),
        ];
        for (state, (layer, sums)) in self.layers.iter_mut().zip(layers) {
            take_sums(sums, flat_mut(&mut state.gradient));
            let LayerState { moments, gradient, touched } = state;
            touched.fill(1);
            adam(set, &mut layer.weights, gradient, moments, touched, factors);
            layer.pack();
        }
    }
}

/// What a step multiplies by.
#[derive(Clone, Copy)]
pub(super) struct Factors {
    square_decay: f32,
    /// On gradients.
    scale: f32,
    /// On changes, less what undoes the moments' bias.
    size: f32,
}

kernel! {
    /// Steps each touched line and clears its gradient and its mark.
    fn adam(
        parameters: &mut [Line],
        gradient: &mut [Line],
        moments: &mut [Moments],
        touched: &mut [u8],
        factors: Factors,
    ) = adam_body
}

#[inline(always)]
fn adam_body<S: Simd, const T: usize>(
    s: S,
    parameters: &mut [Line],
    gradient: &mut [Line],
    moments: &mut [Moments],
    touched: &mut [u8],
    factors: Factors,
) {
    let Factors { square_decay, scale, size } = factors;
    let lines = parameters.iter_mut().zip(gradient).zip(moments).zip(touched);
    for (((p, g), [m, v]), touched) in lines {
        if *touched == 0 {
            continue;
        }
        *touched = 0;
        for at in (0..LINE).step_by(S::WIDTH) {
            let d = s.mul(s.load(&g.0, at), s.splat(scale));
            let m_new = s.fma(s.splat(BETA_1), s.load(&m.0, at), s.mul(s.splat(1.0 - BETA_1), d));
            let d2 = s.mul(d, d);
            let v_new =
                s.fma(s.splat(square_decay), s.load(&v.0, at), s.mul(s.splat(1.0 - square_decay), d2));
            let change = s.div(m_new, s.add(s.sqrt(v_new), s.splat(EPSILON)));
            let p_new = s.fma(s.splat(-size), change, s.load(&p.0, at));
            s.store(&mut m.0, at, m_new);
            s.store(&mut v.0, at, v_new);
            s.store(&mut p.0, at, p_new);
        }
        *g = Line::ZERO;
    }
}

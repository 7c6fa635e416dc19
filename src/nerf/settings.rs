//! How long and how a NeRF is trained.

use super::{InstructionSet, NerfError};

/// Settings of a training run. The same views, bounds and settings give the same
/// bytes on CPUs with the same instruction set.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NerfSettings {
    /// Optimiser steps, 1 to 1,000,000.
    pub steps: u32,
    /// Samples with colour and gradient in a step, 64 to 1,048,576: a step ends with the
    /// group of rays (about 1,024 samples) that reaches this number. Many small steps
    /// beat few large ones at the same product of the two.
    pub samples_per_step: u32,
    /// Seed of initial weights, rays and backgrounds.
    pub seed: u64,
    /// Adam's rate for the hash grid; constant for 60 % of the steps, then falling to 7 %.
    pub grid_rate: f32,
    /// Adam's rate for the two networks, with the same schedule.
    pub network_rate: f32,
    /// Whether to trust the silhouettes of images with alpha: nothing may appear where one
    /// view shows only background. True for masks as exact as rendered ones.
    pub carve: bool,
    /// Kernels to use.
    pub instruction_set: InstructionSet,
}

impl NerfSettings {
    /// 2,500 steps of 4,096 samples, as many steps as the paper's NeRFs.
    pub fn standard() -> NerfSettings {
        NerfSettings {
            steps: 2500,
            samples_per_step: 4096,
            seed: 0,
            grid_rate: 0.02,
            network_rate: 0.01,
            carve: false,
            instruction_set: InstructionSet::best(),
        }
    }

    /// About a tenth of the cost, for labels, which need many NeRFs: 2 to 3 dB below
    /// [`Self::standard`] at every number of views.
    pub fn label() -> NerfSettings {
        NerfSettings { steps: 1000, samples_per_step: 1024, carve: true, ..Self::standard() }
    }

    /// Checks every number against its bound.
    ///
    /// # Errors
    /// [`NerfError::Setting`] names the first that is out of bounds.
    pub fn check(&self) -> Result<(), NerfError> {
        let out = |field, value, bound| Err(NerfError::Setting { field, value, bound });
        if !(1..=1_000_000).contains(&self.steps) {
            return out("steps", f64::from(self.steps), "1 to 1000000");
        }
        if !(64..=1 << 20).contains(&self.samples_per_step) {
            return out("samples_per_step", f64::from(self.samples_per_step), "64 to 1048576");
        }
        for (field, rate) in [("grid_rate", self.grid_rate), ("network_rate", self.network_rate)] {
            if !(rate > 0.0 && rate <= 1.0) {
                return out(field, f64::from(rate), "greater than 0 and at most 1");
            }
        }
        Ok(())
    }

    /// The schedule's factor on both rates at `step`.
    pub(super) fn decay(&self, step: u32) -> f32 {
        let done = step as f32 / self.steps as f32;
        if done < 0.6 { 1.0 } else { 0.07f32.powf((done - 0.6) / 0.4) }
    }
}

impl Default for NerfSettings {
    /// [`Self::standard`]
    fn default() -> Self {
        Self::standard()
    }
}

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
    /// Binary logarithm of the entries of a hashed level of the grid, 10 to 19. A smaller
    /// table learns faster and stays in the caches, a larger one keeps more detail in the end.
    pub table_bits: u32,
    /// Part of the mean squared gradient that Adam keeps from step to step.
    pub square_decay: f32,
    /// Part of a ray's light that a sample must take to get a colour and a gradient, at most
    /// 0.01: a sample of a field that has learnt nothing takes 0.0104. A higher one spends the
    /// samples on more rays.
    pub least_weight: f32,
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
            table_bits: 15,
            square_decay: 0.99,
            least_weight: 3e-3,
            grid_rate: 0.02,
            network_rate: 0.01,
            carve: false,
            instruction_set: InstructionSet::best(),
        }
    }

    /// The quality of [`Self::standard`] within 0.2 dB at half its cost, for views whose alpha
    /// is exact: 2,000 steps of 2,048 samples inside the visual hull.
    pub fn carved() -> NerfSettings {
        NerfSettings {
            steps: 2000,
            samples_per_step: 2048,
            square_decay: 0.95,
            least_weight: 1e-2,
            carve: true,
            ..Self::standard()
        }
    }

    /// About a tenth of the cost, for labels, which need many NeRFs: 2 to 3 dB below
    /// [`Self::standard`] at every number of views.
    pub fn label() -> NerfSettings {
        NerfSettings { steps: 1000, samples_per_step: 1024, carve: true, ..Self::standard() }
    }

    /// A second budget for labels, 0.7 of the cost of [`Self::label`]: a smaller table, a shorter
    /// memory of squared gradients, higher rates and fewer faint samples let 750 steps do. Over
    /// four objects its PSNR is 0.3 dB lower with 5 views, 0.4 dB higher with 20 and 50, 0.2 dB
    /// with 100, so labels of the two budgets do not belong into one file.
    pub fn label_fast() -> NerfSettings {
        NerfSettings {
            steps: 750,
            table_bits: 14,
            square_decay: 0.95,
            least_weight: 1e-2,
            grid_rate: 0.03,
            network_rate: 0.015,
            ..Self::label()
        }
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
        if !(10..=19).contains(&self.table_bits) {
            return out("table_bits", f64::from(self.table_bits), "10 to 19");
        }
        if !(self.square_decay >= 0.0 && self.square_decay < 1.0) {
            return out("square_decay", f64::from(self.square_decay), "at least 0 and less than 1");
        }
        if !(self.least_weight >= 0.0 && self.least_weight <= 0.01) {
            return out("least_weight", f64::from(self.least_weight), "0 to 0.01");
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_preset_is_within_its_bounds_and_what_is_not_is_named() {
        for preset in [
            NerfSettings::standard(),
            NerfSettings::carved(),
            NerfSettings::label(),
            NerfSettings::label_fast(),
        ] {
            assert_eq!(preset.check(), Ok(()));
        }
        let field = |settings: NerfSettings| match settings.check() {
            Err(NerfError::Setting { field, .. }) => field,
            other => panic!("{other:?}"),
        };
        let fast = NerfSettings::label_fast();
        assert_eq!(field(NerfSettings { table_bits: 20, ..fast }), "table_bits");
        assert_eq!(field(NerfSettings { square_decay: 1.0, ..fast }), "square_decay");
        assert_eq!(field(NerfSettings { least_weight: f32::NAN, ..fast }), "least_weight");
        assert_eq!(field(NerfSettings { grid_rate: 0.0, ..fast }), "grid_rate");
    }
}

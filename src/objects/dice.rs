//! Seeded draws, the same on every machine.

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use sha2::{Digest, Sha256};

use super::exact::{exp, ln};

/// What objects and textures are drawn with.
pub(super) struct Dice(ChaCha8Rng);

impl Dice {
    /// Dice of their own for a name and a number.
    pub(super) fn of(name: &str, seed: u64) -> Self {
        let digest = Sha256::new().chain_update(seed.to_le_bytes()).chain_update(name.as_bytes()).finalize();
        Self(ChaCha8Rng::from_seed(digest.into()))
    }

    /// Evenly from `low` to `high`.
    pub(super) fn range(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.0.random::<f64>()
    }

    /// Evenly in the logarithm, so that each doubling is as likely; both positive.
    pub(super) fn log_range(&mut self, low: f64, high: f64) -> f64 {
        exp(self.range(ln(low), ln(high)))
    }

    /// About 0, rarely farther than `width` and never farther than twice that.
    pub(super) fn around_zero(&mut self, width: f64) -> f64 {
        (self.range(-1.0, 1.0) + self.range(-1.0, 1.0)) * width
    }

    /// A whole number from `low` to `high`, both included.
    pub(super) fn int(&mut self, low: u32, high: u32) -> u32 {
        self.0.random_range(low..=high.max(low))
    }

    /// True with this probability.
    pub(super) fn chance(&mut self, probability: f64) -> bool {
        self.0.random::<f64>() < probability
    }

    /// One of several; they must not be none.
    pub(super) fn pick<T: Copy>(&mut self, of: &[T]) -> T {
        of[self.int(0, of.len() as u32 - 1) as usize]
    }

    /// A seed for noise; small enough that octaves can add to it.
    pub(super) fn seed(&mut self) -> u32 {
        self.0.random::<u32>() >> 4
    }

    /// Evenly from 0 to 1.
    pub(super) fn unit(&mut self) -> f64 {
        self.0.random()
    }
}

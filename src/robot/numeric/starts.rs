//! The fixed sequence of joint states that numeric searches start from.

use std::f64::consts::TAU;

use crate::robot::{Joint, MAX_JOINTS};

/// Bases of the Halton sequence, one a joint.
const PRIMES: [u32; MAX_JOINTS] = [2, 3, 5, 7, 11, 13, 17];

/// Start number `index`: the joints' middles for 0, then the Halton sequence
/// (Halton 1960) over one turn about the middle, or the whole range if it is narrower.
pub(super) fn start(joints: &[Joint], index: u32) -> [f64; MAX_JOINTS] {
    let mut state = [0.0; MAX_JOINTS];
    for ((slot, joint), base) in state.iter_mut().zip(joints).zip(PRIMES) {
        let width = (joint.upper_rad - joint.lower_rad).min(TAU);
        let share = if index == 0 { 0.5 } else { radical_inverse(index, base) };
        *slot = joint.middle_rad() + width * (share - 0.5);
    }
    state
}

/// `index`'s digits in `base`, mirrored behind the point; in `(0, 1)`.
pub(in crate::robot) fn radical_inverse(mut index: u32, base: u32) -> f64 {
    let (mut value, mut weight) = (0.0, 1.0);
    while index > 0 {
        weight /= f64::from(base);
        value += weight * f64::from(index % base);
        index /= base;
    }
    value
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sequence_is_haltons() {
        let first: Vec<f64> = (1..5).map(|i| radical_inverse(i, 2)).collect();
        assert_eq!(first, [0.5, 0.25, 0.75, 0.125]);
        assert!((radical_inverse(5, 3) - 7.0 / 9.0).abs() < 1e-15);
    }
}

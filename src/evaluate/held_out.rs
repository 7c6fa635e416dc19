//! Splits by object, as the training package does: an object's sizes and variants share a fold.

use sha2::{Digest, Sha256};

use crate::objects::original_key;

const FOLDS: u64 = 10;

/// The object's key without what marks a size or a variant of it.
pub fn group_of(key: &str) -> &str {
    original_key(key).split(['#', '@']).next().unwrap_or(key)
}

/// A number from 0 to 9, the same on every machine and in `prvnet.splits`.
pub fn fold_of(group: &str) -> u64 {
    let digest = Sha256::digest(group.as_bytes());
    digest.iter().take(8).fold(0, |number, byte| (number << 8) | u64::from(*byte)) % FOLDS
}

/// Whether networks of `turn` (0 to 4, which together hold every object out once) never see this object, neither to
/// learn from nor to be chosen by.
pub fn is_held_out(object: &str, turn: u32) -> bool {
    fold_of(group_of(object)) / 2 == u64::from(turn)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn folds_are_those_of_the_training_package() {
        // models/training/tests/test_light.py holds the same numbers.
        assert_eq!(["mug", "chair", "lamp"].map(fold_of), [2, 7, 1]);
        for (object, turn) in [("mug", 1), ("chair", 3), ("lamp", 0)] {
            assert!((0..5).all(|other| is_held_out(object, other) == (other == turn)));
        }
    }

    #[test]
    fn sizes_and_variants_of_an_object_share_a_fold() {
        assert_eq!(group_of("a/b.sh3f/mug#red@0.09"), "a/b.sh3f/mug");
        assert_eq!(group_of("made:mug/17~texture=3"), "made:mug/17");
    }
}

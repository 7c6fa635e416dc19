//! What is found wrong, at most so much of a kind.

use std::collections::BTreeMap;

use super::{MOST_OF_A_KIND, Verdict, Violation};

/// Collects a verdict. Of every kind the first ones are kept: a broken trajectory of a hundred
/// thousand points is wrong in as many places.
#[derive(Default)]
pub(super) struct Findings {
    pub verdict: Verdict,
    of_kind: BTreeMap<&'static str, usize>,
}

impl Findings {
    pub fn push(&mut self, violation: Violation) {
        let count = self.of_kind.entry(violation.code()).or_insert(0);
        *count += 1;
        if *count <= MOST_OF_A_KIND {
            self.verdict.violations.push(violation);
        }
    }
}

//! Questions put to an arm in parallel, within a bound on their work.

use rayon::prelude::*;

use crate::geometry::Pose;
use crate::motion::{Allowance, Probe, Reach};

/// Least work of one question before its answer is left open: a millisecond.
const QUESTION: u64 = 250_000;
/// The same in questions of the usual work.
const USUAL: u64 = 8;
/// Part of the allowance that questions asked at the same time may take beyond it.
const BEYOND: u64 = 4;
/// Questions asked at the same time.
const AT_A_TIME: (usize, usize) = (2, 1024);

/// Asks, and counts what is left. However the questions are spread over threads, the same ones are
/// answered: they go out in blocks, and the work of a block counts after it.
pub(super) struct Asks<'a> {
    reach: &'a Reach<'a>,
    pub(super) left: Allowance,
}

impl<'a> Asks<'a> {
    pub(super) fn new(reach: &'a Reach<'a>, allowance: Allowance) -> Self {
        Self { reach, left: allowance }
    }

    /// The answers in the order of `poses`; `None` from where the work ended, and where a single
    /// question took too much of it.
    pub(super) fn ask<T: Send>(
        &mut self,
        poses: &[Pose],
        question: impl Fn(&mut Probe, &Pose) -> T + Sync,
    ) -> Vec<Option<T>> {
        let most = QUESTION.max(USUAL * self.reach.usual_work());
        let at_a_time = ((self.left.most / BEYOND / most) as usize).clamp(AT_A_TIME.0, AT_A_TIME.1);
        let mut answers = Vec::with_capacity(poses.len());
        for block in poses.chunks(at_a_time) {
            if self.left.is_over() {
                answers.extend(block.iter().map(|_| None));
                continue;
            }
            let allowance = Allowance { most: most.min(self.left.most), stop: self.left.stop.clone() };
            let asked: Vec<(Option<T>, u64)> = block
                .par_iter()
                .map_init(
                    || self.reach.probe(&allowance),
                    |probe, pose| {
                        probe.begin(&allowance);
                        let answer = question(probe, pose);
                        ((!probe.is_over()).then_some(answer), probe.spent())
                    },
                )
                .collect();
            for (answer, spent) in asked {
                answers.push(answer);
                self.left = self.left.less(spent);
            }
        }
        answers
    }
}

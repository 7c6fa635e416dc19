//! From angles up to whole turns to joint states within limits.

use super::wraps::nearest_wrap;
use super::{InverseFailure, InverseSolutions, Joint, UnreachableReason};

/// Collects solutions whose angles hold up to whole turns: wraps each into the
/// limits near a seed, and keeps the one that breaks a limit least as the
/// reason in case none fits.
pub(super) struct Postures<'a> {
    joints: &'a [Joint],
    seed: Option<&'a [f64]>,
    within: Vec<Vec<f64>>,
    least_violation: Option<(f64, InverseFailure)>,
}

impl<'a> Postures<'a> {
    /// Nothing collected yet. Angles are wrapped towards `seed`, or towards the joints' middles.
    pub fn new(joints: &'a [Joint], seed: Option<&'a [f64]>) -> Self {
        Self { joints, seed, within: Vec::new(), least_violation: None }
    }

    /// The states within limits so far.
    pub fn within(&self) -> &[Vec<f64>] {
        &self.within
    }

    /// Whether nothing was added yet, within limits or not.
    pub fn is_empty(&self) -> bool {
        self.within.is_empty() && self.least_violation.is_none()
    }

    /// Adds a solution; whether it fits the limits.
    pub fn add(&mut self, angles_rad: &[f64]) -> bool {
        let wrapped: Option<Vec<f64>> = self
            .joints
            .iter()
            .zip(angles_rad)
            .enumerate()
            .map(|(i, (joint, &angle))| nearest_wrap(joint, angle, self.target(i, joint)))
            .collect();
        match wrapped {
            Some(state) => {
                self.within.push(state);
                true
            }
            None => {
                self.note_violation(angles_rad);
                false
            }
        }
    }

    /// The answer: the states within limits, else the joint limit broken least, else `miss`.
    pub fn finish(self, miss: impl FnOnce() -> InverseFailure) -> InverseSolutions {
        if !self.within.is_empty() {
            return InverseSolutions::found(self.within);
        }
        InverseSolutions::failed(self.least_violation.map_or_else(miss, |(_, failure)| failure))
    }

    fn target(&self, index: usize, joint: &Joint) -> f64 {
        let seeded = self.seed.and_then(|seed| seed.get(index)).copied().filter(|q| q.is_finite());
        seeded.unwrap_or_else(|| joint.middle_rad())
    }

    fn note_violation(&mut self, angles_rad: &[f64]) {
        let nearest: Vec<f64> =
            self.joints.iter().zip(angles_rad).map(|(j, &q)| nearest_turn(j, q)).collect();
        let Some((index, beyond)) = super::limit_violation(self.joints, &nearest) else { return };
        if self.least_violation.as_ref().is_some_and(|(least, _)| *least <= beyond) {
            return;
        }
        let (Some(joint), Some(&value_rad)) = (self.joints.get(index), nearest.get(index)) else { return };
        let bound_rad = if value_rad < joint.lower_rad { joint.lower_rad } else { joint.upper_rad };
        let reason = UnreachableReason::JointLimit { joint: joint.name.clone(), value_rad, bound_rad };
        // It reaches the pose: what it misses is the limit.
        let failure =
            InverseFailure { nearest, position_residual_m: 0.0, rotation_residual_rad: 0.0, reason };
        self.least_violation = Some((beyond, failure));
    }
}

/// The angle equal to `angle_rad` up to whole turns that lies least outside the limits.
fn nearest_turn(joint: &Joint, angle_rad: f64) -> f64 {
    let turn = std::f64::consts::TAU;
    let middle = joint.middle_rad();
    angle_rad + ((middle - angle_rad) / turn).round() * turn
}

/// Sorts joint states by their largest joint move from `previous`, ties by the sum of moves.
pub(super) fn sort_by_move(states: &mut [Vec<f64>], previous: &[f64]) {
    let moves = |state: &Vec<f64>| {
        let each = state.iter().zip(previous).map(|(a, b)| (a - b).abs());
        each.fold((0.0f64, 0.0f64), |(largest, sum), m| (largest.max(m), sum + m))
    };
    states.sort_by(|a, b| {
        let (a, b) = (moves(a), moves(b));
        a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1))
    });
}

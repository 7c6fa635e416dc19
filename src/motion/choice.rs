//! The choice of branch, whole turns and roll for all views together.
//!
//! Dynamic programming over the views in order. A label is a joint state at a
//! view with the cheapest way to it. From a label every candidate of the next
//! view is reached at the whole turns nearest to it within the limits. Since
//! the cost is a metric, a label that is no cheaper than going to it from
//! another label of the same view is of no use to any later view and is
//! dropped (this loses nothing); beyond that, the cheapest labels of each
//! candidate and of each view go on (see [`Breadth`]).

use std::f64::consts::{PI, TAU};

use super::candidates::{Candidate, turns};
use super::joints::Joints;
use super::metric::Metric;
use super::work::{Work, cost};

/// How many labels are followed.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Breadth {
    /// Labels of a view that go on to the next.
    of_view: usize,
    /// Labels of a candidate, which differ by whole turns.
    of_candidate: usize,
}

impl Breadth {
    /// Enough where no joint has to unwind.
    pub const USUAL: Breadth = Breadth { of_view: 160, of_candidate: 3 };
    /// Follows every combination of whole turns that a first view may have.
    pub const ALL_TURNS: Breadth = Breadth { of_view: 640, of_candidate: 64 };
}

/// Cheapest labels of a view against which the others are tested for use.
const JUDGES: usize = 8;
/// Cost of a radian away from the middle of a joint's range at the first view
/// of a motion without a start: decides between equals only.
const PREFER_MIDDLE: f64 = 1e-4;

/// A view in the order, with its candidates.
#[derive(Clone, Debug)]
pub(crate) struct Layer {
    pub view: usize,
    pub candidates: Vec<Candidate>,
    /// Moves into this view whose cost is not the metric's.
    pub priced: Vec<PricedMove>,
}

/// A move that was found to collide: what it costs instead, infinite if there is no way.
#[derive(Clone, Debug)]
pub(crate) struct PricedMove {
    pub from: Joints,
    pub to: Joints,
    pub cost: f64,
}

/// A joint state at a view and the cheapest way to it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Label {
    pub joints: Joints,
    pub candidate: usize,
    pub cost: f64,
    parent: usize,
}

/// The dynamic programme; layers may change from some index on and be chosen again.
pub(crate) struct Chooser {
    metric: Metric,
    lower: Joints,
    upper: Joints,
    start: Option<Joints>,
    breadth: Breadth,
    labels: Vec<Vec<Label>>,
}

impl Chooser {
    pub fn new(metric: Metric, limits: (Joints, Joints), start: Option<Joints>, breadth: Breadth) -> Self {
        Self { metric, lower: limits.0, upper: limits.1, start, breadth, labels: Vec::new() }
    }

    /// The cheapest chain of labels, one for each of the first `count` layers, if `layers`
    /// before `changed_from` are as at the last call. `Err(k)`: no state of layer `k` can be reached.
    pub fn choose(
        &mut self,
        layers: &[Layer],
        changed_from: usize,
        count: usize,
        work: &mut Work,
    ) -> Result<Vec<Label>, usize> {
        self.labels.truncate(changed_from.min(count));
        for index in self.labels.len()..count {
            let Some(layer) = layers.get(index) else { break };
            // Where moves onwards collide, a label may have the only free one: none is dropped.
            let may_drop = layers.get(index + 1).is_none_or(|l| l.priced.is_empty());
            let labels = match self.labels.last() {
                None => self.first_labels(layer),
                Some(previous) => {
                    work.spend(cost::LEG * (previous.len() * layer.candidates.len()) as u64);
                    self.next_labels(previous, layer)
                }
            };
            work.spend(cost::LEG * (labels.len() * JUDGES) as u64);
            let labels = self.keep_useful(labels, may_drop, layer.candidates.len());
            if labels.is_empty() {
                return Err(index);
            }
            self.labels.push(labels);
        }
        let mut chain = Vec::with_capacity(count);
        let mut at = 0;
        for labels in self.labels.iter().rev() {
            let Some(label) = labels.get(at) else { break };
            chain.push(*label);
            at = label.parent;
        }
        chain.reverse();
        Ok(chain)
    }

    fn first_labels(&self, layer: &Layer) -> Vec<Label> {
        let mut labels = Vec::new();
        for (candidate, state) in layer.candidates.iter().enumerate() {
            for joints in turns(&state.joints, &self.lower, &self.upper, 256) {
                let cost = match &self.start {
                    Some(start) => move_cost(&self.metric, layer, start, &joints),
                    None => self.distance_from_middle(&joints) * PREFER_MIDDLE,
                };
                labels.push(Label { joints, candidate, cost, parent: 0 });
            }
        }
        labels.retain(|label| label.cost.is_finite());
        labels
    }

    fn next_labels(&self, previous: &[Label], layer: &Layer) -> Vec<Label> {
        let mut labels: Vec<Label> = Vec::with_capacity(2 * layer.candidates.len());
        for (candidate, state) in layer.candidates.iter().enumerate() {
            // The labels of this candidate, one for each combination of turns met.
            let first = labels.len();
            let turns = self.turns_of(&state.joints);
            for (parent, before) in previous.iter().enumerate() {
                let joints = turns.nearest(&before.joints);
                let known = labels.iter().skip(first).position(|known| known.joints == joints);
                let known = known.and_then(|index| labels.get_mut(first + index));
                // No move costs less than nothing.
                if known.as_ref().is_some_and(|known| known.cost <= before.cost) {
                    continue;
                }
                let cost = before.cost + move_cost(&self.metric, layer, &before.joints, &joints);
                if !cost.is_finite() {
                    continue;
                }
                let label = Label { joints, candidate, cost, parent };
                match known {
                    Some(known) if known.cost <= cost => {}
                    Some(known) => *known = label,
                    None => labels.push(label),
                }
            }
        }
        labels
    }

    fn keep_useful(&self, mut labels: Vec<Label>, may_drop: bool, candidates: usize) -> Vec<Label> {
        labels.sort_by(|a, b| a.cost.total_cmp(&b.cost));
        let mut kept: Vec<Label> = Vec::with_capacity(self.breadth.of_view.min(labels.len()));
        let mut of_candidate = vec![0usize; candidates];
        for label in labels {
            let Some(count) = of_candidate.get_mut(label.candidate) else { continue };
            let useless = |judge: &Label| {
                let same = judge.candidate == label.candidate;
                (same || may_drop)
                    && judge.cost + self.metric.cost(&judge.joints, &label.joints) <= label.cost
            };
            if *count >= self.breadth.of_candidate || kept.iter().take(JUDGES).any(useless) {
                continue;
            }
            *count += 1;
            kept.push(label);
            if kept.len() >= self.breadth.of_view {
                break;
            }
        }
        kept
    }

    /// The whole turns of `joints` within the limits.
    fn turns_of(&self, joints: &Joints) -> Turns {
        let (lower, upper) = (self.lower, self.upper);
        Turns {
            joints: *joints,
            least: std::array::from_fn(|j| ((lower[j] - joints[j]) / TAU - 1e-9).ceil()),
            most: std::array::from_fn(|j| ((upper[j] - joints[j]) / TAU + 1e-9).floor()),
            lower,
            upper,
        }
    }

    fn distance_from_middle(&self, joints: &Joints) -> f64 {
        (0..joints.len()).map(|j| (joints[j] - 0.5 * (self.lower[j] + self.upper[j])).abs()).sum()
    }
}

/// A state and the whole turns that its joints may be moved by.
struct Turns {
    joints: Joints,
    least: Joints,
    most: Joints,
    lower: Joints,
    upper: Joints,
}

impl Turns {
    /// The state turned as near to `target` as the limits allow.
    #[inline(always)]
    fn nearest(&self, target: &Joints) -> Joints {
        std::array::from_fn(|j| {
            let q = self.joints[j];
            if (target[j] - q).abs() <= PI {
                return q;
            }
            // Adding and taking away this number rounds; `round` would be a call, millions a plan.
            let turns = ((target[j] - q) / TAU + ROUNDS) - ROUNDS;
            let turns = if turns > self.least[j] { turns } else { self.least[j] };
            let turns = if turns < self.most[j] { turns } else { self.most[j] };
            (q + turns * TAU).max(self.lower[j]).min(self.upper[j])
        })
    }
}

/// 1.5 * 2^52: a number of less than 2^51 added to it loses what is behind the point.
const ROUNDS: f64 = 6_755_399_441_055_744.0;

fn move_cost(metric: &Metric, layer: &Layer, from: &Joints, to: &Joints) -> f64 {
    if layer.priced.is_empty() {
        return metric.cost(from, to);
    }
    let known = layer.priced.iter().find(|priced| priced.from == *from && priced.to == *to);
    known.map_or_else(|| metric.cost(from, to), |priced| priced.cost)
}

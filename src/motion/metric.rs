//! What a joint move costs when states are chosen.

use super::joints::Joints;
use crate::robot::Joint;

/// Share of the joints' summed travel that is added to the slowest joint's:
/// among moves that take the same time, the one that moves least is better.
const TRAVEL_SHARE: f64 = 0.1;

/// Joint travel in seconds at full speed: the slowest joint's, plus a tenth of the sum.
///
/// A metric (symmetric, triangle inequality), which the choice of states relies on.
#[derive(Clone, Debug)]
pub(crate) struct Metric {
    seconds_per_rad: Joints,
}

impl Metric {
    pub fn new(joints: &[Joint]) -> Self {
        let mut seconds_per_rad = [0.0; 8];
        for (slot, joint) in seconds_per_rad.iter_mut().zip(joints) {
            *slot = 1.0 / joint.max_speed_rad_per_s;
        }
        Self { seconds_per_rad }
    }

    /// Cost of the straight move, seconds.
    pub fn cost(&self, from: &Joints, to: &Joints) -> f64 {
        let (mut slowest, mut sum) = (0.0f64, 0.0);
        for ((a, b), weight) in from.iter().zip(to).zip(&self.seconds_per_rad) {
            let time = (b - a).abs() * weight;
            slowest = if time > slowest { time } else { slowest };
            sum += time;
        }
        slowest + TRAVEL_SHARE * sum
    }

    /// Cost of a joint path, seconds.
    pub fn path_cost(&self, path: &[Joints]) -> f64 {
        path.windows(2).map(|pair| if let [a, b] = pair { self.cost(a, b) } else { 0.0 }).sum()
    }
}

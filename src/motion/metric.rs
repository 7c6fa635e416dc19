//! What a joint move costs when states are chosen.

use super::joints::{Joints, joints_from};
use super::request::Timing;
use super::s_curve;
use crate::robot::Joint;

/// What a move is judged by.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Measure {
    /// Joint travel at full speed: the slowest joint's time.
    Travel,
    /// Time from rest to rest within speed and acceleration limits.
    Time,
    /// The same within jerk limits too.
    TimeOfSCurve,
}

/// Share of the joints' summed travel that is added: among moves that take the
/// same time, the one that moves least is better.
const TRAVEL_SHARE: f64 = 0.1;
/// The same where time counts above all.
const TRAVEL_SHARE_OF_TIME: f64 = 0.01;

/// Cost of a joint move in seconds, and a little for every joint's travel.
///
/// Travel is a metric (symmetric, triangle inequality), which the choice of states relies on to
/// drop states that lead nowhere cheaper. Time is one (with S-curves too) but for moves limited by one joint's speed
/// and another's acceleration: there a cheaper chain may be missed, never a wrong one taken.
#[derive(Clone, Debug)]
pub(crate) struct Metric {
    measure: Measure,
    seconds_per_rad: Joints,
    /// Reciprocal accelerations, s2/rad.
    inverse_acceleration: Joints,
    /// Reciprocal jerks, s3/rad.
    inverse_jerk: Joints,
}

impl Metric {
    /// Least joint travel.
    pub fn travel(joints: &[Joint]) -> Self {
        Self::new(Measure::Travel, joints)
    }

    /// Least time, by the law that the motion will have.
    pub fn time(joints: &[Joint], jerk_limited: bool) -> Self {
        Self::new(if jerk_limited { Measure::TimeOfSCurve } else { Measure::Time }, joints)
    }

    fn new(measure: Measure, joints: &[Joint]) -> Self {
        let inverse = |limit: fn(&Joint) -> f64| {
            let limits: Vec<f64> = joints.iter().map(|joint| 1.0 / limit(joint)).collect();
            joints_from(&limits)
        };
        Self {
            measure,
            seconds_per_rad: inverse(|joint| joint.max_speed_rad_per_s),
            inverse_acceleration: inverse(|joint| joint.max_acceleration_rad_per_s2),
            inverse_jerk: inverse(Timing::jerk_limit_rad_per_s3),
        }
    }

    /// Cost of the straight move, seconds.
    #[inline]
    pub fn cost(&self, from: &Joints, to: &Joints) -> f64 {
        let (mut slowest, mut sum) = (0.0f64, 0.0);
        for ((a, b), weight) in from.iter().zip(to).zip(&self.seconds_per_rad) {
            let time = (b - a).abs() * weight;
            slowest = if time > slowest { time } else { slowest };
            sum += time;
        }
        match self.measure {
            Measure::Travel => slowest + TRAVEL_SHARE * sum,
            Measure::Time => {
                let hardest = largest(from, to, &self.inverse_acceleration);
                rest_to_rest_s(slowest, hardest) + TRAVEL_SHARE_OF_TIME * sum
            }
            // Nothing moves: no law is asked.
            Measure::TimeOfSCurve if slowest == 0.0 => 0.0,
            Measure::TimeOfSCurve => {
                let hardest = largest(from, to, &self.inverse_acceleration);
                let roughest = largest(from, to, &self.inverse_jerk);
                s_curve::rest_to_rest_s(slowest, hardest, roughest) + TRAVEL_SHARE_OF_TIME * sum
            }
        }
    }

    /// Cost of a joint path, seconds.
    pub fn path_cost(&self, path: &[Joints]) -> f64 {
        path.windows(2).map(|pair| if let [a, b] = pair { self.cost(a, b) } else { 0.0 }).sum()
    }
}

/// The largest move of a joint, each times its weight.
fn largest(from: &Joints, to: &Joints, weights: &Joints) -> f64 {
    let mut largest = 0.0f64;
    for ((a, b), weight) in from.iter().zip(to).zip(weights) {
        let move_of_joint = (b - a).abs() * weight;
        largest = if move_of_joint > largest { move_of_joint } else { largest };
    }
    largest
}

/// Seconds of the fastest progress from 0 to 1, at rest at both ends, with speed at most `1 / p`
/// and acceleration at most `1 / q`.
fn rest_to_rest_s(p: f64, q: f64) -> f64 {
    if q >= p * p { 2.0 * q.sqrt() } else { p + q / p }
}

//! Every state of every view in one table, and the time of a straight leg between two of them.

use std::f32::consts::{PI, TAU};
use std::ops::Range;

use crate::motion::candidates::Candidate;
use crate::motion::joints::{Joints, MAX_JOINTS};
use crate::motion::request::Timing;
use crate::motion::s_curve::rest_to_rest_s;
use crate::robot::Joint;

/// Share of the summed joint times that is added to a leg's time: of legs that
/// take equally long, the one that moves less is better.
const TRAVEL_SHARE: f32 = 0.01;

/// Joint angles in single precision: enough to compare times of legs.
pub(super) type State = [f32; MAX_JOINTS];

/// The states of all clusters (the start and the views), cluster after cluster.
pub(super) struct StateTable {
    states: Vec<State>,
    cluster_of: Vec<u32>,
    ranges: Vec<Range<usize>>,
    clock: LegClock,
}

/// Times of straight legs from rest to rest within speed and acceleration limits, and jerk limits
/// where the motion will have them.
///
/// Joints that can turn farther than all the way round are taken modulo a turn:
/// which whole turns are used is settled afterwards, by the choice of states. No
/// leg is faster than that says.
#[derive(Clone, Debug)]
pub(super) struct LegClock {
    /// A turn for joints taken modulo a turn, infinite for the others.
    period: State,
    seconds_per_rad: State,
    /// Reciprocal accelerations, s2/rad.
    inverse_acceleration: State,
    /// Reciprocal jerks, s3/rad; `None` where jerk is not bounded.
    inverse_jerk: Option<State>,
}

impl LegClock {
    pub fn new(joints: &[Joint], jerk_limited: bool) -> Self {
        let mut clock = Self {
            period: [f32::INFINITY; MAX_JOINTS],
            seconds_per_rad: [0.0; MAX_JOINTS],
            inverse_acceleration: [0.0; MAX_JOINTS],
            inverse_jerk: jerk_limited.then_some([0.0; MAX_JOINTS]),
        };
        for (j, joint) in joints.iter().take(MAX_JOINTS).enumerate() {
            if joint.upper_rad - joint.lower_rad > std::f64::consts::TAU + 1e-6 {
                clock.period[j] = TAU;
            }
            clock.seconds_per_rad[j] = (1.0 / joint.max_speed_rad_per_s) as f32;
            clock.inverse_acceleration[j] = (1.0 / joint.max_acceleration_rad_per_s2) as f32;
            if let Some(inverse) = &mut clock.inverse_jerk {
                inverse[j] = (1.0 / Timing::jerk_limit_rad_per_s3(joint)) as f32;
            }
        }
        clock
    }

    /// `joints` with those taken modulo a turn brought into one turn.
    fn state(&self, joints: &Joints) -> State {
        std::array::from_fn(|j| {
            let q = joints[j] as f32;
            if self.period[j].is_finite() { q - TAU * (q / TAU).round() } else { q }
        })
    }

    /// Seconds of the straight leg from `a` to `b`, and a little for every joint's travel.
    #[inline(always)]
    pub fn time(&self, a: &State, b: &State) -> f32 {
        let (speed_bound, acceleration_bound, sum) = self.bounds(a, b);
        self.leg_time(speed_bound, acceleration_bound, a, b) + TRAVEL_SHARE * sum
    }

    /// Seconds of the leg with these bounds.
    #[inline(always)]
    fn leg_time(&self, speed_bound: f32, acceleration_bound: f32, a: &State, b: &State) -> f32 {
        match &self.inverse_jerk {
            None => leg_time(speed_bound, acceleration_bound),
            Some(_) if speed_bound == 0.0 => 0.0,
            Some(inverse) => {
                let mut jerk_bound = 0.0f32;
                for (j, inverse) in inverse.iter().enumerate() {
                    let r = self.move_of(j, a, b) * inverse;
                    jerk_bound = if r > jerk_bound { r } else { jerk_bound };
                }
                let [p, q, r] = [speed_bound, acceleration_bound, jerk_bound].map(f64::from);
                rest_to_rest_s(p, q, r) as f32
            }
        }
    }

    /// By how much joint `j` moves, radians.
    #[inline(always)]
    fn move_of(&self, j: usize, a: &State, b: &State) -> f32 {
        let straight = (a[j] - b[j]).abs();
        let round = self.period[j] - straight;
        if round < straight { round } else { straight }
    }

    /// Largest joint travel over speed and over acceleration limits, and the sum of the former.
    #[inline(always)]
    fn bounds(&self, a: &State, b: &State) -> (f32, f32, f32) {
        let (mut speed_bound, mut acceleration_bound, mut sum) = (0.0f32, 0.0f32, 0.0f32);
        for j in 0..MAX_JOINTS {
            let d = self.move_of(j, a, b);
            let (p, q) = (d * self.seconds_per_rad[j], d * self.inverse_acceleration[j]);
            speed_bound = if p > speed_bound { p } else { speed_bound };
            acceleration_bound = if q > acceleration_bound { q } else { acceleration_bound };
            sum += p;
        }
        (speed_bound, acceleration_bound, sum)
    }
}

/// Duration of progress from 0 to 1 at speed at most `1 / p` and acceleration at most `1 / q`.
#[inline(always)]
fn leg_time(p: f32, q: f32) -> f32 {
    if q >= p * p { 2.0 * q.sqrt() } else { p + q / p }
}

impl StateTable {
    /// A table of the clusters' states.
    pub fn new<'a>(
        joints: &[Joint],
        jerk_limited: bool,
        clusters: impl Iterator<Item = &'a [Candidate]>,
    ) -> Self {
        let mut table = Self {
            states: Vec::new(),
            cluster_of: Vec::new(),
            ranges: Vec::new(),
            clock: LegClock::new(joints, jerk_limited),
        };
        for (cluster, candidates) in clusters.enumerate() {
            let first = table.states.len();
            table.states.extend(candidates.iter().map(|c| table.clock.state(&c.joints)));
            table.cluster_of.resize(table.states.len(), cluster as u32);
            table.ranges.push(first..table.states.len());
        }
        table
    }

    /// How many clusters there are.
    pub fn clusters(&self) -> usize {
        self.ranges.len()
    }

    /// The states of a cluster, as indices into the table.
    pub fn range(&self, cluster: usize) -> Range<usize> {
        self.ranges[cluster].clone()
    }

    /// The cluster of a state.
    pub fn cluster_of(&self, state: usize) -> usize {
        self.cluster_of[state] as usize
    }

    /// Seconds from state `a` to state `b`.
    #[inline(always)]
    pub fn time(&self, a: usize, b: usize) -> f32 {
        self.clock.time(&self.states[a], &self.states[b])
    }

    /// Seconds of the fastest leg between any two states of clusters `a` and `b`.
    pub fn fastest(&self, a: usize, b: usize) -> f32 {
        let mut fastest = f32::INFINITY;
        for from in &self.states[self.range(a)] {
            for to in &self.states[self.range(b)] {
                let (p, q, _) = self.clock.bounds(from, to);
                // A square root only where it may matter: bounded jerk makes no leg faster.
                if q < 0.25 * fastest * fastest || fastest.is_infinite() {
                    fastest = fastest.min(self.clock.leg_time(p, q, from, to));
                }
            }
        }
        fastest
    }

    /// Seconds from `state` to every state of `range`.
    pub fn times_into(&self, state: usize, range: Range<usize>, times: &mut Vec<f32>) {
        let from = &self.states[state];
        times.clear();
        times.extend(self.states[range].iter().map(|to| self.clock.time(from, to)));
    }

    /// Both ends of the straight leg from `a` to `b`, with joints taken modulo a turn unwrapped.
    pub fn leg(&self, a: usize, b: usize) -> (Joints, Joints) {
        let (from, to) = (&self.states[a], &self.states[b]);
        let unwrapped: State = std::array::from_fn(|j| {
            let d = to[j] - from[j];
            if self.clock.period[j].is_finite() && d.abs() > PI { to[j] - TAU * d.signum() } else { to[j] }
        });
        (from.map(f64::from), unwrapped.map(f64::from))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::motion::joints::{difference, joints_from};
    use crate::motion::metric::Metric;
    use crate::motion::s_curve::SCurve;
    use crate::motion::trapezoid::Trapezoid;
    use crate::robot::RobotModel;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn the_table_times_a_leg_as_the_time_law_does(
            a in proptest::array::uniform6(-3.0..3.0f64), step in proptest::array::uniform6(-3.0..3.0f64),
        ) {
            let joints = RobotModel::named("ur5e").unwrap().joints;
            let b: Vec<f64> = a.iter().zip(&step).map(|(a, d)| a + d).collect();
            let candidate = |q: &[f64]| [Candidate { joints: joints_from(q), roll_rad: 0.0 }];
            let (first, second) = (candidate(&a), candidate(&b));
            let clusters = || [first.as_slice(), second.as_slice()].into_iter();
            let table = StateTable::new(&joints, false, clusters());
            let speed = joints_from(&joints.iter().map(|j| j.max_speed_rad_per_s).collect::<Vec<_>>());
            let acceleration = joints_from(&joints.iter().map(|j| j.max_acceleration_rad_per_s2).collect::<Vec<_>>());
            let (from, to) = table.leg(0, 1);
            let step = difference(&from, &to);
            let sum: f64 = step.iter().zip(&joints).map(|(d, j)| d.abs() / j.max_speed_rad_per_s).sum();
            let exact = Trapezoid::new(&step, &speed, &acceleration).duration_s() + f64::from(TRAVEL_SHARE) * sum;
            prop_assert!((f64::from(table.time(0, 1)) - exact).abs() < 1e-3);
            prop_assert!((table.time(0, 1) - table.time(1, 0)).abs() < 1e-6);
            let jerk = joints_from(&joints.iter().map(Timing::jerk_limit_rad_per_s3).collect::<Vec<_>>());
            let smooth = StateTable::new(&joints, true, clusters());
            let exact = SCurve::new(&step, &speed, &acceleration, &jerk).duration_s() + f64::from(TRAVEL_SHARE) * sum;
            prop_assert!((f64::from(smooth.time(0, 1)) - exact).abs() < 1e-3);
            prop_assert!(smooth.fastest(0, 1) >= table.fastest(0, 1) * (1.0 - 1e-6));
            let metric = Metric::time(&joints, true).cost(&from, &to);
            prop_assert!((metric - exact).abs() < 1e-3);
        }
    }
}

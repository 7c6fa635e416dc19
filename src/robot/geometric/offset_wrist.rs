//! Six axes of which 4 and 5 meet and axis 6 passes beside them.
//!
//! With the last angle given, the meeting point and with it joints 1 to 3
//! follow in closed form; what is left to meet is the angle between axes 4
//! and 5. Its zeros over the last joint's turn are all the solutions (the
//! search over one angle of Elias and Wen 2022).

use std::f64::consts::TAU;

use nalgebra::UnitQuaternion;

use super::positioner::{Placement, Positioner};
use super::six::undone;
use super::subproblems::{angle_between, turned};
use crate::geometry::{Point, Pose, Vector};
use crate::robot::axis::Axis;

/// Samples of the last angle over its turn.
const SAMPLES: u32 = 72;

/// How often a piece of the turn is looked at again, and in how many pieces.
const DEPTH: u32 = 2;
const PIECES: u32 = 8;

/// Least room between two branches, and largest change of an angle, that a step may have.
const LEAST_ROOM: f64 = 0.12;
const LARGEST_CHANGE_RAD: f64 = 0.2;

/// Halvings on the way to a branch's end.
const EDGE_STEPS: u32 = 40;

/// Most refinements of a zero.
const MOST_STEPS: usize = 16;

/// A minimum of the miss below this (cosine) may be a zero that the samples step over.
const TOUCHING: f64 = 0.03;

/// Sine under which axes 4 and 5 count as parallel.
const LEAST_SINE: f64 = 0.1;

/// An arm with such a wrist.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct OffsetWrist {
    positioner: Positioner,
    first_three: [Axis; 3],
    fourth: Vector,
    fifth: Vector,
    /// A direction square to axis 5.
    beside_fifth: Vector,
    centre: Point,
    last: Axis,
    misfit: f64,
}

/// What one value of the last angle leads to.
struct Trial {
    last_rad: f64,
    motion_of_five: Pose,
    placements: [Placement; 4],
    /// Cosine between axes 4 and 5 less what it is on the arm, by placement.
    misses: [f64; 4],
}

impl OffsetWrist {
    /// The structure in six axes if they have it up to `tolerance` (metres and sines).
    pub fn of(axes: &[Axis; 6], tolerance: f64) -> Option<Self> {
        let [a1, a2, a3, a4, a5, a6] = *axes;
        if !(a4.sine(&a5) >= LEAST_SINE) {
            return None;
        }
        let (here, there) = a4.nearest(&a5)?;
        let gap_m = (here - there).norm();
        let centre = nalgebra::center(&here, &there);
        let first_three = [a1, a2, a3];
        let (positioner, slant) = Positioner::of(first_three, centre, tolerance)?;
        (gap_m <= tolerance).then(|| Self {
            positioner,
            first_three,
            fourth: a4.along,
            fifth: a5.along,
            beside_fifth: a5.along.cross(&a4.along).normalize(),
            centre,
            last: a6,
            misfit: gap_m.max(slant),
        })
    }

    /// How far the axes are from the structure, metres or sine.
    pub fn misfit(&self) -> f64 {
        self.misfit
    }

    /// Joint states that move everything behind the last joint by `motion`, not yet
    /// measured: those at zeros are exact to rounding, those where the miss only
    /// comes near to zero may lead to a solution or not. Free angles take `seed_rad`'s.
    pub fn candidates(&self, motion: &Pose, seed_rad: &[f64; 6]) -> Vec<[f64; 6]> {
        let step = TAU / f64::from(SAMPLES);
        let angle = |i: u32| seed_rad[5] + (f64::from(i) - 0.5 * f64::from(SAMPLES)) * step;
        // One sample over the turn's end, for minima there.
        let trials: Vec<Trial> =
            (0..SAMPLES + 2).map(|i| self.trial(motion, angle(i), seed_rad, None)).collect();
        let mut found = Vec::new();
        let search = Search { arm: self, motion, seed_rad };
        (0..4).for_each(|branch| search.scan(&trials, branch, DEPTH, &mut found));
        if found.is_empty() {
            // The state that comes nearest, for whoever asks why there is none.
            let each = trials.iter().flat_map(|trial| (0..4).map(move |branch| (trial, branch)));
            let cost = |(trial, branch): &(&Trial, usize)| {
                let held = trial.placements[*branch].held_by.is_some();
                trial.misses[*branch].abs() + if held { 10.0 } else { 0.0 }
            };
            let best = each.min_by(|a, b| cost(a).total_cmp(&cost(b)));
            found.extend(best.map(|(trial, branch)| self.state(trial, branch, seed_rad)));
        }
        found
    }

    /// The trial of one branch, or of all.
    fn trial(&self, motion: &Pose, last_rad: f64, seed_rad: &[f64; 6], only: Option<usize>) -> Trial {
        let motion_of_five = motion * self.last.turn(-last_rad);
        let seed = [seed_rad[0], seed_rad[1], seed_rad[2]];
        let placements = self.positioner.place_some(&(motion_of_five * self.centre), seed, only);
        let fifth = motion_of_five.rotation * self.fifth;
        let on_arm = self.fourth.dot(&self.fifth);
        let mut misses = [0.0; 4];
        for (branch, (miss, placement)) in misses.iter_mut().zip(&placements).enumerate() {
            if only.is_some_and(|only| only != branch) {
                continue;
            }
            let seen = self.first_three.iter().zip(placement.angles_rad);
            let seen = seen.fold(fifth, |seen, (axis, angle)| turned(&axis.along, -angle, &seen));
            *miss = self.fourth.dot(&seen) - on_arm;
        }
        Trial { last_rad, motion_of_five, placements, misses }
    }

    /// The joint state of a trial's branch.
    fn state(&self, trial: &Trial, branch: usize, seed_rad: &[f64; 6]) -> [f64; 6] {
        let angles = trial.placements[branch].angles_rad;
        let left: UnitQuaternion<f64> = undone(&self.first_three, angles, trial.motion_of_five.rotation);
        let q4 = angle_between(&self.fourth, &self.fifth, &(left * self.fifth), seed_rad[3]);
        let beside = turned(&self.fourth, -q4, &(left * self.beside_fifth));
        let q5 = angle_between(&self.fifth, &self.beside_fifth, &beside, seed_rad[4]);
        let [q1, q2, q3] = angles;
        [q1, q2, q3, q4, q5, trial.last_rad]
    }
}

/// Whether so much happens between two placements that zeros may lie between them.
fn changes_fast(from: &Placement, to: &Placement) -> bool {
    let moves =
        from.angles_rad.iter().zip(to.angles_rad).map(|(a, b)| (a - b - ((a - b) / TAU).round() * TAU).abs());
    from.room.min(to.room) < LEAST_ROOM || moves.fold(0.0, f64::max) > LARGEST_CHANGE_RAD
}

/// The search for a target's zeros.
struct Search<'a> {
    arm: &'a OffsetWrist,
    motion: &'a Pose,
    seed_rad: &'a [f64; 6],
}

impl Search<'_> {
    /// Adds the states at a branch's zeros between consecutive trials. Where two zeros may
    /// lie between two trials, or the branch ends there or has but a short piece within reach, it
    /// looks again in smaller steps, `depth` times.
    fn scan(&self, trials: &[Trial], branch: usize, depth: u32, found: &mut Vec<[f64; 6]>) {
        let held = |trial: &Trial| trial.placements[branch].held_by.is_some();
        for pair in trials.windows(2) {
            let [from, to] = pair else { continue };
            if held(from) && held(to) {
                continue;
            }
            if held(from) != held(to) && depth > 0 {
                // Up to where the branch ends: there its miss changes fastest.
                let (inside, outside) = if held(from) { (to, from) } else { (from, to) };
                let edge = self.edge(branch, inside, outside);
                self.scan(&self.between(branch, inside, &edge), branch, depth - 1, found);
            } else if depth > 0 && changes_fast(&from.placements[branch], &to.placements[branch]) {
                self.scan(&self.between(branch, from, to), branch, depth - 1, found);
            } else if (from.misses[branch] <= 0.0) != (to.misses[branch] <= 0.0) {
                found.push(self.arm.state(&self.zero(branch, from, to), branch, self.seed_rad));
            }
        }
        for triple in trials.windows(3) {
            let [before, here, after] = triple else { continue };
            if held(before) && held(here) && held(after) {
                if depth > 0
                    && let Some(inside) = self.inside(branch, before, here, after)
                {
                    let ends = [before, after].map(|outside| self.edge(branch, &inside, outside));
                    self.scan(&self.between(branch, &ends[0], &ends[1]), branch, depth - 1, found);
                }
                continue;
            }
            let [a, b, c] = [before, here, after].map(|trial| trial.misses[branch]);
            let least = b.abs() < TOUCHING && b.abs() <= a.abs() && b.abs() <= c.abs();
            if !(least && a * b > 0.0 && b * c > 0.0) {
                continue;
            }
            if depth > 0 {
                self.scan(&self.between(branch, before, after), branch, depth - 1, found);
            } else {
                found.push(self.arm.state(here, branch, self.seed_rad));
            }
        }
    }

    /// A trial within reach amid three beyond it, if the middle one breaks their bound least: the
    /// branch may be within reach for less than the distance of two trials. How far it is beyond is
    /// smooth in the last angle (for axes 1 and 2 that meet, a constant and one sine wave), so that
    /// the lowest point of the parabola through the three tells.
    fn inside(&self, branch: usize, before: &Trial, here: &Trial, after: &Trial) -> Option<Trial> {
        let [a, b, c] = [before, here, after].map(|trial| &trial.placements[branch]);
        if a.held_by != b.held_by || b.held_by != c.held_by || b.beyond > a.beyond || b.beyond > c.beyond {
            return None;
        }
        let steps = [here.last_rad - before.last_rad, after.last_rad - here.last_rad];
        let slopes = [(b.beyond - a.beyond) / steps[0], (c.beyond - b.beyond) / steps[1]];
        let bend = (slopes[1] - slopes[0]) / (steps[0] + steps[1]);
        let lowest = here.last_rad - 0.5 * (slopes[0] + bend * steps[0]) / bend;
        // Where all three are as far beyond there is no lowest point.
        if !lowest.is_finite() {
            return None;
        }
        let trial = self.trial(branch, lowest);
        trial.placements[branch].held_by.is_none().then_some(trial)
    }

    /// The last trial within reach on the way from one that is to one that is not.
    fn edge(&self, branch: usize, inside: &Trial, outside: &Trial) -> Trial {
        let (mut within, mut beyond) = (inside.last_rad, outside.last_rad);
        for _ in 0..EDGE_STEPS {
            let middle = 0.5 * (within + beyond);
            let trial = self.trial(branch, middle);
            let held = trial.placements[branch].held_by.is_some();
            if held { beyond = middle } else { within = middle }
        }
        self.trial(branch, within)
    }

    fn trial(&self, branch: usize, last_rad: f64) -> Trial {
        self.arm.trial(self.motion, last_rad, self.seed_rad, Some(branch))
    }

    /// Trials from one to another in smaller steps.
    fn between(&self, branch: usize, from: &Trial, to: &Trial) -> Vec<Trial> {
        let at = |i: u32| from.last_rad + (to.last_rad - from.last_rad) * f64::from(i) / f64::from(PIECES);
        (0..=PIECES).map(|i| self.trial(branch, at(i))).collect()
    }

    /// The zero of a branch's miss between two trials of different sign (Illinois method).
    fn zero(&self, branch: usize, from: &Trial, to: &Trial) -> Trial {
        let (mut a, mut b) = (from.last_rad, to.last_rad);
        let (mut miss_a, mut miss_b) = (from.misses[branch], to.misses[branch]);
        let mut best = self.trial(branch, b);
        for _ in 0..MOST_STEPS {
            let middle = b - miss_b * (b - a) / (miss_b - miss_a);
            best = self.trial(branch, middle);
            let miss = best.misses[branch];
            if miss.abs() < 1e-14 {
                break;
            }
            if (miss <= 0.0) == (miss_b <= 0.0) {
                miss_a *= 0.5;
            } else {
                (a, miss_a) = (b, miss_b);
            }
            (b, miss_b) = (middle, miss);
        }
        best
    }
}

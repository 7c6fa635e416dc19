//! Continuous collision check of a straight joint move.
//!
//! At the middle of an interval of the move each pair of bodies has a
//! clearance, and the levers bound how much of it the rest of the interval can
//! use up. A pair that cannot come too near is done with for the whole
//! interval; for the others the interval is halved. A free answer is therefore
//! a proof (up to [`RESOLUTION_M`]), not a matter of sample spacing.

use std::ops::Range;

use super::joints::{Joints, difference, lerp};
use super::scene::{Placement, Scene};
use super::work::Work;

/// By how much the margin may be undercut between two checked states, metres.
pub(crate) const RESOLUTION_M: f64 = 5e-4;
/// Halvings after which a move counts as colliding.
const MOST_HALVINGS: u32 = 14;
/// Open pairs of all intervals after which a move counts as colliding: bounds the buffer.
const MOST_OPEN: usize = 1_000_000;

/// Buffers of the checks, reused between them.
#[derive(Default)]
pub(crate) struct Sweeper {
    pub placement: Placement,
    open: Vec<Interval>,
    pairs: Vec<OpenPair>,
}

/// A pair that is not yet proven to keep its margin.
#[derive(Clone, Copy)]
struct OpenPair {
    index: u32,
    margin_m: f64,
    /// Relative motion over the whole move, at most.
    motion_m: f64,
    /// Relative motion by straying from it, at most.
    stray_m: f64,
}

#[derive(Clone, Copy)]
struct Interval {
    middle: f64,
    half: f64,
    halvings: u32,
    first_pair: usize,
    pair_count: usize,
}

impl Sweeper {
    /// To check moves under `work`.
    pub fn new(work: Work) -> Self {
        Self { placement: Placement::new(work), ..Self::default() }
    }

    /// What was done and what may be.
    pub fn work(&mut self) -> &mut Work {
        &mut self.placement.work
    }

    /// Whether every path whose joints stay within `deviation` of the straight
    /// move from `from` to `to` keeps every margin, less
    /// `relief_m` where the start state undercuts it, and no more than it does there.
    /// Where the work ends before that is proven, it counts as colliding.
    pub fn is_free(
        &mut self,
        scene: &Scene,
        from: &Joints,
        to: &Joints,
        deviation: &Joints,
        relief_m: f64,
    ) -> bool {
        let step = difference(from, to);
        let motion_m = |levers: &Joints, d: &Joints| -> f64 {
            let mut sum = 0.0;
            for (lever, d) in levers.iter().zip(d) {
                sum += lever * d.abs();
            }
            sum
        };
        let strays = deviation.iter().any(|d| *d != 0.0);
        let stray_m = |levers: &Joints| if strays { motion_m(levers, deviation) } else { 0.0 };
        self.open.clear();
        self.pairs.clear();
        scene.place(&lerp(from, to, 0.5), &mut self.placement);
        let add = |open: &mut Vec<OpenPair>, range: Range<usize>| {
            let pairs = scene.pairs().get(range.clone()).unwrap_or_default();
            open.extend(range.zip(pairs).map(|(index, pair)| OpenPair {
                index: index as u32,
                margin_m: pair.margin_m - relief_m.min(pair.relief_m),
                motion_m: motion_m(&pair.levers_m, &step),
                stray_m: stray_m(&pair.levers_m),
            }));
        };
        add(&mut self.pairs, 0..scene.single_pairs());
        for group in scene.groups() {
            let travel_m = 0.5 * motion_m(&group.levers_m, &step) + stray_m(&group.levers_m);
            if scene.group_clearance(group, &mut self.placement) < group.margin_m + travel_m {
                add(&mut self.pairs, group.pairs.clone());
            }
        }
        self.open.push(Interval {
            middle: 0.5,
            half: 0.5,
            halvings: 0,
            first_pair: 0,
            pair_count: self.pairs.len(),
        });
        // Breadth first: the middle of a move is where it collides, if it does.
        let mut next = 0;
        while let Some(&interval) = self.open.get(next) {
            if self.placement.work.is_over() || self.pairs.len() > MOST_OPEN {
                return false;
            }
            // The first one is placed.
            if next > 0 {
                scene.place(&lerp(from, to, interval.middle), &mut self.placement);
            }
            next += 1;
            let first_pair = self.pairs.len();
            for i in interval.first_pair..interval.first_pair + interval.pair_count {
                let Some(&pair) = self.pairs.get(i) else { continue };
                let travel_m = interval.half * pair.motion_m + pair.stray_m;
                let enough_m = pair.margin_m + (travel_m - RESOLUTION_M).max(0.0);
                let clearance_m = scene.clearance(pair.index as usize, &mut self.placement, enough_m);
                if clearance_m < pair.margin_m {
                    return false;
                }
                if clearance_m < enough_m {
                    self.pairs.push(pair);
                }
            }
            let pair_count = self.pairs.len() - first_pair;
            if pair_count == 0 {
                continue;
            }
            if interval.halvings >= MOST_HALVINGS {
                return false;
            }
            let half = 0.5 * interval.half;
            for middle in [interval.middle - half, interval.middle + half] {
                self.open.push(Interval {
                    middle,
                    half,
                    halvings: interval.halvings + 1,
                    first_pair,
                    pair_count,
                });
            }
        }
        true
    }
}

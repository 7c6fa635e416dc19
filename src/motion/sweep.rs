//! Continuous collision check of a straight joint move.
//!
//! At the middle of an interval of the move each pair of bodies has a
//! clearance, and the levers bound how much of it the rest of the interval can
//! use up. A pair that cannot come too near is done with for the whole
//! interval; for the others the interval is halved. A free answer is therefore
//! a proof (up to [`RESOLUTION_M`]), not a matter of sample spacing.

use super::joints::{Joints, difference, lerp};
use super::scene::{Placement, Scene};

/// By how much the margin may be undercut between two checked states, metres.
pub(crate) const RESOLUTION_M: f64 = 5e-4;
/// Halvings after which a move counts as colliding.
const MOST_HALVINGS: u32 = 14;

/// Buffers of the checks, reused between them.
#[derive(Default)]
pub(crate) struct Sweeper {
    pub placement: Placement,
    open: Vec<Interval>,
    pairs: Vec<u32>,
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
    /// Whether every path whose joints stay within `deviation` of the straight
    /// move from `from` to `to` keeps every margin, less
    /// `relief_m` where the start state undercuts it, and no more than it does there.
    pub fn is_free(
        &mut self,
        scene: &Scene,
        from: &Joints,
        to: &Joints,
        deviation: &Joints,
        relief_m: f64,
    ) -> bool {
        let step = difference(from, to);
        let pair_motion =
            |levers: &Joints, d: &Joints| -> f64 { levers.iter().zip(d).map(|(l, d)| l * d.abs()).sum() };
        self.open.clear();
        self.pairs.clear();
        self.pairs.extend(0..scene.pairs().len() as u32);
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
            next += 1;
            scene.place(&lerp(from, to, interval.middle), &mut self.placement);
            let first_pair = self.pairs.len();
            for i in interval.first_pair..interval.first_pair + interval.pair_count {
                let Some((index, pair)) =
                    self.pairs.get(i).and_then(|&p| Some((p, scene.pairs().get(p as usize)?)))
                else {
                    continue;
                };
                let margin = pair.margin_m - relief_m.min(pair.relief_m);
                let travel = interval.half * pair_motion(&pair.levers_m, &step)
                    + pair_motion(&pair.levers_m, deviation);
                let enough = margin + (travel - RESOLUTION_M).max(0.0);
                let clearance = scene.clearance(index as usize, &self.placement, enough);
                if clearance < margin {
                    return false;
                }
                if clearance < enough {
                    self.pairs.push(index);
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

//! Whether a motion passes without coming too near to anything, every distance from parry.

use super::findings::Findings;
use super::pairs::{Second, Solids, link_poses};
use super::solids::{distance, distance_at_least};
use super::{Nearest, Violation};
use crate::motion::cell::Cell;
use crate::motion::plan::TrajectoryPoint;
use crate::motion::work::Stop;

/// By how much a margin may be undercut, metres: the planner's resolution and GJK's.
pub const UNDERCUT_BOUND_M: f64 = 1e-3;
/// Beyond this, metres, distances are only told to be so large.
const FAR_M: f64 = 0.5;
/// Halvings of the time between two points before the rest counts as not proven.
const MOST_HALVINGS: u32 = 16;
/// Travel after which it is counted from 0 again, metres.
const REBASE_M: f64 = 1e3;
/// Most work of a check, some five seconds of one core, and what its steps take of it: bounding
/// the motion of a group, looking at two balls, placing the links, a distance that is positive and
/// one that is not.
const MOST_WORK: u64 = 1_000_000_000;
const GROUP: u64 = 2;
const BALLS: u64 = 4;
const PLACES: u64 = 100;
const DISTANCE: u64 = 300;
const DEPTH: u64 = 3_000;

/// The solids of a cell, to judge motions among them.
pub(super) struct Passage<'a> {
    cell: &'a Cell,
    solids: Solids,
}

/// A stretch of time between two points: its middle and half its length, as shares of it.
struct Stretch {
    middle: f64,
    half: f64,
    halvings: u32,
    pairs: Vec<usize>,
}

/// What is known so far.
struct Judging {
    /// Margins, or less while the start state excuses it.
    wanted_m: Vec<f64>,
    reported: Vec<bool>,
    /// How far each group's bodies may have moved against each other since the start, metres.
    travelled_m: Vec<f64>,
    /// Until it has travelled so far a pair need not be looked at: from its last distance.
    clear_until_m: Vec<f64>,
    /// The least of these in each group.
    due_m: Vec<f64>,
    work_left: u64,
}

impl Judging {
    /// Counts a group's travel from 0 again, before it is too large a number to be added to.
    fn rebase(&mut self, group: usize, pairs: &[usize]) {
        let travelled_m = std::mem::take(&mut self.travelled_m[group]);
        self.due_m[group] -= travelled_m;
        for pair in pairs {
            self.clear_until_m[*pair] -= travelled_m;
        }
    }

    fn spend(&mut self, work: u64) {
        self.work_left = self.work_left.saturating_sub(work);
    }
}

impl<'a> Passage<'a> {
    pub fn new(cell: &'a Cell) -> Self {
        Self { cell, solids: Solids::new(cell) }
    }

    /// Looks at the whole motion and reports each pair at the first moment it is too near.
    pub fn judge(&self, trajectory: &[TrajectoryPoint], stop: Option<&Stop>, findings: &mut Findings) {
        let Some(first) = trajectory.first() else { return };
        let Solids { pairs, groups, .. } = &self.solids;
        let poses = link_poses(self.cell, &first.positions_rad);
        let start_m = |pair| self.solids.of(pair).map_or(0.0, |(a, b)| distance(a, b, &poses));
        let margins = || pairs.iter().map(|pair| pair.margin_m);
        // A start that overlaps is no excuse.
        let excused = || pairs.iter().map(|pair| pair.margin_m.min(start_m(pair)).max(0.0)).collect();
        let mut judging = Judging {
            wanted_m: if first.view.is_none() { excused() } else { margins().collect() },
            reported: vec![false; pairs.len()],
            travelled_m: vec![0.0; groups.len()],
            clear_until_m: vec![f64::NEG_INFINITY; pairs.len()],
            due_m: vec![f64::NEG_INFINITY; groups.len()],
            work_left: MOST_WORK,
        };
        self.judge_between(first, first, &mut judging, findings);
        for pair in trajectory.windows(2) {
            let [from, to] = pair else { continue };
            self.judge_between(from, to, &mut judging, findings);
            if judging.work_left == 0 || stop.is_some_and(Stop::is_asked) {
                findings.push(Violation::NotProven { time_s: from.time_from_start_s });
                return;
            }
            if to.view.is_some() {
                judging.wanted_m = margins().collect();
            }
        }
    }

    fn judge_between(
        &self,
        from: &TrajectoryPoint,
        to: &TrajectoryPoint,
        judging: &mut Judging,
        findings: &mut Findings,
    ) {
        let reach_rad = largest_moves(from, to);
        let groups = &self.solids.groups;
        judging.spend(GROUP * groups.len() as u64);
        // What each group moves on the way, and the pairs that may come too near on it.
        let moved_m: Vec<f64> = groups
            .iter()
            .map(|group| group.levers_m.iter().zip(&reach_rad).map(|(lever, reach)| lever * reach).sum())
            .collect();
        if !moved_m.iter().all(|moved| moved.is_finite()) {
            judging.work_left = 0;
            return;
        }
        let mut due: Vec<usize> = Vec::new();
        let mut due_groups: Vec<usize> = Vec::new();
        for (index, group) in groups.iter().enumerate() {
            let end_m = judging.travelled_m[index] + moved_m[index];
            if judging.due_m[index] < end_m {
                due_groups.push(index);
                due.extend(group.pairs.iter().filter(|pair| judging.clear_until_m[**pair] < end_m));
                judging.spend(group.pairs.len() as u64);
            }
        }
        if !due.is_empty() {
            self.look(from, to, due, &moved_m, judging, findings);
        }
        for group in due_groups {
            let until = groups[group].pairs.iter().map(|pair| judging.clear_until_m[*pair]);
            judging.due_m[group] = until.fold(f64::INFINITY, f64::min);
        }
        for (index, moved) in moved_m.iter().enumerate() {
            judging.travelled_m[index] += moved;
            if judging.travelled_m[index] > REBASE_M {
                judging.rebase(index, &groups[index].pairs);
            }
        }
    }

    /// Looks at `pairs` between two points: at the middle first, then at halves where it must.
    fn look(
        &self,
        from: &TrajectoryPoint,
        to: &TrajectoryPoint,
        pairs: Vec<usize>,
        moved_m: &[f64],
        judging: &mut Judging,
        findings: &mut Findings,
    ) {
        let dt = to.time_from_start_s - from.time_from_start_s;
        let mut open = vec![Stretch { middle: 0.5, half: 0.5, halvings: 0, pairs }];
        while let Some(stretch) = open.pop() {
            if judging.work_left == 0 {
                return;
            }
            judging.spend(PLACES + BALLS * stretch.pairs.len() as u64);
            findings.verdict.looked.states += 1;
            let time_s = from.time_from_start_s + stretch.middle * dt;
            let poses = link_poses(self.cell, &between(from, to, stretch.middle));
            let mut undecided = Vec::new();
            for index in stretch.pairs {
                let Some(pair) = self.solids.pairs.get(index) else { continue };
                let Some((a, b)) = self.solids.of(pair) else { continue };
                let least_m = judging.wanted_m[index] - UNDERCUT_BOUND_M;
                let enough_m = least_m + moved_m[pair.group] * stretch.half;
                let looked = match pair.second {
                    Second::Moving(_) => &mut findings.verdict.looked.nearest_self,
                    Second::Fixed(_) => &mut findings.verdict.looked.nearest,
                };
                let nearest_m = looked.as_ref().map_or(f64::INFINITY, |n| n.distance_m);
                let at_m = judging.travelled_m[pair.group] + moved_m[pair.group] * stretch.middle;
                // Nearer than this the pair is of interest: it is near its margin (the full one, also
                // where the start excuses it) or nearer than anything seen.
                let interest_m = |nearest_m: f64| nearest_m.min(FAR_M).max(pair.margin_m);
                let at_least_m = distance_at_least(a, b, &poses);
                let clear_until_m = &mut judging.clear_until_m[index];
                if at_least_m > enough_m.max(nearest_m.min(FAR_M)) {
                    *clear_until_m = clear_until_m.max(at_m + at_least_m - interest_m(nearest_m));
                    continue;
                }
                let distance_m = distance(a, b, &poses);
                judging.work_left =
                    judging.work_left.saturating_sub(if distance_m > 0.0 { DISTANCE } else { DEPTH });
                if distance_m < nearest_m {
                    let (first, second) = (a.name.clone(), b.name.clone());
                    *looked = Some(Nearest { distance_m, first, second, time_s });
                }
                *clear_until_m = clear_until_m.max(at_m + distance_m - interest_m(nearest_m.min(distance_m)));
                if distance_m < least_m {
                    if !std::mem::replace(&mut judging.reported[index], true) {
                        findings.push(Violation::TooNear {
                            time_s,
                            first: a.name.clone(),
                            second: b.name.clone(),
                            distance_m,
                            margin_m: pair.margin_m,
                        });
                    }
                } else if distance_m < enough_m {
                    undecided.push(index);
                }
            }
            if undecided.is_empty() {
                continue;
            }
            if stretch.halvings >= MOST_HALVINGS {
                judging.work_left = 0;
                return;
            }
            let (half, halvings) = (0.5 * stretch.half, stretch.halvings + 1);
            open.push(Stretch { middle: stretch.middle + half, half, halvings, pairs: undecided.clone() });
            open.push(Stretch { middle: stretch.middle - half, half, halvings, pairs: undecided });
        }
    }
}

/// Cubic Hermite interpolation, as a controller would do it.
fn between(from: &TrajectoryPoint, to: &TrajectoryPoint, share: f64) -> Vec<f64> {
    let dt = to.time_from_start_s - from.time_from_start_s;
    let (s, r) = (share, 1.0 - share);
    (0..from.positions_rad.len())
        .map(|j| {
            let (p0, p1) = (from.positions_rad[j], to.positions_rad[j]);
            let (m0, m1) = (from.velocities_rad_per_s[j] * dt, to.velocities_rad_per_s[j] * dt);
            (1.0 + 2.0 * s) * r * r * p0 + s * r * r * m0 + s * s * (3.0 - 2.0 * s) * p1 - s * s * r * m1
        })
        .collect()
}

/// How far each joint moves on [`between`] for a unit of `share` at most, radians: the largest
/// Bezier coefficient of the derivative.
fn largest_moves(from: &TrajectoryPoint, to: &TrajectoryPoint) -> Vec<f64> {
    let dt = to.time_from_start_s - from.time_from_start_s;
    (0..from.positions_rad.len())
        .map(|j| {
            let (m0, m1) = (from.velocities_rad_per_s[j] * dt, to.velocities_rad_per_s[j] * dt);
            let moved = to.positions_rad[j] - from.positions_rad[j];
            m0.abs().max(m1.abs()).max((3.0 * moved - m0 - m1).abs())
        })
        .collect()
}

/// By how much the nearest pair undercuts its margin at the points and `between_points` states between
/// two of them, metres; negative where none does.
#[cfg(test)]
pub(in crate::motion) fn sampled_excess_m(
    cell: &Cell,
    trajectory: &[TrajectoryPoint],
    between_points: usize,
) -> f64 {
    let solids = Solids::new(cell);
    let mut excess_m = f64::NEG_INFINITY;
    for points in trajectory.windows(2) {
        for i in 0..=between_points {
            let share = i as f64 / between_points as f64;
            let poses = link_poses(cell, &between(&points[0], &points[1], share));
            for pair in &solids.pairs {
                let (a, b) = solids.of(pair).unwrap();
                if distance_at_least(a, b, &poses) < pair.margin_m {
                    excess_m = excess_m.max(pair.margin_m - distance(a, b, &poses));
                }
            }
        }
    }
    excess_m
}

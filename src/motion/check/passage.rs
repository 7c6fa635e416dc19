//! Whether a motion passes without coming too near to anything, every distance from parry.

use parry3d_f64::math::{Pose3, Vec3};
use parry3d_f64::shape::{HalfSpace, SharedShape};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::levers::Lengths;
use super::solids::{Solid, distance, distance_at_least, object_solid, pose3, solid};
use super::{Nearest, Verdict, Violation};
use crate::geometry::Pose;
use crate::motion::cell::Cell;
use crate::motion::plan::TrajectoryPoint;

/// By how much a margin may be undercut, metres: the planner's resolution and GJK's.
pub const UNDERCUT_BOUND_M: f64 = 1e-3;
/// Random states that tell which parts of the arm always touch: apart in at most so many of them.
const TOUCH_SAMPLES: (usize, usize) = (300, 9);
/// First link that has to keep away from the table, from the object, from keep-out regions: the
/// base stands on the table and may stand in a region, the link on it only turns there.
const FROM_LINK: (usize, usize, usize) = (2, 0, 1);
/// Beyond this, metres, distances are only told to be so large.
const FAR_M: f64 = 0.5;
/// Halvings of the time between two points before the rest counts as not proven.
const MOST_HALVINGS: u32 = 16;
/// States looked at for a point of the trajectory, and for all of it besides, at most.
const MOST_STATES: (usize, usize) = (60, 100_000);

/// Two solids that must stay apart.
struct Pair {
    /// Index into `moving`.
    first: usize,
    second: Second,
    margin_m: f64,
    /// Metres of relative motion for a radian of each joint, at most.
    levers_m: Vec<f64>,
}

#[derive(Clone, Copy)]
enum Second {
    Moving(usize),
    Fixed(usize),
}

/// The solids of a cell and the pairs that must stay apart.
pub(super) struct Passage<'a> {
    cell: &'a Cell,
    moving: Vec<Solid>,
    /// Each with the first link that has to keep away from it.
    fixed: Vec<(Solid, usize)>,
    pairs: Vec<Pair>,
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
    states_left: usize,
}

impl<'a> Passage<'a> {
    pub fn new(cell: &'a Cell) -> Self {
        let kinematics = cell.robot.kinematics.as_ref();
        let dof = kinematics.dof();
        let mut moving = Vec::new();
        for (link, parts) in cell.robot.links.iter().enumerate() {
            moving.extend(parts.shapes.iter().map(|s| solid(&parts.name, link, &Pose::identity(), s)));
        }
        let zero = vec![0.0; dof];
        let base_from_last = kinematics.link_poses(&zero).last().copied().unwrap_or_default();
        let last_from_flange = base_from_last.inverse() * kinematics.forward(&zero);
        let last_from_camera = last_from_flange * cell.flange_from_camera;
        moving.extend(cell.camera_body.iter().map(|s| solid(CAMERA, dof, &last_from_camera, s)));
        moving.extend(cell.tool.iter().map(|s| solid(TOOL, dof, &last_from_flange, s)));
        let identity = Pose::identity();
        let regions = cell.keep_out.iter();
        let mut fixed: Vec<(Solid, usize)> =
            regions.map(|k| (solid(&k.name, 0, &identity, &k.shape_in_base), FROM_LINK.2)).collect();
        fixed.extend(cell.object.iter().map(|object| (object_solid(object), FROM_LINK.1)));
        if let Some(z) = cell.table_z_m {
            let below = SharedShape::new(HalfSpace::new(Vec3::new(0.0, 0.0, 1.0)));
            fixed.push((Solid::new("table", 0, Pose3::translation(0.0, 0.0, z), below), FROM_LINK.0));
        }
        let mut passage = Self { cell, moving, fixed, pairs: Vec::new() };
        passage.pairs = passage.pairs(&Lengths::new(kinematics));
        passage
    }

    fn pairs(&self, lengths: &Lengths) -> Vec<Pair> {
        let levers = |solid: &Solid, still: usize| {
            let (center, radius) = solid.ball_in_link();
            lengths.levers(solid.link, still, center, radius)
        };
        let mut pairs = Vec::new();
        for (first, second) in self.pairs_that_can_part() {
            let (Some(a), Some(b)) = (self.moving.get(first), self.moving.get(second)) else { continue };
            let levers_m = levers(b, a.link);
            let margin_m = self.cell.self_margin_m;
            pairs.push(Pair { first, second: Second::Moving(second), margin_m, levers_m });
        }
        for (first, a) in self.moving.iter().enumerate() {
            let near = self.fixed.iter().enumerate().filter(|(_, (_, from_link))| a.link >= *from_link);
            pairs.extend(near.map(|(i, _)| Pair {
                first,
                second: Second::Fixed(i),
                margin_m: self.cell.margin_m,
                levers_m: levers(a, 0),
            }));
        }
        pairs
    }

    /// Pairs of parts of the arm, the one on the lower link first.
    fn pairs_that_can_part(&self) -> Vec<(usize, usize)> {
        let mut candidates = Vec::new();
        for (i, a) in self.moving.iter().enumerate() {
            for (k, b) in self.moving.iter().enumerate().skip(i + 1) {
                let gap = b.link.abs_diff(a.link);
                if gap >= 2 || (gap == 1 && (b.name == CAMERA || b.name == TOOL)) {
                    candidates.push((i, k));
                }
            }
        }
        let mut rng = ChaCha8Rng::seed_from_u64(77);
        let (samples, seldom) = TOUCH_SAMPLES;
        let mut parted = vec![0; candidates.len()];
        for _ in 0..samples {
            let joints = self.cell.robot.joints.iter();
            let q: Vec<f64> =
                joints.map(|j| j.lower_rad + rng.random::<f64>() * (j.upper_rad - j.lower_rad)).collect();
            let poses = self.link_poses(&q);
            for (seen, (i, k)) in parted.iter_mut().zip(&candidates) {
                if let (true, Some(a), Some(b)) = (*seen <= seldom, self.moving.get(*i), self.moving.get(*k))
                {
                    let apart = distance_at_least(a, b, &poses) > 0.0 || distance(a, b, &poses) > 0.0;
                    *seen += usize::from(apart);
                }
            }
        }
        candidates.into_iter().zip(parted).filter(|(_, p)| *p > seldom).map(|(pair, _)| pair).collect()
    }

    fn link_poses(&self, q: &[f64]) -> Vec<Pose3> {
        self.cell.robot.kinematics.link_poses(q).iter().map(pose3).collect()
    }

    fn solids(&self, pair: &Pair) -> Option<(&Solid, &Solid)> {
        let second = match pair.second {
            Second::Moving(i) => self.moving.get(i)?,
            Second::Fixed(i) => &self.fixed.get(i)?.0,
        };
        Some((self.moving.get(pair.first)?, second))
    }

    /// Looks at the whole motion and reports each pair at the first moment it is too near.
    pub fn judge(&self, trajectory: &[TrajectoryPoint], verdict: &mut Verdict) {
        let Some(first) = trajectory.first() else { return };
        let poses = self.link_poses(&first.positions_rad);
        let start_m: Vec<f64> =
            self.pairs.iter().map(|p| self.solids(p).map_or(0.0, |(a, b)| distance(a, b, &poses))).collect();
        let margins = || self.pairs.iter().map(|p| p.margin_m);
        let excused: Vec<f64> = margins().zip(&start_m).map(|(margin, start)| margin.min(*start)).collect();
        let mut judging = Judging {
            wanted_m: if first.view.is_none() { excused } else { margins().collect() },
            reported: vec![false; self.pairs.len()],
            states_left: MOST_STATES.0.saturating_mul(trajectory.len()) + MOST_STATES.1,
        };
        // A start that overlaps is no excuse.
        judging.wanted_m.iter_mut().for_each(|m| *m = m.max(0.0));
        self.judge_between(first, first, &mut judging, verdict);
        for pair in trajectory.windows(2) {
            let [from, to] = pair else { continue };
            self.judge_between(from, to, &mut judging, verdict);
            if judging.states_left == 0 {
                verdict.violations.push(Violation::NotProven { time_s: from.time_from_start_s });
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
        verdict: &mut Verdict,
    ) {
        let dt = to.time_from_start_s - from.time_from_start_s;
        let reach_rad = largest_moves(from, to);
        let mut open =
            vec![Stretch { middle: 0.5, half: 0.5, halvings: 0, pairs: (0..self.pairs.len()).collect() }];
        while let Some(stretch) = open.pop() {
            if judging.states_left == 0 {
                return;
            }
            judging.states_left -= 1;
            verdict.looked.states += 1;
            let time_s = from.time_from_start_s + stretch.middle * dt;
            let poses = self.link_poses(&between(from, to, stretch.middle));
            let mut undecided = Vec::new();
            for index in stretch.pairs {
                let Some(pair) = self.pairs.get(index) else { continue };
                let Some((a, b)) = self.solids(pair) else { continue };
                let travel_m: f64 =
                    pair.levers_m.iter().zip(&reach_rad).map(|(l, r)| l * r * stretch.half).sum();
                let least_m =
                    judging.wanted_m.get(index).copied().unwrap_or(pair.margin_m) - UNDERCUT_BOUND_M;
                let enough_m = least_m + travel_m;
                let looked = match pair.second {
                    Second::Moving(_) => &mut verdict.looked.nearest_self,
                    Second::Fixed(_) => &mut verdict.looked.nearest,
                };
                let nearest_m = looked.as_ref().map_or(f64::INFINITY, |n| n.distance_m);
                let at_least_m = distance_at_least(a, b, &poses);
                if at_least_m > enough_m.max(nearest_m.min(FAR_M)) {
                    continue;
                }
                let distance_m = distance(a, b, &poses);
                if distance_m < nearest_m {
                    let (first, second) = (a.name.clone(), b.name.clone());
                    *looked = Some(Nearest { distance_m, first, second, time_s });
                }
                if distance_m < least_m {
                    if judging.reported.get_mut(index).is_some_and(|seen| !std::mem::replace(seen, true)) {
                        verdict.violations.push(Violation::TooNear {
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
                judging.states_left = 0;
                return;
            }
            let (half, halvings) = (0.5 * stretch.half, stretch.halvings + 1);
            open.push(Stretch { middle: stretch.middle + half, half, halvings, pairs: undecided.clone() });
            open.push(Stretch { middle: stretch.middle - half, half, halvings, pairs: undecided });
        }
    }
}

/// Names of what is mounted on the last link.
const CAMERA: &str = "camera";
const TOOL: &str = "tool";

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

//! The solids of a cell and which of them must stay apart.

use std::collections::BTreeMap;

use parry3d_f64::math::{Pose3, Vec3};
use parry3d_f64::shape::{HalfSpace, SharedShape};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::levers::Lengths;
use super::solids::{Solid, are_apart, object_solid, pose3, solid};
use crate::geometry::Pose;
use crate::motion::cell::Cell;

/// Random states that tell which parts of the arm always touch: apart in at most so many of them.
const TOUCH_SAMPLES: (usize, usize) = (300, 9);
/// First link that has to keep away from the table, from the object, from keep-out regions: the
/// base stands on the table and may stand in a region, the link on it only turns there.
const FROM_LINK: (usize, usize, usize) = (2, 0, 1);
/// Names of what is mounted on the last link.
const CAMERA: &str = "camera";
const TOOL: &str = "tool";

/// Two solids that must stay apart.
pub(super) struct Pair {
    /// Index into `moving`.
    pub first: usize,
    pub second: Second,
    pub margin_m: f64,
    /// Index of its group.
    pub group: usize,
}

#[derive(Clone, Copy)]
pub(super) enum Second {
    Moving(usize),
    Fixed(usize),
}

/// Pairs whose relative motion is bounded alike.
pub(super) struct Group {
    /// Metres of relative motion for a radian of each joint, at most.
    pub levers_m: Vec<f64>,
    /// Indices of its pairs.
    pub pairs: Vec<usize>,
}

/// The solids of a cell and the pairs that must stay apart.
pub(super) struct Solids {
    pub moving: Vec<Solid>,
    pub fixed: Vec<Solid>,
    pub pairs: Vec<Pair>,
    pub groups: Vec<Group>,
    /// Groups by the solid that moves and the last link that does not move it.
    known: BTreeMap<(usize, usize), usize>,
}

impl Solids {
    pub fn new(cell: &Cell) -> Self {
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
        let mut solids =
            Self { moving, fixed: Vec::new(), pairs: Vec::new(), groups: Vec::new(), known: BTreeMap::new() };
        let lengths = Lengths::new(kinematics);
        solids.add_moving(cell, &lengths);
        let identity = Pose::identity();
        for region in &cell.keep_out {
            let solid = solid(&region.name, 0, &identity, &region.shape_in_base);
            solids.add_fixed(solid, FROM_LINK.2, cell.margin_m, &lengths);
        }
        if let Some(object) = &cell.object {
            solids.add_fixed(object_solid(object), FROM_LINK.1, cell.margin_m, &lengths);
        }
        if let Some(z) = cell.table_z_m {
            let below = SharedShape::new(HalfSpace::new(Vec3::new(0.0, 0.0, 1.0)));
            let table = Solid::new("table", 0, Pose3::translation(0.0, 0.0, z), below);
            solids.add_fixed(table, FROM_LINK.0, cell.margin_m, &lengths);
        }
        solids
    }

    /// The two solids of a pair.
    pub fn of(&self, pair: &Pair) -> Option<(&Solid, &Solid)> {
        let second = match pair.second {
            Second::Moving(i) => self.moving.get(i)?,
            Second::Fixed(i) => self.fixed.get(i)?,
        };
        Some((self.moving.get(pair.first)?, second))
    }

    /// `moved` moves against links up to `still`; that bounds the pair's motion.
    fn add(
        &mut self,
        first: usize,
        second: Second,
        margin_m: f64,
        (moved, still): (usize, usize),
        lengths: &Lengths,
    ) {
        let group = match self.known.get(&(moved, still)) {
            Some(known) => *known,
            None => {
                let levers_m = self.moving.get(moved).map_or_else(Vec::new, |solid| {
                    let (center, radius) = solid.ball_in_link();
                    lengths.levers(solid.link, still, center, radius)
                });
                self.groups.push(Group { levers_m, pairs: Vec::new() });
                self.known.insert((moved, still), self.groups.len() - 1);
                self.groups.len() - 1
            }
        };
        if let Some(group) = self.groups.get_mut(group) {
            group.pairs.push(self.pairs.len());
        }
        self.pairs.push(Pair { first, second, margin_m, group });
    }

    fn add_moving(&mut self, cell: &Cell, lengths: &Lengths) {
        for (first, second) in self.pairs_that_can_part(cell) {
            let still = self.moving.get(first).map_or(0, |a| a.link);
            self.add(first, Second::Moving(second), cell.self_margin_m, (second, still), lengths);
        }
    }

    fn add_fixed(&mut self, solid: Solid, from_link: usize, margin_m: f64, lengths: &Lengths) {
        let near = self.moving.iter().enumerate().filter(|(_, a)| a.link >= from_link);
        let near: Vec<usize> = near.map(|(i, _)| i).collect();
        let second = Second::Fixed(self.fixed.len());
        self.fixed.push(solid);
        for first in near {
            self.add(first, second, margin_m, (first, 0), lengths);
        }
    }

    /// Pairs of parts of the arm, the one on the lower link first.
    fn pairs_that_can_part(&self, cell: &Cell) -> Vec<(usize, usize)> {
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
            let joints = cell.robot.joints.iter();
            let q: Vec<f64> =
                joints.map(|j| j.lower_rad + rng.random::<f64>() * (j.upper_rad - j.lower_rad)).collect();
            let poses = link_poses(cell, &q);
            for (seen, (i, k)) in parted.iter_mut().zip(&candidates) {
                if let (true, Some(a), Some(b)) = (*seen <= seldom, self.moving.get(*i), self.moving.get(*k))
                {
                    *seen += usize::from(are_apart(a, b, &poses));
                }
            }
        }
        candidates.into_iter().zip(parted).filter(|(_, p)| *p > seldom).map(|(pair, _)| pair).collect()
    }
}

/// Where the links are at `q`.
pub(super) fn link_poses(cell: &Cell, q: &[f64]) -> Vec<Pose3> {
    cell.robot.kinematics.link_poses(q).iter().map(pose3).collect()
}

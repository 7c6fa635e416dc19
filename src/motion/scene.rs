//! A cell prepared for collision queries: bodies on links, the pairs worth checking, their levers.

use std::ops::Range;

use rand::Rng;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

use super::bodies::{Body, Fixed, bodies_of, fixed_of};
use super::broad::{Ball, Group, LEAST_OF_GROUP};
use super::cell::Cell;
use super::contact::{Contact, ContactKind};
use super::distance::{segment_point, segment_segment, shape_bottom, shape_point, shape_shape_up_to};
use super::joints::{Joints, MAX_JOINTS, joints_from};
use super::levers::Levers;
use super::roll_axis::last_joint_rolls;
use super::shape::Core;
use super::sweep::RESOLUTION_M;
use super::work::{Work, cost, inverse_work};
use crate::geometry::{Point, Pose};
use crate::robot::LinkShape;

/// Random states that tell which parts of the arm always touch.
const TOUCH_SAMPLES: usize = 200;

/// What a body must keep away from.
#[derive(Clone, Copy)]
enum Other {
    Body(usize),
    Table(f64),
    /// A fixed sphere.
    Ball(usize, Point, f64),
    /// Any other fixed solid.
    Fixed(usize),
}

/// A body, what it must keep away from, by how much, and how fast the two can approach.
#[derive(Clone)]
pub(crate) struct Pair {
    body: usize,
    other: Other,
    pub margin_m: f64,
    /// By how much the start state undercuts the margin, and with it the way out of it may, metres.
    pub relief_m: f64,
    /// Metres of relative motion for a radian of each joint, at most.
    pub levers_m: Joints,
}

/// A cell prepared for collision queries.
pub(crate) struct Scene<'a> {
    pub cell: &'a Cell,
    pub dof: usize,
    bodies: Vec<Body>,
    fixed: Vec<Fixed>,
    /// Those of the groups last, in their order.
    pairs: Vec<Pair>,
    groups: Vec<Group>,
    /// What one call of the inverse kinematics costs.
    pub inverse_cost: u64,
    /// See [`last_joint_rolls`].
    pub last_joint_rolls: Option<f64>,
}

/// Where everything is at one joint state, reused between queries; counts their work.
#[derive(Default)]
pub(crate) struct Placement {
    poses: Vec<Pose>,
    cores: Vec<(Point, Point)>,
    pub work: Work,
}

impl Placement {
    /// To query under `work`.
    pub fn new(work: Work) -> Self {
        Self { work, ..Self::default() }
    }
}

impl<'a> Scene<'a> {
    /// Prepares a validated cell.
    pub fn new(cell: &'a Cell) -> Self {
        let kinematics = cell.robot.kinematics.as_ref();
        let dof = kinematics.dof().min(MAX_JOINTS);
        let bodies = bodies_of(cell, dof);
        let levers = Levers::new(kinematics);
        let mut scene = Self {
            cell,
            dof,
            bodies,
            fixed: fixed_of(cell),
            pairs: Vec::new(),
            groups: Vec::new(),
            inverse_cost: inverse_work(kinematics),
            last_joint_rolls: last_joint_rolls(cell),
        };
        scene.pairs = scene.self_pairs(&levers);
        scene.drop_pairs_that_always_touch();
        scene.add_outside_pairs(&levers);
        scene
    }

    /// `cell` prepared, which differs from this one in its object alone.
    pub fn with_object_of<'b>(&self, cell: &'b Cell) -> Scene<'b> {
        let of_the_arm = self.pairs.iter().filter(|pair| matches!(pair.other, Other::Body(_)));
        let mut scene = Scene {
            cell,
            dof: self.dof,
            bodies: self.bodies.clone(),
            fixed: fixed_of(cell),
            pairs: of_the_arm.cloned().collect(),
            groups: Vec::new(),
            inverse_cost: self.inverse_cost,
            last_joint_rolls: self.last_joint_rolls,
        };
        scene.add_outside_pairs(&Levers::new(cell.robot.kinematics.as_ref()));
        scene
    }

    fn self_pairs(&self, levers: &Levers) -> Vec<Pair> {
        let mut pairs = Vec::new();
        for (i, a) in self.bodies.iter().enumerate() {
            for (k, b) in self.bodies.iter().enumerate().skip(i + 1) {
                // What is mounted on the last link does not belong to its joint, as neighbours do.
                let mounted_and_neighbour = b.is_mounted && a.link + 1 == b.link;
                if b.link > a.link + 1 || mounted_and_neighbour {
                    let mut levers_m = levers.of_shape(b.link, &b.core);
                    // Joints below both links move them together.
                    levers_m.iter_mut().take(a.link).for_each(|lever| *lever = 0.0);
                    pairs.push(Pair {
                        body: i,
                        other: Other::Body(k),
                        margin_m: self.cell.self_margin_m,
                        relief_m: 0.0,
                        levers_m,
                    });
                }
            }
        }
        pairs
    }

    /// Parts that touch in every sampled state are built that way.
    fn drop_pairs_that_always_touch(&mut self) {
        let mut rng = ChaCha8Rng::seed_from_u64(1);
        let mut apart = vec![false; self.pairs.len()];
        let mut placement = Placement::default();
        for _ in 0..TOUCH_SAMPLES {
            let mut q = [0.0; MAX_JOINTS];
            for (slot, joint) in q.iter_mut().zip(&self.cell.robot.joints) {
                *slot = joint.lower_rad + (joint.upper_rad - joint.lower_rad) * rng.random::<f64>();
            }
            self.place(&q, &mut placement);
            for (i, seen_apart) in apart.iter_mut().enumerate() {
                *seen_apart = *seen_apart || self.clearance(i, &mut placement, f64::MIN_POSITIVE) > 0.0;
            }
            if apart.iter().all(|a| *a) {
                return;
            }
        }
        let mut keep = apart.into_iter();
        self.pairs.retain(|_| keep.next().unwrap_or(true));
    }

    fn add_outside_pairs(&mut self, levers: &Levers) {
        let margin_m = self.cell.margin_m;
        let mut grouped: Vec<(usize, usize, Vec<Pair>)> = Vec::new();
        for (body, b) in self.bodies.iter().enumerate() {
            let levers_m = levers.of_shape(b.link, &b.core);
            let pair = |other| Pair { body, other, margin_m, relief_m: 0.0, levers_m };
            // The base stands on the table, and the link on it only turns there.
            self.pairs.extend(self.cell.table_z_m.filter(|_| b.link > 1).map(|z| pair(Other::Table(z))));
            let reach = levers.reach_of_shape(b.link, &b.core);
            for (i, fixed) in self.fixed.iter().enumerate() {
                // Where the base stands is no question of the motion.
                if b.link == 0 && fixed.kind == ContactKind::Obstacle {
                    continue;
                }
                if fixed.around.distance(&reach.center) > reach.radius_m + margin_m {
                    continue;
                }
                let other = match fixed.shape {
                    LinkShape::Capsule { from_in_link, to_in_link, radius_m }
                        if from_in_link == to_in_link =>
                    {
                        Other::Ball(i, from_in_link, radius_m)
                    }
                    _ => Other::Fixed(i),
                };
                match grouped.iter_mut().find(|(link, fixed, _)| (*link, *fixed) == (b.link, i)) {
                    Some((_, _, pairs)) => pairs.push(pair(other)),
                    None => grouped.push((b.link, i, vec![pair(other)])),
                }
            }
        }
        let (many, few): (Vec<_>, Vec<_>) =
            grouped.into_iter().partition(|(_, _, pairs)| pairs.len() >= LEAST_OF_GROUP);
        self.pairs.extend(few.into_iter().flat_map(|(_, _, pairs)| pairs));
        for (link, fixed, pairs) in many {
            let first = self.pairs.len();
            let ball_of = |pair: &Pair| self.bodies.get(pair.body).map(|b| Ball::around(&b.core));
            let balls: Vec<Ball> = pairs.iter().filter_map(ball_of).collect();
            let largest = |j: usize| pairs.iter().map(|pair| pair.levers_m[j]).fold(0.0, f64::max);
            self.groups.push(Group {
                link,
                fixed,
                pairs: first..first + pairs.len(),
                ball_in_link: Ball::around_all(balls.iter().copied()),
                margin_m,
                levers_m: std::array::from_fn(largest),
            });
            self.pairs.extend(pairs);
        }
    }

    /// How many pairs are in no group; they come first.
    pub fn single_pairs(&self) -> usize {
        self.groups.first().map_or(self.pairs.len(), |group| group.pairs.start)
    }

    /// Groups of pairs, in the order of their pairs.
    pub fn groups(&self) -> &[Group] {
        &self.groups
    }

    /// A lower bound of the distances of a group's pairs, metres.
    pub fn group_clearance(&self, group: &Group, placement: &mut Placement) -> f64 {
        placement.work.spend(cost::BOUND);
        let (Some(pose), Some(fixed)) = (placement.poses.get(group.link), self.fixed.get(group.fixed)) else {
            return f64::NEG_INFINITY;
        };
        fixed.around.distance(&(pose * group.ball_in_link.center)) - group.ball_in_link.radius_m
    }

    /// All pairs that a query goes through.
    pub fn pairs(&self) -> &[Pair] {
        &self.pairs
    }

    /// Puts every body where it is at `q`.
    pub fn place(&self, q: &Joints, placement: &mut Placement) {
        placement.work.spend(cost::PLACE * (self.dof + self.bodies.len()) as u64);
        self.cell.robot.kinematics.link_poses_into(&q[..self.dof], &mut placement.poses);
        placement.cores.clear();
        placement.cores.extend(self.bodies.iter().map(|body| {
            let pose = placement.poses.get(body.link).copied().unwrap_or_default();
            (pose * body.core.a, pose * body.core.b)
        }));
    }

    /// The signed distance of a pair, metres, or any lower bound of it that is at least `enough_m`.
    pub fn clearance(&self, pair: usize, placement: &mut Placement, enough_m: f64) -> f64 {
        let Some(pair) = self.pairs.get(pair) else { return f64::INFINITY };
        let Some(body) = self.bodies.get(pair.body) else { return f64::INFINITY };
        let Some(&(a, b)) = placement.cores.get(pair.body) else { return f64::INFINITY };
        placement.work.spend(cost::BOUND);
        let (quick, exact) = match pair.other {
            Other::Body(k) => match (self.bodies.get(k), placement.cores.get(k)) {
                (Some(other), Some((c, d))) => {
                    let apart = 0.5 * ((a.coords + b.coords) - (c.coords + d.coords)).norm();
                    let far_m = apart - body.ball_radius_m - other.ball_radius_m;
                    if far_m >= enough_m {
                        return far_m;
                    }
                    (segment_segment(&a, &b, c, d) - other.core.radius_m, body.exact && other.exact)
                }
                _ => return f64::INFINITY,
            },
            Other::Table(z) => (a.z.min(b.z) - z, body.exact),
            Other::Ball(_, center, radius) => (segment_point(&a, &b, &center) - radius, body.exact),
            Other::Fixed(i) => match self.fixed.get(i) {
                Some(fixed) => {
                    let middle = nalgebra::center(&a, &b);
                    let far_m = fixed.around.distance(&middle) - body.ball_radius_m;
                    if far_m >= enough_m {
                        return far_m;
                    }
                    if fixed.exact {
                        let Core { a: c, b: d, radius_m } = &fixed.core;
                        (segment_segment(&a, &b, c, d) - radius_m, body.exact)
                    } else {
                        let to_middle = shape_point(&Pose::identity(), &fixed.shape, &middle);
                        (to_middle - 0.5 * (b - a).norm(), false)
                    }
                }
                None => return f64::INFINITY,
            },
        };
        placement.work.spend(cost::FORMULA);
        let quick = quick - body.core.radius_m;
        if exact || quick >= enough_m {
            quick
        } else {
            self.exact_clearance(body, pair.other, placement, enough_m)
        }
    }

    fn exact_clearance(&self, body: &Body, other: Other, placement: &mut Placement, enough_m: f64) -> f64 {
        let pose_of = |link: usize| placement.poses.get(link).copied().unwrap_or_default();
        let pose = pose_of(body.link);
        let (clearance, other_is_exact) = match other {
            Other::Body(k) => match self.bodies.get(k) {
                Some(o) => {
                    let placed = pose_of(o.link);
                    (shape_shape_up_to(&pose, &body.shape, &placed, &o.shape, enough_m), o.exact)
                }
                None => return f64::INFINITY,
            },
            Other::Table(z) => (shape_bottom(&pose, &body.shape) - z, true),
            Other::Ball(_, center, radius) => (shape_point(&pose, &body.shape, &center) - radius, true),
            Other::Fixed(i) => match self.fixed.get(i) {
                Some(fixed) => {
                    let placed = Pose::identity();
                    (shape_shape_up_to(&pose, &body.shape, &placed, &fixed.shape, enough_m), fixed.exact)
                }
                None => return f64::INFINITY,
            },
        };
        placement.work.spend(if body.exact || other_is_exact { cost::SEARCH } else { cost::GJK });
        clearance
    }

    /// Remembers by how much each pair undercuts its margin at the start state `q`, for sweeps with relief.
    pub fn excuse(&mut self, q: &Joints, placement: &mut Placement) {
        self.place(q, placement);
        for i in 0..self.pairs.len() {
            let margin_m = self.pairs.get(i).map_or(0.0, |pair| pair.margin_m);
            let under_m = margin_m - self.clearance(i, placement, margin_m);
            if let Some(pair) = self.pairs.get_mut(i).filter(|_| under_m > 0.0) {
                pair.relief_m = under_m + RESOLUTION_M;
            }
        }
    }

    /// Whether every pair keeps its margin at `q`.
    pub fn is_free(&self, q: &Joints, placement: &mut Placement) -> bool {
        self.place(q, placement);
        let keeps = |range: Range<usize>, placement: &mut Placement| {
            let pairs = self.pairs.get(range.clone()).unwrap_or_default();
            pairs
                .iter()
                .zip(range)
                .all(|(pair, i)| self.clearance(i, placement, pair.margin_m) >= pair.margin_m)
        };
        keeps(0..self.single_pairs(), placement)
            && self.groups.iter().all(|group| {
                self.group_clearance(group, placement) >= group.margin_m
                    || keeps(group.pairs.clone(), placement)
            })
    }

    /// The pair deepest inside its margin at `q`, if any is and it is less deep than `less_than_m`.
    pub fn deepest_contact(
        &self,
        q: &Joints,
        placement: &mut Placement,
        less_than_m: f64,
    ) -> Option<Contact> {
        self.place(q, placement);
        let mut deepest: Option<usize> = None;
        let mut depth_m = 0.0;
        for (i, pair) in self.pairs.iter().enumerate() {
            // What is no nearer than this is no deeper than the deepest so far.
            let found_m = pair.margin_m - self.clearance(i, placement, pair.margin_m - depth_m);
            if found_m > depth_m {
                (deepest, depth_m) = (Some(i), found_m);
                if depth_m >= less_than_m {
                    return None;
                }
            }
        }
        self.contact(deepest?, depth_m)
    }

    /// The pair that overlaps most at `q`, if any does. A pair may be deeper inside its margin
    /// without overlapping, since margins differ.
    pub fn deepest_overlap(&self, q: &Joints, placement: &mut Placement) -> Option<Contact> {
        self.place(q, placement);
        let distances: Vec<(usize, f64)> =
            (0..self.pairs.len()).map(|i| (i, self.clearance(i, placement, f64::MIN_POSITIVE))).collect();
        let (pair, distance_m) = distances.into_iter().min_by(|a, b| a.1.total_cmp(&b.1))?;
        let margin_m = self.pairs.get(pair)?.margin_m;
        (distance_m <= 0.0).then(|| self.contact(pair, margin_m - distance_m))?
    }

    fn contact(&self, pair: usize, depth_m: f64) -> Option<Contact> {
        let pair = self.pairs.get(pair)?;
        let (kind, second) = match pair.other {
            Other::Body(k) => (ContactKind::SelfCollision, self.bodies.get(k)?.name.clone()),
            Other::Table(_) => (ContactKind::Table, "table".to_owned()),
            Other::Ball(i, ..) | Other::Fixed(i) => {
                self.fixed.get(i).map(|fixed| (fixed.kind, fixed.name.clone()))?
            }
        };
        let first = self.bodies.get(pair.body)?.name.clone();
        Some(Contact { kind, first, second, depth_m, distance_m: pair.margin_m - depth_m })
    }

    /// Bounds of joint angles, radians; entries beyond the arm's joints are 0.
    pub fn limits(&self) -> (Joints, Joints) {
        let joints = &self.cell.robot.joints;
        let lower: Vec<f64> = joints.iter().map(|j| j.lower_rad).collect();
        let upper: Vec<f64> = joints.iter().map(|j| j.upper_rad).collect();
        (joints_from(&lower), joints_from(&upper))
    }
}

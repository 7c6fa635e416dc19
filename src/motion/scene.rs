//! A cell prepared for collision queries: bodies on links, the pairs worth checking, their levers.

use rand::Rng;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

use super::cell::Cell;
use super::contact::{Contact, ContactKind};
use super::distance::{segment_point, segment_segment, shape_bottom, shape_point, shape_shape};
use super::joints::{Joints, MAX_JOINTS, joints_from};
use super::levers::Levers;
use super::shape::{Core, carried_by, core};
use super::sweep::RESOLUTION_M;
use crate::geometry::{Point, Pose};
use crate::robot::LinkShape;

/// Random states that tell which parts of the arm always touch.
const TOUCH_SAMPLES: usize = 200;

/// A shape on a link.
pub(crate) struct Body {
    name: String,
    link: usize,
    /// Camera or tool.
    is_mounted: bool,
    shape: LinkShape,
    core: Core,
    /// Whether `core` is the shape itself.
    exact: bool,
}

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

/// A solid that does not move, in the base frame.
struct Fixed {
    kind: ContactKind,
    name: String,
    shape: LinkShape,
    core: Core,
    /// Whether `core` is the shape itself.
    exact: bool,
}

/// A body, what it must keep away from, by how much, and how fast the two can approach.
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
    pairs: Vec<Pair>,
}

/// Where everything is at one joint state; reused between queries.
#[derive(Default)]
pub(crate) struct Placement {
    poses: Vec<Pose>,
    cores: Vec<(Point, Point)>,
}

impl<'a> Scene<'a> {
    /// Prepares a validated cell.
    pub fn new(cell: &'a Cell) -> Self {
        let kinematics = cell.robot.kinematics.as_ref();
        let dof = kinematics.dof().min(MAX_JOINTS);
        let bodies = bodies_of(cell, dof);
        let levers = Levers::new(kinematics);
        let mut scene = Self { cell, dof, bodies, fixed: fixed_of(cell), pairs: Vec::new() };
        scene.pairs = scene.self_pairs(&levers);
        scene.drop_pairs_that_always_touch();
        let outside = scene.outside_pairs(&levers);
        scene.pairs.extend(outside);
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
                *seen_apart = *seen_apart || self.clearance(i, &placement, f64::INFINITY) > 0.0;
            }
            if apart.iter().all(|a| *a) {
                return;
            }
        }
        let mut keep = apart.into_iter();
        self.pairs.retain(|_| keep.next().unwrap_or(true));
    }

    fn outside_pairs(&self, levers: &Levers) -> Vec<Pair> {
        let margin_m = self.cell.margin_m;
        let mut pairs = Vec::new();
        for (body, b) in self.bodies.iter().enumerate() {
            let levers_m = levers.of_shape(b.link, &b.core);
            let mut add = |other| pairs.push(Pair { body, other, margin_m, relief_m: 0.0, levers_m });
            for (i, fixed) in self.fixed.iter().enumerate() {
                // Where the base stands is no question of the motion.
                if b.link == 0 && fixed.kind == ContactKind::Obstacle {
                    continue;
                }
                match fixed.shape {
                    LinkShape::Capsule { from_in_link, to_in_link, radius_m }
                        if from_in_link == to_in_link =>
                    {
                        add(Other::Ball(i, from_in_link, radius_m));
                    }
                    _ => add(Other::Fixed(i)),
                }
            }
            // The base stands on the table, and the link on it only turns there.
            if let (Some(z), true) = (self.cell.table_z_m, b.link > 1) {
                add(Other::Table(z));
            }
        }
        pairs
    }

    /// All pairs that a query goes through.
    pub fn pairs(&self) -> &[Pair] {
        &self.pairs
    }

    /// Puts every body where it is at `q`.
    pub fn place(&self, q: &Joints, placement: &mut Placement) {
        self.cell.robot.kinematics.link_poses_into(&q[..self.dof], &mut placement.poses);
        placement.cores.clear();
        placement.cores.extend(self.bodies.iter().map(|body| {
            let pose = placement.poses.get(body.link).copied().unwrap_or_default();
            (pose * body.core.a, pose * body.core.b)
        }));
    }

    /// The signed distance of a pair, metres, or any lower bound of it that is at least `enough_m`.
    pub fn clearance(&self, pair: usize, placement: &Placement, enough_m: f64) -> f64 {
        let Some(pair) = self.pairs.get(pair) else { return f64::INFINITY };
        let Some(body) = self.bodies.get(pair.body) else { return f64::INFINITY };
        let Some((a, b)) = placement.cores.get(pair.body) else { return f64::INFINITY };
        let (quick, exact) = match pair.other {
            Other::Body(k) => match (self.bodies.get(k), placement.cores.get(k)) {
                (Some(other), Some((c, d))) => {
                    (segment_segment(a, b, c, d) - other.core.radius_m, body.exact && other.exact)
                }
                _ => return f64::INFINITY,
            },
            Other::Table(z) => (a.z.min(b.z) - z, body.exact),
            Other::Ball(_, center, radius) => (segment_point(a, b, &center) - radius, body.exact),
            Other::Fixed(i) => match self.fixed.get(i) {
                Some(fixed) if fixed.exact => {
                    let Core { a: c, b: d, radius_m } = &fixed.core;
                    (segment_segment(a, b, c, d) - radius_m, body.exact)
                }
                Some(fixed) => {
                    let middle = nalgebra::center(a, b);
                    let to_middle = shape_point(&Pose::identity(), &fixed.shape, &middle);
                    (to_middle - 0.5 * (b - a).norm(), false)
                }
                None => return f64::INFINITY,
            },
        };
        let quick = quick - body.core.radius_m;
        if exact || quick >= enough_m { quick } else { self.exact_clearance(body, pair.other, placement) }
    }

    fn exact_clearance(&self, body: &Body, other: Other, placement: &Placement) -> f64 {
        let pose_of = |link: usize| placement.poses.get(link).copied().unwrap_or_default();
        let pose = pose_of(body.link);
        match other {
            Other::Body(k) => self
                .bodies
                .get(k)
                .map_or(f64::INFINITY, |o| shape_shape(&pose, &body.shape, &pose_of(o.link), &o.shape)),
            Other::Table(z) => shape_bottom(&pose, &body.shape) - z,
            Other::Ball(_, center, radius) => shape_point(&pose, &body.shape, &center) - radius,
            Other::Fixed(i) => self.fixed.get(i).map_or(f64::INFINITY, |fixed| {
                shape_shape(&pose, &body.shape, &Pose::identity(), &fixed.shape)
            }),
        }
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
        self.pairs
            .iter()
            .enumerate()
            .all(|(i, pair)| self.clearance(i, placement, pair.margin_m) >= pair.margin_m)
    }

    /// The pair deepest inside its margin at `q`, if any is.
    pub fn deepest_contact(&self, q: &Joints, placement: &mut Placement) -> Option<Contact> {
        self.place(q, placement);
        let depth = |i: usize, pair: &Pair| pair.margin_m - self.clearance(i, placement, pair.margin_m);
        let (deepest, depth_m) = self
            .pairs
            .iter()
            .enumerate()
            .map(|(i, pair)| (i, depth(i, pair)))
            .max_by(|a, b| a.1.total_cmp(&b.1))
            .filter(|(_, depth_m)| *depth_m > 0.0)?;
        self.contact(deepest, depth_m)
    }

    /// The pair that overlaps most at `q`, if any does. A pair may be deeper inside its margin
    /// without overlapping, since margins differ.
    pub fn deepest_overlap(&self, q: &Joints, placement: &mut Placement) -> Option<Contact> {
        self.place(q, placement);
        let distances = (0..self.pairs.len()).map(|i| (i, self.clearance(i, placement, 0.0)));
        let (pair, distance_m) = distances.min_by(|a, b| a.1.total_cmp(&b.1))?;
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

fn bodies_of(cell: &Cell, dof: usize) -> Vec<Body> {
    let body = |name: &str, link: usize, is_mounted: bool, shape: LinkShape| Body {
        name: name.to_owned(),
        link,
        is_mounted,
        core: core(&shape),
        exact: matches!(shape, LinkShape::Capsule { .. }),
        shape,
    };
    let kinematics = cell.robot.kinematics.as_ref();
    let zero = [0.0; MAX_JOINTS];
    let last_pose = kinematics.link_poses(&zero[..dof]).pop().unwrap_or_default();
    let last_from_flange = last_pose.inv_mul(&kinematics.forward(&zero[..dof]));
    let last_from_camera = last_from_flange * cell.flange_from_camera;
    let links = cell.robot.links.iter().enumerate().flat_map(|(i, link)| {
        link.shapes.iter().map(move |shape| body(&link.name, i.min(dof), false, shape.clone()))
    });
    let mounted = |name, last_from_frame: Pose, solids: &'_ [LinkShape]| -> Vec<Body> {
        solids.iter().map(|shape| body(name, dof, true, carried_by(&last_from_frame, shape))).collect()
    };
    let camera = mounted("camera", last_from_camera, &cell.camera_body);
    let tool = mounted("tool", last_from_flange, &cell.tool);
    links.chain(camera).chain(tool).collect()
}

fn fixed_of(cell: &Cell) -> Vec<Fixed> {
    let fixed = |kind, name: &str, shape: LinkShape| Fixed {
        kind,
        name: name.to_owned(),
        core: core(&shape),
        exact: matches!(shape, LinkShape::Capsule { .. }),
        shape,
    };
    let object = cell.object.iter().map(|o| fixed(ContactKind::Object, "object", o.solid_in_base()));
    let regions =
        cell.keep_out.iter().map(|k| fixed(ContactKind::Obstacle, &k.name, k.shape_in_base.clone()));
    object.chain(regions).collect()
}

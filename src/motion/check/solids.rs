//! Collisions by dense samples, every distance from parry.

use parry3d_f64::math::{Pose3, Rot3, Vec3};
use parry3d_f64::query;
use parry3d_f64::shape::{Ball, Capsule, Cuboid, Cylinder, HalfSpace, SharedShape};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::Violation;
use crate::geometry::{Pose, Vector};
use crate::motion::cell::{Cell, KeepOut};
use crate::motion::object::{CellObject, ObjectShape};
use crate::motion::plan::{MotionPlan, TrajectoryPoint};
use crate::robot::LinkShape;

/// Largest joint move between two looked-at states, radians.
const STEP_RAD: f64 = 0.02;
/// By how much a margin may be undercut, metres: the planner's resolution and GJK's.
const TOLERANCE_M: f64 = 1e-3;
/// Random states that tell which parts always touch.
const TOUCH_SAMPLES: usize = 300;

struct Solid {
    name: String,
    /// The link that carries it; 0 for what does not move.
    link: usize,
    link_from_solid: Pose3,
    shape: SharedShape,
    /// A sphere around it in its own frame; infinite for the table.
    around: (Vec3, f64),
}

/// Distance beyond which spheres around solids are told apart instead of the solids, metres.
const FAR_M: f64 = 0.1;

/// All solids of a cell and the pairs that must stay apart.
pub(super) struct Solids<'a> {
    cell: &'a Cell,
    moving: Vec<Solid>,
    /// Each with the first link that has to keep away from it.
    fixed: Vec<(Solid, usize)>,
    /// Indices into `moving`.
    self_pairs: Vec<(usize, usize)>,
}

impl<'a> Solids<'a> {
    pub fn new(cell: &'a Cell) -> Self {
        let dof = cell.robot.kinematics.dof();
        let mut moving = Vec::new();
        for (link, parts) in cell.robot.links.iter().enumerate() {
            moving.extend(parts.shapes.iter().map(|s| solid(&parts.name, link, &Pose::identity(), s)));
        }
        let zero = vec![0.0; dof];
        let base_from_last = cell.robot.kinematics.link_poses(&zero).last().copied().unwrap_or_default();
        let last_from_camera =
            base_from_last.inverse() * cell.robot.kinematics.forward(&zero) * cell.flange_from_camera;
        moving.extend(cell.camera_body.iter().map(|s| solid("camera", dof, &last_from_camera, s)));
        let last_from_flange = base_from_last.inverse() * cell.robot.kinematics.forward(&zero);
        moving.extend(cell.tool.iter().map(|s| solid("tool", dof, &last_from_flange, s)));
        let identity = Pose::identity();
        let region = |k: &KeepOut| (solid(&k.name, 0, &identity, &k.shape_in_base), FROM_LINK.2);
        let mut fixed: Vec<(Solid, usize)> = cell.keep_out.iter().map(region).collect();
        if let Some(object) = &cell.object {
            fixed.push((object_solid(object), FROM_LINK.1));
        }
        if let Some(z) = cell.table_z_m {
            let below = SharedShape::new(HalfSpace::new(Vec3::new(0.0, 0.0, 1.0)));
            fixed.push((Solid::new("table", 0, Pose3::translation(0.0, 0.0, z), below), FROM_LINK.0));
        }
        let mut solids = Self { cell, moving, fixed, self_pairs: Vec::new() };
        solids.self_pairs = solids.pairs_that_can_part();
        solids
    }

    fn pairs_that_can_part(&self) -> Vec<(usize, usize)> {
        let mut candidates = Vec::new();
        for (i, a) in self.moving.iter().enumerate() {
            for (k, b) in self.moving.iter().enumerate().skip(i + 1) {
                let gap = b.link.abs_diff(a.link);
                if gap >= 2 || (gap == 1 && (b.name == "camera" || b.name == "tool")) {
                    candidates.push((i, k));
                }
            }
        }
        let mut rng = ChaCha8Rng::seed_from_u64(77);
        let mut parted = vec![false; candidates.len()];
        for _ in 0..TOUCH_SAMPLES {
            let q: Vec<f64> = self
                .cell
                .robot
                .joints
                .iter()
                .map(|j| j.lower_rad + rng.random::<f64>() * (j.upper_rad - j.lower_rad))
                .collect();
            let poses = self.link_poses(&q);
            for (seen, (i, k)) in parted.iter_mut().zip(&candidates) {
                *seen = *seen || distance(&self.moving[*i], &self.moving[*k], &poses) > 0.0;
            }
        }
        candidates.into_iter().zip(parted).filter(|(_, p)| *p).map(|(pair, _)| pair).collect()
    }

    fn link_poses(&self, q: &[f64]) -> Vec<Pose3> {
        self.cell.robot.kinematics.link_poses(q).iter().map(pose3).collect()
    }

    /// Looks at the whole motion and reports each pair at the first moment it is too near.
    pub fn judge(&self, plan: &MotionPlan, violations: &mut Vec<Violation>) {
        let Some(first) = plan.trajectory.first() else { return };
        let at_start = self.distances(&first.positions_rad);
        let mut reported = vec![false; at_start.len()];
        let mut before_first_view = first.view.is_none();
        for pair in plan.trajectory.windows(2) {
            let [from, to] = pair else { continue };
            let largest = from
                .positions_rad
                .iter()
                .zip(&to.positions_rad)
                .fold(0.0f64, |m, (a, b)| m.max((a - b).abs()));
            let count = (largest / STEP_RAD).ceil().clamp(1.0, 10_000.0) as usize;
            for i in 1..=count {
                let share = i as f64 / count as f64;
                let time_s = from.time_from_start_s + share * (to.time_from_start_s - from.time_from_start_s);
                let distances = self.distances(&between(from, to, share));
                for (n, (now, start)) in distances.into_iter().zip(&at_start).enumerate() {
                    let wanted = if before_first_view {
                        now.margin_m.min(start.distance_m.max(0.0))
                    } else {
                        now.margin_m
                    };
                    if now.distance_m < wanted - TOLERANCE_M && !reported[n] {
                        reported[n] = true;
                        violations.push(Violation::TooNear {
                            time_s,
                            first: now.first.to_owned(),
                            second: now.second.to_owned(),
                            distance_m: now.distance_m,
                            margin_m: now.margin_m,
                        });
                    }
                }
            }
            before_first_view &= to.view.is_none();
        }
    }

    fn distances(&self, q: &[f64]) -> Vec<Measured<'_>> {
        let poses = self.link_poses(q);
        let mut all = Vec::with_capacity(self.self_pairs.len() + self.moving.len() * self.fixed.len());
        for (i, k) in &self.self_pairs {
            let (a, b) = (&self.moving[*i], &self.moving[*k]);
            let distance_m = distance(a, b, &poses);
            all.push(Measured {
                first: &a.name,
                second: &b.name,
                distance_m,
                margin_m: self.cell.self_margin_m,
            });
        }
        for a in &self.moving {
            for (b, _) in self.fixed.iter().filter(|(_, from_link)| a.link >= *from_link) {
                let distance_m = distance(a, b, &poses);
                all.push(Measured {
                    first: &a.name,
                    second: &b.name,
                    distance_m,
                    margin_m: self.cell.margin_m,
                });
            }
        }
        all
    }
}

/// First link that has to keep away from the table, from the object, from keep-out regions: the
/// base stands on the table and may stand in a region, the link on it only turns there.
const FROM_LINK: (usize, usize, usize) = (2, 0, 1);

struct Measured<'a> {
    first: &'a str,
    second: &'a str,
    distance_m: f64,
    margin_m: f64,
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

fn distance(a: &Solid, b: &Solid, poses: &[Pose3]) -> f64 {
    let place = |s: &Solid| poses.get(s.link).copied().unwrap_or_else(Pose3::identity) * s.link_from_solid;
    let (pa, pb) = (place(a), place(b));
    let between_spheres =
        (pa.transform_point(a.around.0) - pb.transform_point(b.around.0)).length() - a.around.1 - b.around.1;
    if between_spheres > FAR_M {
        return between_spheres;
    }
    match query::distance(&pa, a.shape.as_ref(), &pb, b.shape.as_ref()) {
        Ok(found) if found.distance > 0.0 => found.distance,
        _ => query::contact(&pa, a.shape.as_ref(), &pb, b.shape.as_ref(), 0.0)
            .ok()
            .flatten()
            .map_or(0.0, |contact| contact.dist.min(0.0)),
    }
}

fn solid(name: &str, link: usize, link_from_carrier: &Pose, shape: &LinkShape) -> Solid {
    let (carrier_from_solid, shape) = match shape {
        LinkShape::Capsule { from_in_link, to_in_link, radius_m } => {
            let (a, b) = (vec3(&from_in_link.coords), vec3(&to_in_link.coords));
            let shape = if (b - a).length() > 1e-9 {
                (Pose3::identity(), SharedShape::new(Capsule::new(a, b, *radius_m)))
            } else {
                (Pose3::from_translation(a), SharedShape::new(Ball::new(*radius_m)))
            };
            (shape.0, shape.1)
        }
        LinkShape::Cuboid { link_from_box, half_extents_m } => {
            (pose3(link_from_box), SharedShape::new(Cuboid::new(vec3(half_extents_m))))
        }
        LinkShape::Cylinder { link_from_cylinder, half_length_m, radius_m } => {
            let upright = Pose3::from_rotation(Rot3::from_rotation_x(std::f64::consts::FRAC_PI_2));
            (pose3(link_from_cylinder) * upright, SharedShape::new(Cylinder::new(*half_length_m, *radius_m)))
        }
    };
    Solid::new(name, link, pose3(link_from_carrier) * carrier_from_solid, shape)
}

impl Solid {
    fn new(name: &str, link: usize, link_from_solid: Pose3, shape: SharedShape) -> Self {
        let sphere = shape.compute_local_bounding_sphere();
        let around = (sphere.center, sphere.radius);
        Self { name: name.to_owned(), link, link_from_solid, shape, around }
    }
}

fn object_solid(object: &CellObject) -> Solid {
    let at = Pose3::from_translation(vec3(&object.center_in_base.coords));
    let (pose, shape) = match object.shape {
        ObjectShape::Sphere => (at, SharedShape::new(Ball::new(object.radius_m))),
        // parry's cylinder stands along y.
        ObjectShape::Cylinder { radius_m, height_m } => (
            at * Pose3::from_rotation(Rot3::from_rotation_x(std::f64::consts::FRAC_PI_2)),
            SharedShape::new(Cylinder::new(0.5 * height_m, radius_m)),
        ),
        ObjectShape::Cuboid { size_m, yaw_rad } => (
            at * Pose3::from_rotation(Rot3::from_rotation_z(yaw_rad)),
            SharedShape::new(Cuboid::new(vec3(&(0.5 * size_m)))),
        ),
    };
    Solid::new("object", 0, pose, shape)
}

fn vec3(v: &Vector) -> Vec3 {
    Vec3::new(v.x, v.y, v.z)
}

fn pose3(pose: &Pose) -> Pose3 {
    let q = pose.rotation.coords;
    Pose3::from_parts(vec3(&pose.translation.vector), Rot3::from_xyzw(q.x, q.y, q.z, q.w))
}

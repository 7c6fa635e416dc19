//! Solids as parry knows them, and their distances.

use parry3d_f64::math::{Pose3, Rot3, Vec3};
use parry3d_f64::query;
use parry3d_f64::shape::{Ball, Capsule, Cuboid, Cylinder, SharedShape};

use crate::geometry::{Pose, Vector};
use crate::motion::object::{CellObject, ObjectShape};
use crate::robot::LinkShape;

/// A named solid on a link.
pub(super) struct Solid {
    pub name: String,
    /// The link that carries it; 0 for what does not move.
    pub link: usize,
    link_from_solid: Pose3,
    shape: SharedShape,
    /// A ball around it in its own frame; without end for the table.
    around: (Vec3, f64),
}

/// Distance between two balls around placed solids, metres: at most that of the solids.
pub(super) fn distance_at_least(a: &Solid, b: &Solid, poses: &[Pose3]) -> f64 {
    let (pa, pb) = (a.place(poses), b.place(poses));
    (pa.transform_point(a.around.0) - pb.transform_point(b.around.0)).length() - a.around.1 - b.around.1
}

/// Whether two placed solids do not touch.
pub(super) fn are_apart(a: &Solid, b: &Solid, poses: &[Pose3]) -> bool {
    distance_at_least(a, b, poses) > 0.0
        || query::distance(&a.place(poses), a.shape.as_ref(), &b.place(poses), b.shape.as_ref())
            .is_ok_and(|found| found.distance > 0.0)
}

/// Signed distance of two placed solids, metres.
pub(super) fn distance(a: &Solid, b: &Solid, poses: &[Pose3]) -> f64 {
    let (pa, pb) = (a.place(poses), b.place(poses));
    match query::distance(&pa, a.shape.as_ref(), &pb, b.shape.as_ref()) {
        Ok(found) if found.distance > 0.0 => found.distance,
        _ => query::contact(&pa, a.shape.as_ref(), &pb, b.shape.as_ref(), 0.0)
            .ok()
            .flatten()
            .map_or(0.0, |contact| contact.dist.min(0.0)),
    }
}

pub(super) fn solid(name: &str, link: usize, link_from_carrier: &Pose, shape: &LinkShape) -> Solid {
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
    pub fn new(name: &str, link: usize, link_from_solid: Pose3, shape: SharedShape) -> Self {
        let sphere = shape.compute_local_bounding_sphere();
        let around = (sphere.center, sphere.radius);
        Self { name: name.to_owned(), link, link_from_solid, shape, around }
    }

    /// Centre of the ball around it in the link's frame, and its radius.
    pub fn ball_in_link(&self) -> (Vec3, f64) {
        (self.link_from_solid.transform_point(self.around.0), self.around.1)
    }

    fn place(&self, poses: &[Pose3]) -> Pose3 {
        poses.get(self.link).copied().unwrap_or_else(Pose3::identity) * self.link_from_solid
    }
}

pub(super) fn object_solid(object: &CellObject) -> Solid {
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

pub(super) fn vec3(v: &Vector) -> Vec3 {
    Vec3::new(v.x, v.y, v.z)
}

pub(super) fn pose3(pose: &Pose) -> Pose3 {
    let q = pose.rotation.coords;
    Pose3::from_parts(vec3(&pose.translation.vector), Rot3::from_xyzw(q.x, q.y, q.z, q.w))
}

//! What the planner asks of a shape: a capsule around it, its place, whether its numbers are sound.

use crate::geometry::{Point, Pose, Vector};
use crate::robot::LinkShape;

/// A capsule that holds a shape: for capsules the shape itself.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Core {
    pub a: Point,
    pub b: Point,
    pub radius_m: f64,
}

/// The same solid seen from a frame that carries its frame.
pub(crate) fn carried_by(outer_from_frame: &Pose, shape: &LinkShape) -> LinkShape {
    match shape {
        LinkShape::Capsule { from_in_link, to_in_link, radius_m } => LinkShape::Capsule {
            from_in_link: outer_from_frame * from_in_link,
            to_in_link: outer_from_frame * to_in_link,
            radius_m: *radius_m,
        },
        LinkShape::Cuboid { link_from_box, half_extents_m } => LinkShape::Cuboid {
            link_from_box: outer_from_frame * link_from_box,
            half_extents_m: *half_extents_m,
        },
        LinkShape::Cylinder { link_from_cylinder, half_length_m, radius_m } => LinkShape::Cylinder {
            link_from_cylinder: outer_from_frame * link_from_cylinder,
            half_length_m: *half_length_m,
            radius_m: *radius_m,
        },
    }
}

/// The capsule itself, or one around the box (along its longest side) or the cylinder.
pub(crate) fn core(shape: &LinkShape) -> Core {
    match shape {
        LinkShape::Capsule { from_in_link, to_in_link, radius_m } => {
            Core { a: *from_in_link, b: *to_in_link, radius_m: *radius_m }
        }
        LinkShape::Cuboid { link_from_box, half_extents_m } => {
            let longest = half_extents_m.imax();
            let mut cross_section = *half_extents_m;
            cross_section[longest] = 0.0;
            let mut axis = Vector::zeros();
            axis[longest] = half_extents_m[longest];
            Core {
                a: link_from_box * Point::from(axis),
                b: link_from_box * Point::from(-axis),
                radius_m: cross_section.norm(),
            }
        }
        LinkShape::Cylinder { link_from_cylinder, half_length_m, radius_m } => {
            let axis = Vector::z() * *half_length_m;
            Core {
                a: link_from_cylinder * Point::from(axis),
                b: link_from_cylinder * Point::from(-axis),
                radius_m: *radius_m,
            }
        }
    }
}

/// Whether every number is finite and no size is negative.
pub(crate) fn is_sound(shape: &LinkShape) -> bool {
    let size = |v: f64| v.is_finite() && v >= 0.0;
    match shape {
        LinkShape::Capsule { from_in_link, to_in_link, radius_m } => {
            from_in_link.iter().chain(to_in_link.iter()).all(|v| v.is_finite()) && size(*radius_m)
        }
        LinkShape::Cuboid { link_from_box, half_extents_m } => {
            pose_is_finite(link_from_box) && half_extents_m.iter().all(|v| size(*v))
        }
        LinkShape::Cylinder { link_from_cylinder, half_length_m, radius_m } => {
            pose_is_finite(link_from_cylinder) && size(*half_length_m) && size(*radius_m)
        }
    }
}

/// Whether no number of `pose` is NaN or infinite.
pub(crate) fn pose_is_finite(pose: &Pose) -> bool {
    pose.translation.vector.iter().chain(pose.rotation.coords.iter()).all(|v| v.is_finite())
}

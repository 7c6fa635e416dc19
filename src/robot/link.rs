//! The links of an arm as simple shapes, for collision checks.

use crate::geometry::{Point, Pose, Vector};

/// A rigid link: the base, or the piece that a joint moves.
#[derive(Debug, Clone, PartialEq)]
pub struct Link {
    /// The link's name.
    pub name: String,
    /// Its shapes, in the link's frame (see [`super::Kinematics::link_poses_into`]). May be empty.
    pub shapes: Vec<LinkShape>,
}

/// A convex shape in a link's frame, metres.
#[derive(Debug, Clone, PartialEq)]
pub enum LinkShape {
    /// All points within `radius_m` of a segment; a ball if both ends are equal.
    Capsule {
        /// One end of the segment.
        from_in_link: Point,
        /// The other end.
        to_in_link: Point,
        /// The radius.
        radius_m: f64,
    },
    /// A box about its frame's origin.
    Cuboid {
        /// The box's frame.
        link_from_box: Pose,
        /// Half its edge lengths along x, y, z.
        half_extents_m: Vector,
    },
    /// A cylinder about its frame's z axis, its centre at the origin.
    Cylinder {
        /// The cylinder's frame.
        link_from_cylinder: Pose,
        /// Half its length along z.
        half_length_m: f64,
        /// The radius.
        radius_m: f64,
    },
}

impl LinkShape {
    /// A capsule between two points given as `[x, y, z]`, metres.
    pub fn capsule(from_in_link: [f64; 3], to_in_link: [f64; 3], radius_m: f64) -> Self {
        Self::Capsule {
            from_in_link: Point::from(from_in_link),
            to_in_link: Point::from(to_in_link),
            radius_m,
        }
    }
}

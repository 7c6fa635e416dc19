//! The joints' axes as lines in space.

use nalgebra::{Unit, UnitQuaternion};

use super::Chain;
use crate::geometry::{Point, Pose, Vector};

/// A joint's axis in the zero posture, in the base's frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Axis {
    /// A point on it, metres.
    pub point: Point,
    /// Its direction, of unit length.
    pub along: Vector,
}

impl Axis {
    /// The axes of a chain with all joints at 0.
    pub fn all_of(chain: &Chain) -> Vec<Self> {
        let mut poses = Vec::new();
        chain.link_poses_into(&[], &mut poses);
        let axes = poses.iter().skip(1).zip(chain.segments()).map(|(pose, segment)| Self {
            point: Point::from(pose.translation.vector),
            along: pose.rotation * segment.axis_in_joint.into_inner(),
        });
        axes.collect()
    }

    /// The nearest points of two axes, here and there; `None` if they are parallel.
    pub fn nearest(&self, other: &Self) -> Option<(Point, Point)> {
        let cosine = self.along.dot(&other.along);
        let squared_sine = 1.0 - cosine * cosine;
        // Not for a NaN either.
        if !(squared_sine >= 1e-6) {
            return None;
        }
        let between = other.point - self.point;
        let (d, e) = (between.dot(&self.along), between.dot(&other.along));
        let here = self.point + self.along * ((d - e * cosine) / squared_sine);
        let there = other.point + other.along * ((d * cosine - e) / squared_sine);
        Some((here, there))
    }

    /// The middle between the nearest points of two axes; `None` if they are parallel.
    pub fn meets(&self, other: &Self) -> Option<Point> {
        self.nearest(other).map(|(here, there)| nalgebra::center(&here, &there))
    }

    /// The distance of a point from the axis, metres.
    pub fn distance_m(&self, point: &Point) -> f64 {
        (point - self.point).cross(&self.along).norm()
    }

    /// Sine of the angle between two axes.
    pub fn sine(&self, other: &Self) -> f64 {
        self.along.cross(&other.along).norm()
    }

    /// The motion of everything behind the joint when it turns by `angle_rad`.
    pub fn turn(&self, angle_rad: f64) -> Pose {
        let rotation = UnitQuaternion::from_axis_angle(&Unit::new_unchecked(self.along), angle_rad);
        let centre = self.point.coords;
        Pose::from_parts((centre - rotation * centre).into(), rotation)
    }
}

//! Balls and boxes around solids: most pairs are told to be far apart without any distance.

use std::ops::Range;

use super::joints::Joints;
use super::shape::Core;
use crate::geometry::{Point, Pose, Vector};
use crate::robot::LinkShape;

/// A ball.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ball {
    pub center: Point,
    pub radius_m: f64,
}

impl Ball {
    /// Around a core, and so around its shape.
    pub fn around(core: &Core) -> Self {
        let center = nalgebra::center(&core.a, &core.b);
        Self { center, radius_m: 0.5 * (core.b - core.a).norm() + core.radius_m }
    }

    /// Around balls: about the middle of the box that holds them all.
    pub fn around_all(balls: impl Iterator<Item = Ball> + Clone) -> Self {
        let mut low = Vector::repeat(f64::INFINITY);
        let mut high = -low;
        for ball in balls.clone() {
            low = low.inf(&ball.center.coords.add_scalar(-ball.radius_m));
            high = high.sup(&ball.center.coords.add_scalar(ball.radius_m));
        }
        let center = Point::from(0.5 * (low + high));
        let reaches = balls.map(|ball| (ball.center - center).norm() + ball.radius_m);
        Self { center, radius_m: reaches.fold(0.0, f64::max) }
    }
}

/// A box along the base's axes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct AxisBox {
    low: Vector,
    high: Vector,
}

impl AxisBox {
    /// The smallest around a shape in the base frame.
    pub fn around(shape: &LinkShape) -> Self {
        match shape {
            LinkShape::Capsule { from_in_link, to_in_link, radius_m } => Self {
                low: from_in_link.coords.inf(&to_in_link.coords).add_scalar(-radius_m),
                high: from_in_link.coords.sup(&to_in_link.coords).add_scalar(*radius_m),
            },
            LinkShape::Cuboid { link_from_box, half_extents_m } => {
                let turned = link_from_box.rotation.to_rotation_matrix();
                Self::about(link_from_box, turned.matrix().abs() * half_extents_m)
            }
            LinkShape::Cylinder { link_from_cylinder, half_length_m, radius_m } => {
                let axis = link_from_cylinder.rotation * Vector::z();
                let half = axis.map(|along| {
                    along.abs() * half_length_m + radius_m * (1.0 - along * along).max(0.0).sqrt()
                });
                Self::about(link_from_cylinder, half)
            }
        }
    }

    fn about(pose: &Pose, half: Vector) -> Self {
        let center = pose.translation.vector;
        Self { low: center - half, high: center + half }
    }

    /// Distance of a point, metres; 0 inside.
    #[inline(always)]
    pub fn distance(&self, point: &Point) -> f64 {
        // Not `max` and `clamp`: those are calls where they are not inlined.
        let beyond = |low: f64, p: f64, high: f64| {
            let (under, over) = (low - p, p - high);
            let far = if under > over { under } else { over };
            if far > 0.0 { far } else { 0.0 }
        };
        let x = beyond(self.low.x, point.x, self.high.x);
        let y = beyond(self.low.y, point.y, self.high.y);
        let z = beyond(self.low.z, point.z, self.high.z);
        (x * x + y * y + z * z).sqrt()
    }
}

/// Many bodies of one link and what they must keep away from: one bound for all of them.
#[derive(Clone, Debug)]
pub(crate) struct Group {
    pub link: usize,
    /// Index of the fixed solid.
    pub fixed: usize,
    /// The pairs, all of one margin.
    pub pairs: Range<usize>,
    /// Around the bodies, in the link's frame.
    pub ball_in_link: Ball,
    pub margin_m: f64,
    /// Levers of a body on the ball's rim, or more.
    pub levers_m: Joints,
}

/// Least bodies of a group: for fewer its bound costs more than it saves.
pub(crate) const LEAST_OF_GROUP: usize = 4;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::motion::distance::shape_point;
    use crate::motion::shape::core;
    use proptest::prelude::*;

    fn shape() -> impl Strategy<Value = LinkShape> {
        let triple = || proptest::array::uniform3(-1.0..1.0f64);
        (0..3, triple(), triple(), proptest::array::uniform3(0.01..0.5f64)).prop_map(
            |(kind, at, turn, size)| {
                let pose = Pose::new(Vector::from(at), Vector::from(turn) * 3.0);
                match kind {
                    0 => LinkShape::capsule(at, turn, size[0]),
                    1 => LinkShape::Cuboid { link_from_box: pose, half_extents_m: Vector::from(size) },
                    _ => LinkShape::Cylinder {
                        link_from_cylinder: pose,
                        half_length_m: size[0],
                        radius_m: size[1],
                    },
                }
            },
        )
    }

    proptest! {
        #[test]
        fn balls_and_boxes_are_never_farther_than_the_solid_in_them(
            shape in shape(), p in proptest::array::uniform3(-3.0..3.0f64),
        ) {
            let point = Point::from(p);
            let solid_m = shape_point(&Pose::identity(), &shape, &point);
            let ball = Ball::around(&core(&shape));
            prop_assert!((ball.center - point).norm() - ball.radius_m <= solid_m + 1e-9);
            let boxed_m = AxisBox::around(&shape).distance(&point);
            prop_assert!(boxed_m <= solid_m.max(0.0) + 1e-9, "{boxed_m} {solid_m}");
            // No box is so large that it never tells anything.
            if solid_m > 3.0 {
                prop_assert!(boxed_m > 0.0);
            }
        }

        #[test]
        fn a_ball_around_balls_holds_them(
            centers in proptest::collection::vec(proptest::array::uniform3(-1.0..1.0f64), 1..6), radius in 0.0..0.3f64,
        ) {
            let balls: Vec<Ball> = centers.iter().map(|c| Ball { center: Point::from(*c), radius_m: radius }).collect();
            let around = Ball::around_all(balls.iter().copied());
            for ball in &balls {
                prop_assert!((ball.center - around.center).norm() + ball.radius_m <= around.radius_m + 1e-12);
            }
            prop_assert!(around.radius_m <= 1.8 + radius * 1.8);
        }
    }
}

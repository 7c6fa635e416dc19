//! How far joints can carry the points of a link: bounds for continuous collision checks.
//!
//! For joint `j` and a point on link `i >= j` the distance between the point
//! and the joint's axis never exceeds a lever that does not depend on the
//! joint state: choose one point on every axis; neighbouring ones sit on one
//! rigid link, so their distances are constants and add up. Moving the joints
//! by `dq` moves the point by at most `sum_j lever_j |dq_j|`, seen from any
//! link below the moved joints (move them one after another, the last first).

use super::broad::Ball;
use super::joints::{Joints, MAX_JOINTS, joints_from};
use super::shape::Core;
use crate::geometry::{Point, Pose, Vector};
use crate::robot::Kinematics;

/// An axis in the base frame at joint state zero.
struct Axis {
    through: Point,
    along: Vector,
}

/// Levers of one arm, built once for each cell.
pub(crate) struct Levers {
    axes: Vec<Axis>,
    zero_poses: Vec<Pose>,
}

impl Levers {
    pub fn new(kinematics: &dyn Kinematics) -> Self {
        let dof = kinematics.dof().min(MAX_JOINTS);
        let zero = joints_from(&[]);
        let zero_poses = kinematics.link_poses(&zero[..dof]);
        let axes = (0..dof)
            .map(|j| {
                // The axis is what a turn of the joint leaves in place; reading it off the
                // motion keeps this free of the arm's frame conventions.
                let mut turned = zero;
                turned[j] = 1.0;
                let after = kinematics.link_poses(&turned[..dof]);
                match (zero_poses.get(j + 1), after.get(j + 1)) {
                    (Some(before), Some(after)) => Axis {
                        through: Point::from(before.translation.vector),
                        along: (after.rotation * before.rotation.inverse()).scaled_axis().normalize(),
                    },
                    _ => Axis { through: Point::origin(), along: Vector::z() },
                }
            })
            .collect();
        Self { axes, zero_poses }
    }

    /// For each joint the lever of a shape on link `link`, metres; 0 for joints above it.
    pub fn of_shape(&self, link: usize, core_in_link: &Core) -> Joints {
        self.levers_and_reach(link, core_in_link).0
    }

    /// A ball in the base frame that a shape on link `link` never leaves.
    pub fn reach_of_shape(&self, link: usize, core_in_link: &Core) -> Ball {
        self.levers_and_reach(link, core_in_link).1
    }

    fn levers_and_reach(&self, link: usize, core_in_link: &Core) -> (Joints, Ball) {
        let mut levers = [0.0; MAX_JOINTS];
        let still = Ball::around(core_in_link);
        let Some(base_from_link) = self.zero_poses.get(link) else {
            return (levers, Ball { center: Point::origin(), radius_m: f64::INFINITY });
        };
        let ends = [base_from_link * core_in_link.a, base_from_link * core_in_link.b];
        let Some(last) = link.checked_sub(1) else {
            return (levers, Ball { center: base_from_link * still.center, ..still });
        };
        // From the last joint that moves the shape down to the base.
        let mut reference = Point::origin();
        let mut carried = 0.0;
        for j in (0..=last).rev() {
            let Some(axis) = self.axes.get(j) else { continue };
            if j == last {
                let off_axis = ends.map(|p| (p - axis.nearest(&p)).norm());
                levers[j] = off_axis[0].max(off_axis[1]) + core_in_link.radius_m;
                reference = axis.nearest(&nalgebra::center(&ends[0], &ends[1]));
                carried = ends.map(|p| (p - reference).norm()).into_iter().fold(0.0, f64::max);
                carried += core_in_link.radius_m;
            } else {
                let next = axis.nearest(&reference);
                levers[j] = (reference - next).norm() + carried;
                carried = levers[j];
                reference = next;
            }
        }
        // The first axis does not move: no joint carries the shape farther from this point of it.
        (levers, Ball { center: reference, radius_m: carried })
    }
}

impl Axis {
    fn nearest(&self, p: &Point) -> Point {
        self.through + self.along * (p - self.through).dot(&self.along)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robot::RobotModel;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn no_small_move_carries_a_link_farther_than_its_levers_say(
            q in proptest::array::uniform6(-3.1..3.1f64), d in proptest::array::uniform6(-0.3..0.3f64), link in 1usize..=6,
        ) {
            let arm = RobotModel::named("ur10e").unwrap().kinematics;
            let tip = Core { a: Point::new(0.0, 0.05, 0.1), b: Point::new(0.1, 0.0, -0.1), radius_m: 0.0 };
            let levers = Levers::new(arm.as_ref()).of_shape(link, &tip);
            let moved: Vec<f64> = q.iter().zip(&d).map(|(a, b)| a + b).collect();
            let (before, after) = (arm.link_poses(&q)[link], arm.link_poses(&moved)[link]);
            let bound: f64 = (0..6).map(|j| levers[j] * d[j].abs()).sum();
            let reach = Levers::new(arm.as_ref()).reach_of_shape(link, &tip);
            for p in [tip.a, tip.b] {
                prop_assert!((after * p - before * p).norm() <= bound + 1e-12);
                prop_assert!((before * p - reach.center).norm() <= reach.radius_m + 1e-12);
            }
        }
    }
}

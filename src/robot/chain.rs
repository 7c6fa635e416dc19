//! A serial chain of revolute joints: forward kinematics and Jacobian.

use nalgebra::{Matrix6xX, Quaternion, UnitQuaternion, Vector6};

use super::RobotError;
use crate::geometry::{Direction, Pose};

/// The largest number of moving joints of a chain.
pub const MAX_JOINTS: usize = 7;

/// One joint of a chain and the rigid piece before it.
#[derive(Debug, Clone, PartialEq)]
pub struct Segment {
    /// `previous_link_from_joint` with the joint at 0.
    pub previous_from_joint: Pose,
    /// The axis the joint turns about, in its own frame.
    pub axis_in_joint: Direction,
}

/// A serial chain: base, joints, flange.
///
/// `base_from_flange = prod_i(previous_from_joint_i * R(axis_i, q_i)) * last_link_from_flange`.
#[derive(Debug, Clone, PartialEq)]
pub struct Chain {
    segments: Vec<Segment>,
    last_link_from_flange: Pose,
}

impl Chain {
    /// A chain of 1 to [`MAX_JOINTS`] joints.
    pub fn new(segments: Vec<Segment>, last_link_from_flange: Pose) -> Result<Self, RobotError> {
        if segments.is_empty() || segments.len() > MAX_JOINTS {
            return Err(RobotError::JointCount { found: segments.len(), least: 1, most: MAX_JOINTS });
        }
        Ok(Self { segments, last_link_from_flange })
    }

    /// The number of joints.
    pub fn dof(&self) -> usize {
        self.segments.len()
    }

    /// The joints with the rigid pieces before them.
    pub fn segments(&self) -> &[Segment] {
        &self.segments
    }

    /// `last_link_from_flange`.
    pub fn last_link_from_flange(&self) -> &Pose {
        &self.last_link_from_flange
    }

    /// `base_from_flange`; missing joint values count as 0.
    pub fn forward(&self, joints_rad: &[f64]) -> Pose {
        let mut pose = Pose::identity();
        for (i, segment) in self.segments.iter().enumerate() {
            pose = segment.append(&pose, joints_rad.get(i).copied().unwrap_or(0.0));
        }
        pose * self.last_link_from_flange
    }

    /// `base_from_link` of the base and of each joint's link, into the cleared `poses`.
    pub fn link_poses_into(&self, joints_rad: &[f64], poses: &mut Vec<Pose>) {
        poses.clear();
        let mut pose = Pose::identity();
        poses.push(pose);
        for (i, segment) in self.segments.iter().enumerate() {
            pose = segment.append(&pose, joints_rad.get(i).copied().unwrap_or(0.0));
            poses.push(pose);
        }
    }

    /// `base_from_flange` and one Jacobian column a joint (`vx vy vz wx wy wz`
    /// at the flange's origin, base axes); columns past `dof()` are zero.
    /// Allocates nothing.
    pub fn forward_with_columns(&self, joints_rad: &[f64]) -> (Pose, [Vector6<f64>; MAX_JOINTS]) {
        let mut origins_and_axes = [Vector6::zeros(); MAX_JOINTS];
        let mut pose = Pose::identity();
        for (i, (segment, slot)) in self.segments.iter().zip(&mut origins_and_axes).enumerate() {
            pose = segment.append(&pose, joints_rad.get(i).copied().unwrap_or(0.0));
            slot.fixed_rows_mut::<3>(0).copy_from(&pose.translation.vector);
            slot.fixed_rows_mut::<3>(3).copy_from(&(pose.rotation * segment.axis_in_joint.into_inner()));
        }
        let flange = pose * self.last_link_from_flange;
        for column in origins_and_axes.iter_mut().take(self.segments.len()) {
            let axis = column.fixed_rows::<3>(3).into_owned();
            let lever = flange.translation.vector - column.fixed_rows::<3>(0);
            column.fixed_rows_mut::<3>(0).copy_from(&axis.cross(&lever));
        }
        (flange, origins_and_axes)
    }

    /// The geometric Jacobian, 6 x dof (see [`super::Kinematics::jacobian`]).
    pub fn jacobian(&self, joints_rad: &[f64]) -> Matrix6xX<f64> {
        let (_, columns) = self.forward_with_columns(joints_rad);
        Matrix6xX::from_fn(self.dof(), |r, c| columns.get(c).map_or(0.0, |column| column[r]))
    }

    /// An upper bound of the distance between the first joint's origin and the flange, metres.
    pub fn reach_bound_m(&self) -> f64 {
        let rigid = self.segments.iter().skip(1).map(|s| s.previous_from_joint.translation.vector.norm());
        rigid.sum::<f64>() + self.last_link_from_flange.translation.vector.norm()
    }
}

impl Segment {
    /// `base_from_link` after this joint at `angle_rad`, from `base_from_link` before it.
    fn append(&self, base_from_previous: &Pose, angle_rad: f64) -> Pose {
        let (sin, cos) = (0.5 * angle_rad).sin_cos();
        let axis = self.axis_in_joint.into_inner() * sin;
        let turn = UnitQuaternion::new_unchecked(Quaternion::from_parts(cos, axis));
        let mut pose = base_from_previous * self.previous_from_joint;
        pose.rotation *= turn;
        pose
    }
}

#[cfg(test)]
mod tests {
    use crate::robot::RobotModel;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn the_jacobian_is_the_derivative_of_forward_kinematics(q in proptest::array::uniform7(-2.0..2.0f64), joint in 0usize..7) {
            let robot = RobotModel::named("panda").unwrap();
            let chain = &robot.kinematics;
            let h = 1e-6;
            let (mut plus, mut minus) = (q, q);
            plus[joint] += h;
            minus[joint] -= h;
            let (a, b) = (chain.forward(&plus), chain.forward(&minus));
            let linear = (a.translation.vector - b.translation.vector) / (2.0 * h);
            let angular = (a.rotation * b.rotation.inverse()).scaled_axis() / (2.0 * h);
            let jacobian = chain.jacobian(&q);
            prop_assert!((jacobian.fixed_view::<3, 1>(0, joint) - linear).norm() < 1e-7);
            prop_assert!((jacobian.fixed_view::<3, 1>(3, joint) - angular).norm() < 1e-7);
        }
    }
}

//! Numeric inverse kinematics for chains without a closed form.

use nalgebra::Matrix6xX;

use super::{Chain, InverseFailure, InverseSolutions, Joint, Kinematics, RobotError, UnreachableReason};
use crate::geometry::Pose;

/// Kinematics of any chain: damped least squares from many starts.
#[derive(Debug, Clone)]
pub struct NumericKinematics {
    chain: Chain,
    joints: Vec<Joint>,
}

impl NumericKinematics {
    /// Kinematics of `chain` within the limits of `joints`, one a joint of the chain.
    pub fn new(chain: Chain, joints: Vec<Joint>) -> Result<Self, RobotError> {
        if joints.len() != chain.dof() {
            return Err(RobotError::StateLength { found: joints.len(), expected: chain.dof() });
        }
        Ok(Self { chain, joints })
    }
}

impl Kinematics for NumericKinematics {
    fn dof(&self) -> usize {
        self.chain.dof()
    }

    fn forward(&self, joints_rad: &[f64]) -> Pose {
        self.chain.forward(joints_rad)
    }

    fn link_poses_into(&self, joints_rad: &[f64], poses: &mut Vec<Pose>) {
        self.chain.link_poses_into(joints_rad, poses);
    }

    fn jacobian(&self, joints_rad: &[f64]) -> Matrix6xX<f64> {
        self.chain.jacobian(joints_rad)
    }

    fn inverse(&self, _base_from_flange: &Pose, _seeds: &[Vec<f64>]) -> InverseSolutions {
        InverseSolutions::failed(InverseFailure {
            nearest: self.joints.iter().map(Joint::middle_rad).collect(),
            position_residual_m: f64::INFINITY,
            rotation_residual_rad: f64::INFINITY,
            reason: UnreachableReason::NotFound { attempts: 0 },
        })
    }

    fn inverse_near(&self, base_from_flange: &Pose, previous: &[f64]) -> InverseSolutions {
        self.inverse(base_from_flange, &[previous.to_vec()])
    }
}

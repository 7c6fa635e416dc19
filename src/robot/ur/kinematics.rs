//! The UR arms' kinematics: closed form both ways.

use std::sync::Arc;

use nalgebra::Matrix6xX;

use super::UrParameters;
use super::inverse::{Branches, EXACT};
use crate::geometry::Pose;
use crate::robot::dh::chain_from_dh;
use crate::robot::numeric::{Bounds, descend};
use crate::robot::postures::{Postures, sort_by_move};
use crate::robot::{
    ArmStructure, Chain, DhConvention, InverseSolutions, Joint, Kinematics, MAX_JOINTS, RobotError, Solver,
};

/// Branches that miss by less than this may be polished, metres.
const POLISHABLE_M: f64 = 1e-6;

/// Angles tried for a free `q6`, evenly over the turn.
const FREE_WRIST_ANGLES: u32 = 36;

/// Kinematics of a UR arm.
#[derive(Debug, Clone)]
pub struct UrKinematics {
    parameters: UrParameters,
    chain: Chain,
    joints: Vec<Joint>,
}

impl UrKinematics {
    /// Kinematics within the limits of six joints.
    pub fn new(parameters: UrParameters, joints: Vec<Joint>) -> Result<Self, RobotError> {
        if joints.len() != 6 {
            return Err(RobotError::StateLength { found: joints.len(), expected: 6 });
        }
        let chain = chain_from_dh(&parameters.dh_rows(), DhConvention::Standard, &Pose::identity())?;
        Ok(Self { parameters, chain, joints })
    }

    /// The solutions near `seed`, or near the middle of the joints without one.
    fn solve(&self, base_from_flange: &Pose, seed: Option<&[f64]>) -> InverseSolutions {
        let mut start = [0.0; 6];
        for (slot, value) in start.iter_mut().zip(seed.unwrap_or_default()) {
            *slot = if value.is_finite() { *value } else { 0.0 };
        }
        let Some(branches) = self.parameters.branches(base_from_flange, &start) else {
            return InverseSolutions::not_finite();
        };
        let mut postures = Postures::new(&self.joints, seed);
        for branch in branches.exact() {
            postures.add(&branch.joints_rad);
        }
        if postures.is_empty() {
            self.polish(base_from_flange, &branches, &mut postures);
        }
        if postures.is_empty() && branches.has_free_wrist() {
            self.turn_free_wrist(base_from_flange, start, &mut postures);
        }
        postures.finish(|| branches.failure())
    }

    /// Where `q6` is free the seed's angle may put the elbow out of range; the
    /// first other angle that reaches, from the seed's outwards, is taken.
    fn turn_free_wrist(&self, base_from_flange: &Pose, mut seed: [f64; 6], postures: &mut Postures<'_>) {
        let middle = seed[5];
        for k in 1..=FREE_WRIST_ANGLES {
            let away = f64::from(k.div_ceil(2)) * std::f64::consts::TAU / f64::from(FREE_WRIST_ANGLES);
            seed[5] = if k % 2 == 0 { middle - away } else { middle + away };
            let Some(branches) = self.parameters.branches(base_from_flange, &seed) else { return };
            branches.exact().for_each(|branch| {
                postures.add(&branch.joints_rad);
            });
            if !postures.is_empty() {
                return;
            }
        }
    }

    /// Where two singularities meet, the closed form loses up to half of the
    /// digits. Branches that come that close get the rest from a few Newton steps.
    fn polish(&self, base_from_flange: &Pose, branches: &Branches, postures: &mut Postures<'_>) {
        for branch in branches.all().iter().filter(|b| b.position_residual_m < POLISHABLE_M) {
            let mut start = [0.0; MAX_JOINTS];
            start.iter_mut().zip(branch.joints_rad).for_each(|(slot, q)| *slot = q);
            let end = descend(&self.chain, Bounds::Free, base_from_flange, &start);
            if end.reaches(EXACT) {
                postures.add(&end.joints_rad);
            }
        }
    }
}

impl Kinematics for UrKinematics {
    fn dof(&self) -> usize {
        6
    }

    fn solver(&self) -> Solver {
        Solver { structure: ArmStructure::ThreeParallel, exact: true }
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

    fn with_joints(&self, joints: Vec<Joint>) -> Result<Arc<dyn Kinematics>, RobotError> {
        Ok(Arc::new(Self::new(self.parameters, joints)?))
    }

    fn inverse(&self, base_from_flange: &Pose, seeds: &[Vec<f64>]) -> InverseSolutions {
        self.solve(base_from_flange, seeds.first().map(Vec::as_slice))
    }

    fn inverse_near(&self, base_from_flange: &Pose, previous: &[f64]) -> InverseSolutions {
        let mut solutions = self.solve(base_from_flange, Some(previous));
        sort_by_move(&mut solutions.solutions, previous);
        solutions
    }
}

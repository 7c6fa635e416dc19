//! Kinematics of any chain: descents from many starts.

use std::f64::consts::TAU;
use std::sync::Arc;

use nalgebra::Matrix6xX;

use super::descent::{Bounds, Descent, descend};
use super::starts::start;
use crate::geometry::Pose;
use crate::robot::postures::{Postures, sort_by_move};
use crate::robot::ur::{Branches, UrShape};
use crate::robot::{
    ArmStructure, Chain, InverseFailure, InverseSolutions, Joint, Kinematics, MAX_JOINTS, ReachBound,
    RobotError, Solver, UnreachableReason,
};

/// Residual under which a state counts as a solution, metres and radians.
const REACHED: f64 = 1e-8;

/// Most starts of one search.
const MOST_STARTS: u32 = 96;

/// A search without any solution gives up after this many starts.
const HOPELESS_STARTS: u32 = 40;

/// A search ends when this many starts in a row found nothing new.
const IDLE_STARTS: u32 = 24;

/// A search ends with this many solutions.
const MOST_SOLUTIONS: usize = 16;

/// Starts without limits, to tell a limit from a reach that is too short.
const FREE_STARTS: u32 = 12;

/// States closer than this in every joint are one solution, radians.
const SAME: f64 = 1e-3;

/// As [`SAME`] for arms with a joint to spare, whose solutions form curves.
const SAME_REDUNDANT: f64 = 0.2;

/// Branches of the closed form that miss by more than this are no use as starts, metres.
const BRANCH_RESIDUAL_M: f64 = 0.05;

/// Kinematics of any chain: damped least squares from many starts.
///
/// The starts are fixed, so that the same call gives the same answer. It
/// finds most branches of a six-joint arm and a sample of a seven-joint
/// arm's, without proof of having all. A chain built like a UR arm, or nearly
/// so, starts from the closed form's branches and finds all of them.
#[derive(Debug, Clone)]
pub struct NumericKinematics {
    chain: Chain,
    joints: Vec<Joint>,
    /// The chain as a UR arm, whose branches are the best starts there are.
    ur: Option<UrShape>,
}

impl NumericKinematics {
    /// Kinematics of `chain` within the limits of `joints`, one a joint of the chain.
    pub fn new(chain: Chain, joints: Vec<Joint>) -> Result<Self, RobotError> {
        if joints.len() != chain.dof() {
            return Err(RobotError::StateLength { found: joints.len(), expected: chain.dof() });
        }
        let ur = UrShape::of(&chain);
        Ok(Self { chain, joints, ur })
    }

    /// Searches from `seeds`, then from the fixed starts; `enough` solutions end it.
    fn search(&self, target: &Pose, seeds: &[&[f64]], enough: usize) -> InverseSolutions {
        let finite =
            target.rotation.coords.iter().chain(target.translation.vector.iter()).all(|v| v.is_finite());
        let rotation = nalgebra::UnitQuaternion::new_normalize(*target.rotation.quaternion());
        if !finite || !rotation.coords.iter().all(|v| v.is_finite()) {
            return InverseSolutions::not_finite();
        }
        let target = Pose::from_parts(target.translation, rotation);
        let seeds: Vec<[f64; MAX_JOINTS]> = seeds.iter().map(|seed| self.within_limits(seed)).collect();
        let mut postures = Postures::new(&self.joints, seeds.first().map(<[f64; MAX_JOINTS]>::as_slice));
        if let Some(ur) = &self.ur {
            let branches = self.search_branches(ur, &target, seeds.first(), &mut postures);
            let complete = |b: &Branches| ur.is_exact() && !b.has_free_wrist();
            if let Some(branches) = branches.filter(|b| !postures.within().is_empty() || complete(b)) {
                return postures.finish(|| self.branch_miss(ur, &branches));
            }
        }
        if let Some(failure) = self.beyond_reach(&target, seeds.first()) {
            return InverseSolutions::failed(failure);
        }
        let mut nearest: Option<Descent> = None;
        let (mut idle, mut attempts) = (0, 0);
        for from in seeds.iter().copied().chain((0..MOST_STARTS).map(|i| start(&self.joints, i))) {
            attempts += 1;
            idle += 1;
            let end = descend(&self.chain, Bounds::Limits(&self.joints), &target, &from);
            if end.reaches(REACHED) {
                let state = self.cut(&end);
                if !postures.within().iter().any(|known| self.same(known, state)) && postures.add(state) {
                    idle = 0;
                }
            } else if nearest.is_none_or(|n| end.miss() < n.miss()) {
                nearest = Some(end);
            }
            let found = postures.within().len();
            let patience = if found == 0 { HOPELESS_STARTS } else { IDLE_STARTS };
            if found >= enough || idle >= patience {
                break;
            }
        }
        if postures.within().is_empty() {
            self.search_beyond_limits(&target, &mut postures);
        }
        postures.finish(|| self.miss(nearest, attempts))
    }

    /// Where a descent from `start_rad` within the limits ends, if that is at the target.
    pub(in crate::robot) fn descend_from(
        &self,
        base_from_flange: &Pose,
        start_rad: &[f64],
    ) -> Option<Vec<f64>> {
        let rotation = nalgebra::UnitQuaternion::new_normalize(*base_from_flange.rotation.quaternion());
        let target = Pose::from_parts(base_from_flange.translation, rotation);
        let from = self.within_limits(start_rad);
        let end = descend(&self.chain, Bounds::Limits(&self.joints), &target, &from);
        // A target that is not finite is not reached: the residual is no number.
        end.reaches(REACHED).then(|| self.cut(&end).to_vec())
    }

    /// The failure of a target that was missed in `attempts`, with the best that a descent
    /// from `start` finds.
    pub(in crate::robot) fn miss_from(
        &self,
        target: &Pose,
        start: Option<&[f64; MAX_JOINTS]>,
        attempts: usize,
    ) -> InverseSolutions {
        let from = start.map(|start| self.within_limits(start));
        if let Some(failure) = self.beyond_reach(target, from.as_ref()) {
            return InverseSolutions::failed(failure);
        }
        let end = from.map(|from| descend(&self.chain, Bounds::Limits(&self.joints), target, &from));
        InverseSolutions::failed(self.miss(end, attempts))
    }

    /// Descends from the closed form's branches. On an exact UR chain that ends
    /// where it starts; on a calibrated one a few steps away.
    fn search_branches(
        &self,
        ur: &UrShape,
        target: &Pose,
        seed: Option<&[f64; MAX_JOINTS]>,
        postures: &mut Postures<'_>,
    ) -> Option<Branches> {
        let branches = ur.branches(target, seed.map(<[f64; MAX_JOINTS]>::as_slice).unwrap_or_default())?;
        let mut found: Vec<[f64; MAX_JOINTS]> = Vec::with_capacity(branches.all().len());
        for branch in branches.all().iter().filter(|b| b.position_residual_m < BRANCH_RESIDUAL_M) {
            let mut from = [0.0; MAX_JOINTS];
            from.iter_mut().zip(ur.joints_rad(&branch.joints_rad)).for_each(|(slot, q)| *slot = q);
            let end = descend(&self.chain, Bounds::Free, target, &from);
            if end.reaches(REACHED) && !found.iter().any(|known| self.same(known, &end.joints_rad)) {
                found.push(end.joints_rad);
                postures.add(self.cut(&end));
            }
        }
        Some(branches)
    }

    /// The failure of a target that no branch of an exact UR chain reaches.
    fn branch_miss(&self, ur: &UrShape, branches: &Branches) -> InverseFailure {
        let mut failure = branches.failure();
        failure.nearest = ur.joints_rad(&branches.nearest().joints_rad).to_vec();
        failure
    }

    /// Solutions of the same chain without limits, to name the limit in the way.
    fn search_beyond_limits(&self, target: &Pose, postures: &mut Postures<'_>) {
        for i in 0..FREE_STARTS {
            let end = descend(&self.chain, Bounds::Free, target, &start(&self.joints, i));
            if end.reaches(REACHED) {
                postures.add(self.cut(&end));
            }
        }
    }

    fn miss(&self, nearest: Option<Descent>, attempts: usize) -> InverseFailure {
        let reason = UnreachableReason::NotFound { attempts };
        match nearest {
            Some(end) => InverseFailure {
                nearest: self.cut(&end).to_vec(),
                position_residual_m: end.position_residual_m,
                rotation_residual_rad: end.rotation_residual_rad,
                reason,
            },
            None => InverseFailure {
                nearest: self.joints.iter().map(Joint::middle_rad).collect(),
                position_residual_m: f64::INFINITY,
                rotation_residual_rad: f64::INFINITY,
                reason,
            },
        }
    }

    /// The failure of a target farther away than all links laid end to end.
    fn beyond_reach(&self, target: &Pose, seed: Option<&[f64; MAX_JOINTS]>) -> Option<InverseFailure> {
        let first = self.chain.segments().first()?.previous_from_joint.translation.vector;
        let beyond_m = (target.translation.vector - first).norm() - self.chain.reach_bound_m();
        if beyond_m <= REACHED {
            return None;
        }
        let from = seed.copied().unwrap_or_else(|| start(&self.joints, 0));
        let end = descend(&self.chain, Bounds::Limits(&self.joints), target, &from);
        let mut failure = self.miss(Some(end), 1);
        failure.reason = UnreachableReason::OutOfReach { beyond_m, bound: ReachBound::TooFar };
        Some(failure)
    }

    fn cut<'a>(&self, end: &'a Descent) -> &'a [f64] {
        end.joints_rad.get(..self.joints.len()).unwrap_or(&end.joints_rad)
    }

    fn within_limits(&self, seed: &[f64]) -> [f64; MAX_JOINTS] {
        let mut state = [0.0; MAX_JOINTS];
        for (i, (slot, joint)) in state.iter_mut().zip(&self.joints).enumerate() {
            let value = seed.get(i).copied().filter(|q| q.is_finite()).unwrap_or_else(|| joint.middle_rad());
            *slot = value.max(joint.lower_rad).min(joint.upper_rad);
        }
        state
    }

    fn same(&self, a: &[f64], b: &[f64]) -> bool {
        let near = if self.joints.len() > 6 { SAME_REDUNDANT } else { SAME };
        a.iter().zip(b).all(|(x, y)| ((x - y) - ((x - y) / TAU).round() * TAU).abs() < near)
    }
}

impl Kinematics for NumericKinematics {
    fn dof(&self) -> usize {
        self.chain.dof()
    }

    fn solver(&self) -> Solver {
        match &self.ur {
            Some(ur) => Solver { structure: ArmStructure::ThreeParallel, exact: ur.is_exact() },
            None => Solver { structure: ArmStructure::General, exact: false },
        }
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
        Ok(Arc::new(Self::new(self.chain.clone(), joints)?))
    }

    fn inverse(&self, base_from_flange: &Pose, seeds: &[Vec<f64>]) -> InverseSolutions {
        let seeds: Vec<&[f64]> = seeds.iter().map(Vec::as_slice).collect();
        self.search(base_from_flange, &seeds, MOST_SOLUTIONS)
    }

    fn inverse_near(&self, base_from_flange: &Pose, previous: &[f64]) -> InverseSolutions {
        let mut answer = self.search(base_from_flange, &[previous], 1);
        sort_by_move(&mut answer.solutions, previous);
        answer
    }

    fn inverse_from(&self, base_from_flange: &Pose, previous: &[f64]) -> Option<Vec<f64>> {
        self.descend_from(base_from_flange, previous)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robot::{DhConvention, DhRow, RobotModel};
    use proptest::prelude::*;

    /// A built-in arm solved by descents alone.
    fn descended(name: &str) -> RobotModel {
        let mut robot = RobotModel::named(name).unwrap();
        let chain = robot.dh.as_ref().unwrap().chain().unwrap();
        robot.kinematics = Arc::new(NumericKinematics::new(chain, robot.joints.clone()).unwrap());
        robot
    }

    fn check_all(robot: &RobotModel, target: &Pose, answer: &InverseSolutions) {
        for state in &answer.solutions {
            let reached = robot.kinematics.forward(state);
            assert!((reached.translation.vector - target.translation.vector).norm() < 1e-7);
            assert!(reached.rotation.angle_to(&target.rotation) < 1e-6);
            assert!(robot.joints.iter().zip(state).all(|(joint, q)| joint.contains(*q)));
        }
        assert_eq!(answer.failure.is_some(), answer.solutions.is_empty());
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(60))]

        #[test]
        fn the_panda_reaches_what_it_reached_before(share in proptest::array::uniform7(0.03..0.97f64)) {
            let robot = descended("panda");
            let q: Vec<f64> = robot.joints.iter().zip(share)
                .map(|(j, s)| j.lower_rad + s * (j.upper_rad - j.lower_rad)).collect();
            let target = robot.kinematics.forward(&q);
            let answer = robot.kinematics.inverse(&target, &[]);
            check_all(&robot, &target, &answer);
            prop_assert!(!answer.solutions.is_empty(), "{:?}", answer.failure);
            let near = robot.kinematics.inverse_near(&target, &q);
            prop_assert!(near.solutions[0].iter().zip(&q).all(|(a, b)| (a - b).abs() < 1e-6));
        }

        #[test]
        fn a_bent_ur_from_its_table_reaches_what_it_reached_before(q in proptest::array::uniform6(-2.9..2.9f64)) {
            // Twists and offsets a little off, as calibration finds them: no closed form.
            let rows = [
                DhRow::new(0.0002, 1.5711, 0.1623, 0.01),
                DhRow::new(-0.4252, 0.0012, 0.0, -0.002),
                DhRow::new(-0.3919, -0.0009, 0.0, 0.003),
                DhRow::new(0.0001, 1.5699, 0.1331, 0.0),
                DhRow::new(-0.0001, -1.5702, 0.0998, 0.001),
                DhRow::new(0.0, 0.0, 0.0995, 0.0),
            ];
            let robot = RobotModel::from_dh(&rows, DhConvention::Standard).unwrap();
            let target = robot.kinematics.forward(&q);
            let answer = robot.kinematics.inverse(&target, &[]);
            check_all(&robot, &target, &answer);
            prop_assert!(!answer.solutions.is_empty(), "{:?}", answer.failure);
            prop_assert_eq!(&answer, &robot.kinematics.inverse(&target, &[]));
        }

        #[test]
        fn no_pose_makes_it_panic(x in proptest::array::uniform7(proptest::num::f64::ANY)) {
            let rotation = nalgebra::UnitQuaternion::new_unchecked(nalgebra::Quaternion::new(x[0], x[1], x[2], x[3]));
            let pose = Pose::from_parts(nalgebra::Translation3::new(x[4], x[5], x[6]), rotation);
            let robot = descended("panda");
            let answer = robot.kinematics.inverse_near(&pose, &x);
            prop_assert_eq!(answer.failure.is_some(), answer.solutions.is_empty());
        }
    }

    #[test]
    fn an_arm_with_a_joint_to_spare_gives_several_solutions() {
        let robot = descended("panda");
        let target = robot.kinematics.forward(&[0.2, -0.5, 0.1, -2.0, 0.1, 1.6, 0.5]);
        assert!(robot.kinematics.inverse(&target, &[]).solutions.len() >= 8);
    }

    #[test]
    fn a_pose_beyond_the_panda_says_by_how_much() {
        let robot = descended("panda");
        let failure = robot.kinematics.inverse(&Pose::translation(5.0, 0.0, 0.333), &[]).failure.unwrap();
        let UnreachableReason::OutOfReach { beyond_m, .. } = failure.reason else { panic!("{failure:?}") };
        assert!(beyond_m > 3.5 && beyond_m <= failure.position_residual_m, "{failure:?}");
    }

    #[test]
    fn a_limit_in_the_way_is_named() {
        let mut rows = [
            DhRow::new(0.0, TAU / 4.0, 0.16, 0.0),
            DhRow::new(-0.42, 0.0, 0.0, 0.0),
            DhRow::new(-0.39, 0.0, 0.0, 0.0),
            DhRow::new(0.05, TAU / 4.0, 0.13, 0.0),
            DhRow::new(0.0, -TAU / 4.0, 0.1, 0.0),
            DhRow::new(0.0, 0.0, 0.1, 0.0),
        ];
        let free = RobotModel::from_dh(&rows, DhConvention::Standard).unwrap();
        let target = free.kinematics.forward(&[0.5, -1.0, 1.0, -0.5, 1.0, 2.0]);
        // None of the branches of this pose turns the first joint this little.
        (rows[0].lower_rad, rows[0].upper_rad) = (Some(-0.01), Some(0.01));
        let tight = RobotModel::from_dh(&rows, DhConvention::Standard).unwrap();
        let failure = tight.kinematics.inverse(&target, &[]).failure.unwrap();
        let UnreachableReason::JointLimit { joint, value_rad, .. } = failure.reason else {
            panic!("{failure:?}")
        };
        assert_eq!(joint, "joint_1");
        assert!(value_rad.abs() > 0.01);
    }
}

//! What every arm can do: forward and inverse kinematics.

use std::sync::Arc;

use nalgebra::Matrix6xX;

use super::{ArmStructure, InverseSolutions, Joint, RobotError, Solver};
use crate::geometry::Pose;

/// Kinematics of a serial arm with revolute joints.
///
/// Joint angles are in radians, in the order of the model's joints. A slice
/// that is too short is read as if padded with zeros, a longer one is cut:
/// callers check lengths where input enters ([`super::clamp_start`]).
pub trait Kinematics: std::fmt::Debug + Send + Sync {
    /// The number of joints.
    fn dof(&self) -> usize;

    /// Whether [`Kinematics::inverse`] is a formula of microseconds rather than a search.
    fn is_closed_form(&self) -> bool {
        let solver = self.solver();
        solver.exact && matches!(solver.structure, ArmStructure::ThreeParallel | ArmStructure::SphericalWrist)
    }

    /// How its inverse kinematics works.
    fn solver(&self) -> Solver;

    /// `base_from_flange` at `joints_rad`.
    fn forward(&self, joints_rad: &[f64]) -> Pose;

    /// `base_from_link` of every link frame, appended to the cleared `poses`:
    /// first the base itself (identity), then one frame a joint, fixed to the
    /// link that the joint moves, its origin on the joint's axis. `dof() + 1`
    /// poses, in the order of the model's links.
    fn link_poses_into(&self, joints_rad: &[f64], poses: &mut Vec<Pose>);

    /// [`Kinematics::link_poses_into`] into a new vector.
    fn link_poses(&self, joints_rad: &[f64]) -> Vec<Pose> {
        let mut poses = Vec::with_capacity(self.dof() + 1);
        self.link_poses_into(joints_rad, &mut poses);
        poses
    }

    /// The geometric Jacobian at the flange's origin, in base axes: 6 x dof,
    /// rows vx vy vz (m/s) and wx wy wz (rad/s) for 1 rad/s of each joint.
    fn jacobian(&self, joints_rad: &[f64]) -> Matrix6xX<f64>;

    /// The same arm with other joint limits; one joint each, else an error.
    fn with_joints(&self, joints: Vec<Joint>) -> Result<Arc<dyn Kinematics>, RobotError>;

    /// All joint states found that put the flange at `base_from_flange`.
    ///
    /// Each is within the joint limits and checked by forward kinematics; an
    /// angle that fits more than once is given once (see [`super::all_wraps`]),
    /// nearest to the first seed, or to the middle of the joint's range
    /// without a seed. Analytic arms find every branch; numeric ones start
    /// from the seeds and from a fixed sequence of states, so that the same
    /// call always gives the same answer. At a singularity the free joint
    /// takes the seed's angle.
    fn inverse(&self, base_from_flange: &Pose, seeds: &[Vec<f64>]) -> InverseSolutions;

    /// As [`Kinematics::inverse`], each angle wrapped as near to `previous`
    /// as the limits allow, and the solutions sorted by their largest joint
    /// move from there. A numeric arm tries `previous` first and searches
    /// further only if that fails.
    fn inverse_near(&self, base_from_flange: &Pose, previous: &[f64]) -> InverseSolutions;

    /// The joint state for `base_from_flange` that lies next to `previous`, if one is found from there
    /// without a search: what a pose near to one that was reached costs least.
    fn inverse_from(&self, base_from_flange: &Pose, previous: &[f64]) -> Option<Vec<f64>> {
        self.inverse_near(base_from_flange, previous).solutions.into_iter().next()
    }
}

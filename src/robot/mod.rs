//! The arm: models, kinematics and limits. It knows nothing of cells, cameras or paths.
//!
//! A [`RobotModel`] is a serial chain of revolute joints with its limits, its
//! links as simple shapes and the sources of its numbers. Its [`Kinematics`]
//! map joint angles to `base_from_flange` and back.

mod axis;
pub mod bounds;
mod braking;
mod chain;
mod described;
mod dh;
mod error;
mod franka;
mod geometric;
mod inverse;
mod joint;
mod kinematics;
mod limits;
mod link;
mod mesh;
mod model;
mod numeric;
mod override_limits;
mod postures;
mod solver;
mod source;
mod ur;
mod urdf;
mod warning;
mod wraps;
mod xarm;

pub use chain::{Chain, MAX_JOINTS, Segment};
pub use dh::{DhConvention, DhRow, DhTable};
pub use error::RobotError;
pub use inverse::{InverseFailure, InverseSolutions, ReachBound, UnreachableReason};
pub use joint::Joint;
pub use kinematics::Kinematics;
pub use limits::{ClampedJoint, START_TOLERANCE_RAD, clamp_start, limit_violation};
pub use link::{Link, LinkShape};
pub use model::{Meshes, RobotModel};
pub use numeric::NumericKinematics;
pub use override_limits::JointLimits;
pub use solver::{ArmStructure, Solver};
pub use source::{NumberGroup, Source};
pub use ur::{Branch, Branches, UrKinematics, UrParameters};
pub use warning::RobotWarning;
pub use wraps::{all_wraps, nearest_wrap};

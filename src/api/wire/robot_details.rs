//! `GET /v1/robots/{model}`: every number of a robot with its source.

use serde::Serialize;
use utoipa::ToSchema;

use super::{DhConventionJson, PoseJson};

/// A robot of the catalogue with its numbers.
#[derive(Clone, Debug, Serialize, ToSchema)]
pub struct RobotDetails {
    /// The name to give as `robot.model`.
    pub model: String,
    /// The frame in which `object` and all poses are given.
    pub base_frame: String,
    /// The frame that carries the camera.
    pub flange_frame: String,
    /// How its inverse kinematics works.
    pub solver: SolverJson,
    /// Joint names, base to flange.
    pub joint_names: Vec<String>,
    /// Limits, in the order of `joint_names`.
    pub limits: Vec<JointLimitJson>,
    /// Lengths, twists and offsets.
    pub kinematics: KinematicsJson,
    /// Base and moving links with the shapes that collision checks use.
    pub links: Vec<LinkJson>,
    /// Where each group of numbers comes from.
    pub sources: Vec<SourceJson>,
}

/// How a robot's inverse kinematics works.
#[derive(Clone, Debug, Serialize, ToSchema)]
#[schema(as = Solver)]
pub struct SolverJson {
    /// `three_parallel`, `spherical_wrist`, `offset_wrist`, `spare_joint` or `numeric`; with the ending
    /// `_refined` for an arm that is only nearly so built.
    pub name: String,
    /// For people.
    pub description: String,
}

/// Limits of one joint.
#[derive(Clone, Debug, Serialize, ToSchema)]
pub struct JointLimitJson {
    /// Smallest angle, rad.
    pub min: f64,
    /// Largest angle, rad.
    pub max: f64,
    /// Speed limit, rad/s.
    pub max_speed: f64,
    /// Acceleration limit, rad/s2 (assumed where the maker publishes none).
    pub max_acceleration: f64,
    /// Jerk limit, rad/s3; absent where there is none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub max_jerk: Option<f64>,
}

/// A robot's Denavit-Hartenberg table.
#[derive(Clone, Debug, Serialize, ToSchema)]
#[schema(as = RobotKinematics)]
pub struct KinematicsJson {
    /// The convention of `dh`.
    pub convention: DhConventionJson,
    /// Rows, base to last joint.
    pub dh: Vec<KinematicsRowJson>,
    /// The flange in the last row's frame.
    pub last_from_flange: PoseJson,
}

/// A row of the table: metres and radians.
#[derive(Clone, Debug, Serialize, ToSchema)]
#[schema(as = RobotKinematicsRow)]
pub struct KinematicsRowJson {
    /// Link offset d, m.
    pub d: f64,
    /// Link length a, m.
    pub a: f64,
    /// Link twist, rad.
    pub alpha: f64,
    /// Offset added to the joint angle, rad.
    pub theta: f64,
}

/// A link: the base, or the piece that a joint moves.
#[derive(Clone, Debug, Serialize, ToSchema)]
#[schema(as = RobotLink)]
pub struct LinkJson {
    /// Its name.
    pub name: String,
    /// The joint that moves it; absent for the base.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub joint: Option<String>,
    /// Its shapes, in the frame that sits on its joint's axis before the row's `d` (for the base: the
    /// base frame).
    pub shapes: Vec<LinkShapeJson>,
}

/// A convex shape in a link's frame, metres.
#[derive(Clone, Debug, Serialize, ToSchema)]
#[serde(tag = "kind", rename_all = "snake_case")]
#[schema(as = RobotLinkShape)]
pub enum LinkShapeJson {
    /// All points within `radius` of a segment.
    Capsule {
        /// One end of the segment.
        from: [f64; 3],
        /// The other end.
        to: [f64; 3],
        /// The radius.
        radius: f64,
    },
    /// A box about its pose.
    Box {
        /// The box's frame.
        pose: PoseJson,
        /// Edge lengths.
        size: [f64; 3],
    },
    /// A cylinder along its pose's z axis.
    Cylinder {
        /// The cylinder's frame, at its middle.
        pose: PoseJson,
        /// Its length.
        length: f64,
        /// The radius.
        radius: f64,
    },
}

/// Where a group of numbers comes from.
#[derive(Clone, Debug, Serialize, ToSchema)]
#[schema(as = RobotSource)]
pub struct SourceJson {
    /// `kinematics`, `position_limits`, `speed_limits`, `acceleration_limits` or `link_shapes`.
    pub group: String,
    /// The document, or that and why the numbers are assumed.
    pub source: String,
}

//! The service's JSON, member by member: names, units and defaults as documented in OpenAPI.
//!
//! Requests refuse unknown members.

mod camera;
mod cell;
mod check;
mod execution;
mod limits;
mod object;
mod plan_answer;
mod plan_request;
mod pose;
mod prediction;
mod reachability;
mod robot;
mod robot_details;
mod view_space;
mod whole;

pub use camera::CameraJson;
pub use cell::{BoxJson, CapsuleJson, CylinderJson, KeepOutJson, SolidJson, SphereJson, TimingJson};
pub use check::{CheckAnswer, CheckedJson, CheckedPlanJson, ClearanceJson, CreateCheck, ViolationJson};
pub use execution::{
    BackgroundJson, CreateExecution, ExecutionImages, ExecutionJson, ExecutionList, ExecutionObject,
    ExecutionStateJson, JointsJson, ObjectSummary, ProgressJson,
};
pub use limits::{JointLimitsJson, LimitsJson};
pub use object::{ObjectJson, ObjectShapeJson};
pub use plan_answer::{
    CoverageJson, CoverageReportJson, MotionFiguresJson, MotionTimeJson, PlanAnswer, PlanList, PlannedView,
    SkipReason, TrajectoryJson, TrajectoryPointJson, ViewCountJson, ViewStatusJson, WarningJson,
};
pub use plan_request::{InitialViewsJson, ObjectiveJson, PlanRequestJson, RollJson, UnreachableViewsJson};
pub use pose::PoseJson;
pub use prediction::{ExpectedPose, PredictionAnswer, PredictionRequest};
pub use reachability::{BandPart, PlaceJson, ReachabilityAnswer};
pub use robot::{DhConventionJson, DhRowJson, RobotJson, RobotSummary};
pub use robot_details::{
    JointLimitJson, KinematicsJson, KinematicsRowJson, LinkJson, LinkShapeJson, RobotDetails, SolverJson,
    SourceJson,
};
pub use view_space::{ViewSpaceAnswer, ViewSpaceJson, ViewSpaceView};

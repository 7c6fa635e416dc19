//! From a request to a plan: how many views, where, in which order, along which motion.
//!
//! The pipeline of the paper (its section on the system): prediction of the number of views,
//! Tammes set, poses, global path; with an arm, joint motion through the poses. No HTTP and no
//! JSON here. Errors name the member to blame in the words of the request (`object.radius`).

mod adapt_views;
mod answer;
mod arm_path;
mod asks;
pub mod bounds;
mod check;
mod error;
mod free_path;
mod hand_eye;
mod keep_out;
mod make_plan;
mod photo_content;
mod photos;
mod predict_count;
mod random_cell;
mod reachability;
mod replaced;
mod request;
mod skip_reason;
mod surroundings;
mod survey;
mod trajectory;
mod verify;
mod view_poses;
mod work_bound;

#[cfg(test)]
mod tests;

pub use answer::{
    CameraPath, Coverage, CoverageReport, ExpectedView, MotionFigures, MotionTime, Plan, PlanView, Reason,
    ViewCount, ViewStatus, Warning,
};
pub use check::{check, length};
pub use error::{FieldValue, PlanError};
pub use make_plan::{make_plan, make_plan_until};
pub use photo_content::{blank_images, unlike_training};
pub use photos::{MAX_PHOTOS, expected_views};
pub use predict_count::predict_count;
pub use random_cell::{RandomCells, RandomOutcome};
pub use reachability::{Place, Reachability, reachability, reachability_until};
pub use request::{Arm, ObjectSphere, PlanRequest, UnreachableViews, ViewShell, ViewSource};
pub use surroundings::{Surroundings, cell, check_solid};
pub use trajectory::{Trajectory, TrajectoryPoint};
pub use verify::{ClaimedPlan, Finding, PlanVerdict, verify, verify_until};

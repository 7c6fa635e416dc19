//! Wire types to domain types and back: the one place that knows both.

mod answer;
mod camera;
mod canonical;
mod cell;
mod check;
mod images;
mod limits;
mod object;
mod pose;
mod reachability;
mod request;
mod robot;
mod robot_details;
mod solid;

pub use answer::{coverage_json, expected_views, plan_answer, timings_json, trajectory, warnings_json};
pub use camera::{camera, camera_json};
pub use canonical::{canonical, identity};
pub use cell::{surroundings, timing};
pub use check::{MOST_OF_POINT, MOST_POINTS, check_answer, claimed_plan};
pub use images::{MAX_IMAGE_PIXELS, base64_bytes, images};
pub use limits::limited_robot;
pub use object::object;
pub use pose::{FARTHEST_M, NORM_TOLERANCE, pose, pose_json};
pub use reachability::{reachability_answer, reachability_request};
pub use request::{plan_request, prediction_request, shell};
pub use robot::{robot, robot_summaries};
pub use robot_details::robot_details;
pub use solid::LONGEST_NAME;

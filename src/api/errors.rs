//! Every library error as a problem: the one place where errors get codes and statuses.

use axum::http::StatusCode;
use serde_json::Value;

use super::problem::Problem;
use crate::imaging::{CameraError, DecodeError};
use crate::motion::MotionError;
use crate::order::OrderError;
use crate::plan::{FieldValue, PlanError};
use crate::predict::PredictError;
use crate::robot::RobotError;
use crate::simulate::SimulateError;
use crate::views::ViewsError;

impl From<FieldValue> for Value {
    fn from(value: FieldValue) -> Self {
        match value {
            FieldValue::Missing => Value::Null,
            FieldValue::Number(number) => json_number(number),
            FieldValue::Numbers(numbers) => numbers.into_iter().map(json_number).collect(),
            FieldValue::Text(text) => text.into(),
        }
    }
}

/// Beyond this a joint angle looks like degrees, radians: two turns.
const NO_RADIANS: f64 = 4.0 * std::f64::consts::PI;

/// JSON knows no NaN: it is named as a text.
fn json_number(number: f64) -> Value {
    serde_json::Number::from_f64(number).map_or_else(|| number.to_string().into(), Value::Number)
}

impl From<PlanError> for Problem {
    fn from(error: PlanError) -> Self {
        match error {
            PlanError::Invalid { code, field, value, bound } => Problem::field(code, field, value, bound),
            PlanError::Camera(error) => error.into(),
            PlanError::Views(error) => error.into(),
            PlanError::Order(error) => error.into(),
            PlanError::Robot(error) => error.into(),
            PlanError::Motion(error) => error.into(),
            PlanError::Predict(error) => error.into(),
            PlanError::NoPredictor { cause } => Problem::unavailable("prediction_unavailable", cause, None)
                .at("images", Value::Null, "left out: give view_count instead"),
        }
    }
}

impl From<CameraError> for Problem {
    fn from(error: CameraError) -> Self {
        let CameraError::OutOfRange { field, value, bound } = error;
        let path = match ["k1", "k2", "p1", "p2", "k3"].iter().position(|name| *name == field) {
            Some(index) => format!("camera.distortion[{index}]"),
            None => format!("camera.{field}"),
        };
        Problem::field("out_of_range", path, json_number(value), bound)
    }
}

impl From<ViewsError> for Problem {
    fn from(error: ViewsError) -> Self {
        match error {
            ViewsError::Count { count, min, max } => {
                Problem::field("out_of_range", "view_count", count, format!("from {min} to {max}"))
            }
            ViewsError::Elevation { field, value_deg } => {
                let field = format!("view_space.{field}_deg");
                Problem::field("out_of_range", field, json_number(value_deg), "from -90 to 90 degrees")
            }
            ViewsError::EmptyBand { min_deg, max_deg } => Problem::field(
                "out_of_range",
                "view_space.max_elevation_deg",
                json_number(max_deg),
                format!("at least view_space.min_elevation_deg, {min_deg} degrees"),
            ),
            ViewsError::Radius { value_m } => Problem::field(
                "out_of_range",
                "view_space.radius",
                json_number(value_m),
                "positive and finite",
            ),
        }
    }
}

impl From<OrderError> for Problem {
    fn from(error: OrderError) -> Self {
        // The request's check leaves no such points; what comes here anyway is about its geometry.
        Problem::new(StatusCode::UNPROCESSABLE_ENTITY, "order", error.to_string()).at(
            "view_space",
            Value::Null,
            error.to_string(),
        )
    }
}

impl From<RobotError> for Problem {
    fn from(error: RobotError) -> Self {
        let text = error.to_string();
        match error {
            RobotError::UnknownModel { name, known } => {
                Problem::field("unknown_robot", "robot.model", name, format!("one of {known}"))
            }
            RobotError::JointCount { found, least, most } => {
                Problem::field("joint_count", "robot", found, format!("{least} to {most} moving joints"))
            }
            // Of URDF alone: a DH table's numbers are named by their rows.
            RobotError::OutOfRange { joint, field, value, least, most, hint } => Problem::field(
                "out_of_range",
                "robot.urdf",
                json_number(value),
                format!("within [{least:.4}, {most:.4}] as joint {joint}'s {field}{hint}"),
            ),
            RobotError::DhRow { row, field, value, least, most, hint } => Problem::field(
                "out_of_range",
                format!("robot.dh[{row}].{field}"),
                json_number(value),
                format!("within [{least:.4}, {most:.4}]{hint}"),
            ),
            RobotError::UnknownJoint { name, known } => {
                Problem::field("unknown_joint", format!("limits.{name}"), name, format!("one of {known}"))
            }
            RobotError::Limit { joint, field, value, bound } => {
                Problem::field("out_of_range", format!("limits.{joint}.{field}"), json_number(value), bound)
            }
            RobotError::StateLength { found, expected } => {
                Problem::field("joint_count", "start", found, format!("{expected} joint angles"))
            }
            RobotError::BeyondLimit { index, joint, value_rad, bound_rad } => {
                let side = if value_rad < bound_rad { "at least" } else { "at most" };
                let hint = match value_rad.abs() > NO_RADIANS {
                    true => format!(" (degrees? {value_rad} degrees are {:.4} rad)", value_rad.to_radians()),
                    false => String::new(),
                };
                Problem::field(
                    "joint_limit",
                    format!("start[{index}]"),
                    json_number(value_rad),
                    format!("{side} {bound_rad:.4} rad, the limit of {joint}{hint}"),
                )
            }
            RobotError::Urdf(reason) => Problem::new(StatusCode::UNPROCESSABLE_ENTITY, "urdf", text).at(
                "robot.urdf",
                reason,
                "a URDF of one serial arm",
            ),
            RobotError::UrdfElement { kind: "mesh", name, problem } => Problem::new(
                StatusCode::UNPROCESSABLE_ENTITY,
                "urdf",
                text,
            )
            .at(format!("robot.meshes.{name}"), "a file", format!("a mesh: {problem}")),
            RobotError::UrdfElement { kind, name, problem } => Problem::new(
                StatusCode::UNPROCESSABLE_ENTITY,
                "urdf",
                text,
            )
            .at("robot.urdf", format!("{kind} {name}"), problem),
        }
    }
}

impl From<MotionError> for Problem {
    fn from(error: MotionError) -> Self {
        let text = error.to_string();
        match error {
            MotionError::Start(error) => error.into(),
            MotionError::JointCount { found, most } => {
                Problem::field("joint_count", "robot", found, format!("1 to {most} joints"))
            }
            MotionError::JointLimits { joint } => Problem::field(
                "joint_limits",
                format!("robot.{joint}"),
                Value::Null,
                "limits in order, speed and acceleration finite and above 0",
            ),
            MotionError::NotFinite { field } => {
                Problem::field("not_finite", field, Value::Null, "finite, sizes at least 0")
            }
            MotionError::OutOfRange { field, value, least, most } => {
                Problem::field("out_of_range", field, json_number(value), format!("within [{least}, {most}]"))
            }
            MotionError::StartCollides { first, second, depth_m } => {
                let value = format!("{first} and {second} overlap by {depth_m:.4} m");
                Problem::field("start_collides", "start", value, "free of collisions")
            }
            MotionError::TooManyPoints { most, duration_s, sample_period_s, speed_scale, least_period_s } => {
                let too_long = Problem::new(StatusCode::UNPROCESSABLE_ENTITY, "trajectory_too_long", text);
                match least_period_s {
                    Some(least_s) => too_long.at(
                        "timing.sample_period",
                        json_number(sample_period_s),
                        format!("at least {least_s:.3} s: a plan has at most {most} points and this one moves for {duration_s:.1} s"),
                    ),
                    None => too_long.at(
                        "timing.speed_scale",
                        json_number(speed_scale),
                        format!("larger, as the limits of the joints' speeds: at most {most} points a second apart are planned, and this motion takes {duration_s:.0} s"),
                    ),
                }
            }
            MotionError::BadOrder { .. } => Problem::internal(text),
            MotionError::Stopped => Problem::unavailable("stopped", text, Some(5)),
        }
    }
}

impl From<PredictError> for Problem {
    fn from(error: PredictError) -> Self {
        let text = error.to_string();
        match error {
            PredictError::Runtime { .. }
            | PredictError::NoModel
            | PredictError::Model { .. }
            | PredictError::ModelFile { .. }
            | PredictError::Session { .. } => Problem::unavailable("prediction_unavailable", text, None).at(
                "images",
                Value::Null,
                "left out: give view_count instead",
            ),
            PredictError::ImageCount { count, max } => {
                Problem::field("image_count", "images", count, format!("1 to {max} images"))
            }
            PredictError::ImageSize { index, width, height, camera_width, camera_height } => Problem::field(
                "image_size",
                format!("images[{index}]"),
                format!("{width}x{height} pixels"),
                format!("{camera_width}x{camera_height} pixels"),
            ),
            PredictError::Camera { source, .. } => source.into(),
            PredictError::Center { index, field, value, bound } => Problem::field(
                "object_out_of_view",
                format!("image_poses[{index}]"),
                format!("the object's centre in the camera frame has {field} {value}"),
                bound,
            ),
        }
    }
}

/// A photo or mesh texture that cannot be decoded, as the member `field`.
pub fn decode_problem(field: &str, error: &DecodeError) -> Problem {
    let text = format!("{field}: {error}");
    let problem = |code: &str| Problem::new(StatusCode::UNPROCESSABLE_ENTITY, code, text.clone());
    match error {
        DecodeError::Empty => problem("not_an_image").at(field, "0 bytes", "a PNG or JPEG file"),
        DecodeError::UnknownFormat { bytes, start } => {
            problem("not_an_image").at(field, format!("{bytes} bytes starting {start}"), "a PNG or JPEG file")
        }
        DecodeError::TooLarge { width, height, pixels, max_pixels } => problem("too_many_pixels").at(
            field,
            format!("{width}x{height} = {pixels} pixels"),
            format!("at most {max_pixels} pixels"),
        ),
        DecodeError::Broken { format, reason } => {
            problem("broken_image").at(field, reason.clone(), format!("a whole {format} file"))
        }
    }
}

impl From<SimulateError> for Problem {
    fn from(error: SimulateError) -> Self {
        let text = error.to_string();
        match error {
            SimulateError::SpeedFactor { value, least, most } => Problem::field(
                "out_of_range",
                "speed_factor",
                json_number(value),
                format!("from {least} to {most}"),
            ),
            SimulateError::NoViews => Problem::new(
                StatusCode::UNPROCESSABLE_ENTITY,
                "nothing_to_execute",
                text,
            )
            .at("plan_id", Value::Null, "a plan with at least one planned view"),
            SimulateError::Trajectory { .. } | SimulateError::Write { .. } => Problem::internal(text),
        }
    }
}

/// A file that could not be read or written.
impl From<std::io::Error> for Problem {
    fn from(error: std::io::Error) -> Self {
        Problem::new(
            StatusCode::INTERNAL_SERVER_ERROR,
            "storage",
            format!("the data directory fails: {error}"),
        )
    }
}

//! Which member is bounded by which constants.

use crate::api::convert::{FARTHEST_M as FARTHEST_POSE_M, LONGEST_NAME, NORM_TOLERANCE};
use crate::api::convert::{MOST_OF_POINT, MOST_POINTS};
use crate::imaging::Camera;
use crate::motion::{Roll, Timing};
use crate::plan::MAX_PHOTOS;
use crate::plan::bounds::{
    FARTHEST_M, LARGEST_MARGIN_M, LARGEST_YAW_RAD, MAX_KEEP_OUT, MAX_SOLIDS, MOST_ROWS_AND_COLUMNS,
    OBJECT_RADIUS_M, SHELL_RADIUS_M, SMALLEST_SHAPE_M, SMALLEST_SOLID_M, SOLID_IN_CELL_M,
};
use crate::robot::bounds::{
    DH_LONGEST_M, DH_WIDEST_RAD, JERKS, JOINTS, LIMIT_WIDEST_RAD, LONGEST_URDF_BYTES, RATES,
};
use crate::simulate::{MAX_SPEED_FACTOR, MIN_SPEED_FACTOR};
use crate::views::{Band, MAX_VIEWS};

/// What a member must be.
pub(super) enum Bound {
    /// A number from one to another.
    Within(f64, f64),
    /// A number between two that it must not be itself.
    Between(f64, f64),
    /// A number above another.
    Above(f64),
    /// A list of so many items at least and at most.
    Items(usize, usize),
    /// A text of so many characters at least and at most.
    Length(usize, usize),
}

use Bound::{Above, Between, Items, Length, Within};

/// Schema, member and its bound.
type Row = (&'static str, &'static str, Bound);

/// The bounds of request bodies.
pub(super) fn schemas() -> Vec<Row> {
    [request(), view_space(), object(), solids(), robot(), camera_and_poses(), others()]
        .into_iter()
        .flatten()
        .collect()
}

/// Path, parameter and its bound.
pub(super) fn parameters() -> Vec<Row> {
    let (rows, columns) = MOST_ROWS_AND_COLUMNS;
    vec![
        ("/v1/view-spaces/{n}", "n", Within(1.0, MAX_VIEWS as f64)),
        ("/v1/view-spaces/{n}", "min_elevation_deg", within(Band::STEEPEST_DEG)),
        ("/v1/view-spaces/{n}", "max_elevation_deg", within(Band::STEEPEST_DEG)),
        ("/v1/view-spaces/{n}", "radius", Above(0.0)),
        ("/v1/reachability", "elevations", Within(1.0, rows as f64)),
        ("/v1/reachability", "azimuths", Within(1.0, columns as f64)),
    ]
}

/// A number of at most this size.
fn within(most: f64) -> Bound {
    Within(-most, most)
}

fn pair((least, most): (f64, f64)) -> Bound {
    Within(least, most)
}

fn range(range: std::ops::RangeInclusive<f64>) -> Bound {
    Within(*range.start(), *range.end())
}

fn request() -> Vec<Row> {
    vec![
        ("PlanRequest", "images", Items(1, MAX_PHOTOS)),
        ("PlanRequest", "view_count", Within(1.0, MAX_VIEWS as f64)),
        ("PlanRequest", "start", Items(*JOINTS.start(), *JOINTS.end())),
        ("PlanRequest", "keep_out", Items(0, MAX_KEEP_OUT)),
        ("PlanRequest", "camera_body", Items(0, MAX_SOLIDS)),
        ("PlanRequest", "tool", Items(0, MAX_SOLIDS)),
        ("PlanRequest", "margin", Within(0.0, LARGEST_MARGIN_M)),
        ("PlanRequest", "roll_samples", Within(1.0, Roll::MOST_SAMPLES as f64)),
        ("Timing", "speed_scale", pair(Timing::SPEED_SCALE)),
        ("Timing", "settle", pair(Timing::SETTLE_S)),
        ("Timing", "sample_period", pair(Timing::SAMPLE_PERIOD_S)),
    ]
}

fn view_space() -> Vec<Row> {
    vec![
        ("ViewSpace", "radius", pair(SHELL_RADIUS_M)),
        ("ViewSpace", "min_elevation_deg", within(Band::STEEPEST_DEG)),
        ("ViewSpace", "max_elevation_deg", within(Band::STEEPEST_DEG)),
    ]
}

fn object() -> Vec<Row> {
    // A shape stays within its sphere.
    let largest_m = 2.0 * OBJECT_RADIUS_M.1;
    vec![
        ("Object", "center", Items(3, 3)),
        ("Object", "center[]", within(FARTHEST_M)),
        ("Object", "radius", pair(OBJECT_RADIUS_M)),
        ("Object", "table_z", within(FARTHEST_M)),
        ("ObjectShape", "cylinder.radius", Within(SMALLEST_SHAPE_M, largest_m)),
        ("ObjectShape", "cylinder.height", Within(SMALLEST_SHAPE_M, largest_m)),
        ("ObjectShape", "box.size", Items(3, 3)),
        ("ObjectShape", "box.size[]", Within(SMALLEST_SHAPE_M, largest_m)),
        ("ObjectShape", "box.yaw", within(LARGEST_YAW_RAD)),
    ]
}

fn solids() -> Vec<Row> {
    // Those on the flange have less room: SOLID_ON_FLANGE_M.
    let (farthest_m, largest_m) = SOLID_IN_CELL_M;
    let points = [
        ("Box", "center", "center[]"),
        ("Sphere", "center", "center[]"),
        ("Capsule", "from", "from[]"),
        ("Capsule", "to", "to[]"),
        ("Cylinder", "center", "center[]"),
    ];
    let sizes = [
        ("Box", "size[]"),
        ("Sphere", "radius"),
        ("Capsule", "radius"),
        ("Cylinder", "radius"),
        ("Cylinder", "height"),
    ];
    let mut rows = vec![("KeepOut", "name", Length(1, LONGEST_NAME)), ("Box", "size", Items(3, 3))];
    for (schema, point, coordinate) in points {
        rows.push((schema, point, Items(3, 3)));
        rows.push((schema, coordinate, within(farthest_m)));
    }
    rows.extend(sizes.map(|(schema, size)| (schema, size, Within(SMALLEST_SOLID_M, largest_m))));
    rows.extend(["Box", "Cylinder"].into_iter().flat_map(orientation));
    rows
}

/// Of a quaternion of norm 1.
fn orientation(schema: &'static str) -> [Row; 2] {
    [(schema, "orientation", Items(4, 4)), (schema, "orientation[]", within(1.0 + NORM_TOLERANCE))]
}

fn robot() -> Vec<Row> {
    vec![
        ("Robot", "dh", Items(*JOINTS.start(), *JOINTS.end())),
        // A text of so many bytes has no more characters.
        ("Robot", "urdf", Length(0, LONGEST_URDF_BYTES)),
        ("DhRow", "d", within(DH_LONGEST_M)),
        ("DhRow", "a", within(DH_LONGEST_M)),
        ("DhRow", "alpha", within(DH_WIDEST_RAD)),
        ("DhRow", "theta", within(DH_WIDEST_RAD)),
        ("DhRow", "min", within(LIMIT_WIDEST_RAD)),
        ("DhRow", "max", within(LIMIT_WIDEST_RAD)),
        ("DhRow", "max_speed", range(RATES)),
        ("DhRow", "max_acceleration", range(RATES)),
        ("JointLimits", "max_speed", range(RATES)),
        ("JointLimits", "max_acceleration", range(RATES)),
        ("JointLimits", "max_jerk", range(JERKS)),
    ]
}

fn camera_and_poses() -> Vec<Row> {
    let (least_px, most_px) = Camera::SIDE_PX;
    let side = || Within(f64::from(least_px), f64::from(most_px));
    let point = || Between(-Camera::FARTHEST_PX, Camera::FARTHEST_PX);
    let mut rows = vec![
        ("Camera", "width", side()),
        ("Camera", "height", side()),
        ("Camera", "fx", Between(0.0, Camera::FARTHEST_PX)),
        ("Camera", "fy", Between(0.0, Camera::FARTHEST_PX)),
        ("Camera", "cx", point()),
        ("Camera", "cy", point()),
        ("Camera", "distortion", Items(5, 5)),
        ("Camera", "distortion[]", Between(-Camera::LARGEST_DISTORTION, Camera::LARGEST_DISTORTION)),
        ("Pose", "position", Items(3, 3)),
        ("Pose", "position[]", within(FARTHEST_POSE_M)),
    ];
    rows.extend(orientation("Pose"));
    rows
}

fn others() -> Vec<Row> {
    let [angle, speed, acceleration, time] = MOST_OF_POINT;
    vec![
        ("PredictionRequest", "images", Items(1, MAX_PHOTOS)),
        ("PredictionRequest", "image_poses", Items(1, MAX_PHOTOS)),
        ("CreateExecution", "speed_factor", Within(MIN_SPEED_FACTOR, MAX_SPEED_FACTOR)),
        ("CheckedPlan", "views", Items(1, MAX_VIEWS)),
        ("CheckedPlan", "order", Items(0, MAX_VIEWS)),
        ("Trajectory", "points", Items(0, MOST_POINTS)),
        ("TrajectoryPoint", "positions[]", within(angle)),
        ("TrajectoryPoint", "velocities[]", within(speed)),
        ("TrajectoryPoint", "accelerations[]", within(acceleration)),
        ("TrajectoryPoint", "time_from_start", within(time)),
    ]
}

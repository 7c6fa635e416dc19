//! The cell: an arm, the camera on its flange, the object, the table, keep-out boxes.

use nalgebra::{Translation3, UnitQuaternion};

use super::error::MotionError;
use super::joints::MAX_JOINTS;
use super::object::CellObject;
use super::shape::{is_sound, pose_is_finite};
use crate::geometry::{Point, Pose, Vector};
use crate::robot::{LinkShape, RobotModel};

/// Farthest from the base that anything in a cell may lie, metres; more looks like millimetres.
pub const LARGEST_LENGTH_M: f64 = 100.0;

/// A region that nothing of the arm may enter.
#[derive(Clone, Debug, PartialEq)]
pub struct KeepOut {
    /// Name used in reasons.
    pub name: String,
    /// The region, in the base frame.
    pub shape_in_base: LinkShape,
}

/// An arm in its surroundings. All frames are relative to the arm's base.
#[derive(Clone, Debug)]
pub struct Cell {
    /// The arm.
    pub robot: RobotModel,
    /// Hand-eye calibration: camera axes (OpenCV) in the flange frame.
    pub flange_from_camera: Pose,
    /// Solids fixed to the camera, in the camera frame (see [`d435_body`]).
    pub camera_body: Vec<LinkShape>,
    /// Solids fixed to the flange beside the camera, in the flange frame.
    pub tool: Vec<LinkShape>,
    /// The object, if there is one.
    pub object: Option<CellObject>,
    /// Height of the table's top in the base frame, metres; it fills everything below.
    /// The base and the link that turns on it are exempt.
    pub table_z_m: Option<f64>,
    /// Regions nothing that moves may enter; the base may stand in them.
    pub keep_out: Vec<KeepOut>,
    /// Clearance kept from object, table and keep-out regions, metres.
    pub margin_m: f64,
    /// Clearance kept between parts of the arm, metres. Smaller, since link
    /// shapes already hold more than the links.
    pub self_margin_m: f64,
}

impl Cell {
    /// Default of [`Cell::margin_m`].
    pub const DEFAULT_MARGIN_M: f64 = 0.01;
    /// Default of [`Cell::self_margin_m`].
    pub const DEFAULT_SELF_MARGIN_M: f64 = 0.002;

    /// A cell with the default camera body and its mount, default margins, and nothing in it.
    pub fn new(robot: RobotModel, flange_from_camera: Pose) -> Self {
        let camera_body = default_camera_body(&flange_from_camera);
        Self {
            robot,
            flange_from_camera,
            camera_body,
            tool: Vec::new(),
            object: None,
            table_z_m: None,
            keep_out: Vec::new(),
            margin_m: Self::DEFAULT_MARGIN_M,
            self_margin_m: Self::DEFAULT_SELF_MARGIN_M,
        }
    }

    /// Checks every number: finite, sizes not negative, lengths below [`LARGEST_LENGTH_M`].
    pub fn validate(&self) -> Result<(), MotionError> {
        let dof = self.robot.kinematics.dof();
        if dof == 0 || dof > MAX_JOINTS || self.robot.joints.len() != dof {
            return Err(MotionError::JointCount { found: dof, most: MAX_JOINTS });
        }
        for joint in &self.robot.joints {
            let limits = [joint.max_speed_rad_per_s, joint.max_acceleration_rad_per_s2];
            if !limits.iter().all(|v| v.is_finite() && *v > 0.0)
                || joint.lower_rad.partial_cmp(&joint.upper_rad).is_none_or(|o| o.is_gt())
            {
                return Err(MotionError::JointLimits { joint: joint.name.clone() });
            }
        }
        if !pose_is_finite(&self.flange_from_camera) {
            return Err(MotionError::NotFinite { field: "flange_from_camera".into() });
        }
        within("flange_from_camera.position", self.flange_from_camera.translation.vector.norm(), 0.0)?;
        if let Some(object) = &self.object {
            within("object.center", object.center_in_base.coords.norm(), 0.0)?;
            within("object.radius", object.radius_m, 0.0)?;
            if !is_sound(&object.solid_in_base()) {
                return Err(MotionError::NotFinite { field: "object.shape".into() });
            }
        }
        if let Some(z) = self.table_z_m {
            within("object.table_z", z, -LARGEST_LENGTH_M)?;
        }
        within("margin", self.margin_m, 0.0)?;
        within("self_margin", self.self_margin_m, 0.0)?;
        for (name, solids) in [("camera_body", &self.camera_body), ("tool", &self.tool)] {
            if let Some(i) = solids.iter().position(|shape| !is_sound(shape)) {
                return Err(MotionError::NotFinite { field: format!("{name}[{i}]") });
            }
        }
        for (i, region) in self.keep_out.iter().enumerate() {
            if !is_sound(&region.shape_in_base) {
                return Err(MotionError::NotFinite { field: format!("keep_out[{i}]") });
            }
        }
        Ok(())
    }
}

/// The body of a RealSense D435, 90 x 25 x 25 mm, in the frame of its colour
/// camera: the lens sits 32.5 mm from the middle of the body and 4 mm behind
/// its front (maker's drawing; sizes from the data sheet, section "Camera System Mechanicals").
pub fn d435_body() -> LinkShape {
    LinkShape::Cuboid {
        link_from_box: Pose::from_parts(Translation3::new(0.0325, 0.0, -0.0085), UnitQuaternion::identity()),
        half_extents_m: Vector::new(0.045, 0.0125, 0.0125),
    }
}

/// [`d435_body`] and a bracket of 40 mm diameter from the flange to its back, in the camera frame.
pub fn default_camera_body(flange_from_camera: &Pose) -> Vec<LinkShape> {
    let flange_in_camera = flange_from_camera.inverse() * Point::origin();
    let back_in_camera = Point::new(0.0, 0.0, -0.0085);
    let mut shapes = vec![d435_body()];
    let bracket = back_in_camera - flange_in_camera;
    // The bracket ends before the lens: its round end must not look over the camera's front.
    let radius_m = 0.02;
    if bracket.norm() > radius_m {
        let end = back_in_camera - bracket.normalize() * radius_m;
        shapes.push(LinkShape::Capsule { from_in_link: flange_in_camera, to_in_link: end, radius_m });
    }
    shapes
}

fn within(field: &str, value: f64, least: f64) -> Result<(), MotionError> {
    // A NaN is in no range.
    if (least..=LARGEST_LENGTH_M).contains(&value) {
        return Ok(());
    }
    Err(MotionError::OutOfRange { field: field.into(), value, least, most: LARGEST_LENGTH_M })
}

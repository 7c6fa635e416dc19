//! What to plan.

use image::RgbaImage;

use super::Surroundings;
use crate::geometry::{Point, Pose};
use crate::imaging::Camera;
use crate::motion::{ObjectShape, Objective, Roll, Timing};
use crate::robot::RobotModel;
use crate::views::{Band, ViewSpace};

/// Where the number of views comes from.
#[derive(Clone, Debug)]
pub enum ViewSource {
    /// Predicted from photos taken at the initial views.
    Photos(Vec<RgbaImage>),
    /// Given, 1 to 200.
    Count(usize),
    /// No Tammes set: the initial views themselves, three (`false`) or five (`true`).
    Initial {
        /// Top, left, front, right and back instead of top, left and front.
        five: bool,
    },
}

/// The sphere that encloses the object, and its table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ObjectSphere {
    /// Centre, metres.
    pub center_in_base: Point,
    /// Radius, metres.
    pub radius_m: f64,
    /// Height of the table's surface in the base frame, metres.
    pub table_z_m: Option<f64>,
    /// What of the sphere the object fills, for the arm's collisions; views and the camera's path
    /// go by the sphere.
    pub shape: ObjectShape,
}

/// The shell of views about the object's centre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ViewShell {
    /// Distance from the object's centre to a camera, metres.
    pub radius_m: f64,
    /// Elevations of the views.
    pub band: Band,
}

/// What becomes of views of a set that the arm cannot reach.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum UnreachableViews {
    /// The set is spread again over the part of the band that can be reached.
    #[default]
    Replace,
    /// They are left out, with their reasons.
    Skip,
}

/// The arm that carries the camera.
#[derive(Clone, Debug)]
pub struct Arm {
    /// Which arm.
    pub model: RobotModel,
    /// Hand-eye calibration; `None` for the assumed mount.
    pub flange_from_camera: Option<Pose>,
    /// Joint angles to start from, radians.
    pub start_rad: Option<Vec<f64>>,
    /// Whether views may turn about their optical axes.
    pub roll: Roll,
    /// What its motion is made for.
    pub objective: Objective,
    /// What becomes of views of a set that it cannot reach.
    pub unreachable_views: UnreachableViews,
    /// What stands around it and hangs on its flange.
    pub surroundings: Surroundings,
    /// How its motion is timed.
    pub timing: Timing,
}

/// A request with all its defaults filled in.
#[derive(Clone, Debug)]
pub struct PlanRequest {
    /// How many views.
    pub source: ViewSource,
    /// `base_from_camera` of each photo, when known.
    pub photo_poses: Option<Vec<Pose>>,
    /// The camera; `None` for the assumed one.
    pub camera: Option<Camera>,
    /// The object; `None` for the assumed one.
    pub object: Option<ObjectSphere>,
    /// The shell of views.
    pub shell: ViewShell,
    /// The arm; without it, poses and order only.
    pub arm: Option<Arm>,
}

impl ObjectSphere {
    /// What a request without robot and photos gets when it names no object.
    pub const ASSUMED: ObjectSphere = ObjectSphere {
        center_in_base: Point::new(0.0, 0.0, 0.0),
        radius_m: 0.1,
        table_z_m: None,
        shape: ObjectShape::Sphere,
    };
}

impl PlanRequest {
    /// The camera used.
    pub fn camera(&self) -> Camera {
        self.camera.unwrap_or(Camera::REALSENSE_D435)
    }

    /// The object used.
    pub fn object(&self) -> ObjectSphere {
        self.object.unwrap_or(ObjectSphere::ASSUMED)
    }

    /// The shell about the object.
    pub fn view_space(&self) -> ViewSpace {
        ViewSpace {
            center_in_base: self.object().center_in_base,
            radius_m: self.shell.radius_m,
            band: self.shell.band,
        }
    }
}

impl Arm {
    /// `model` with every default of a request: camera on the assumed mount, no start, level
    /// horizons, nothing around but object and table.
    pub fn new(model: RobotModel) -> Self {
        Self {
            model,
            flange_from_camera: None,
            start_rad: None,
            roll: Roll::Fixed,
            objective: Objective::default(),
            unreachable_views: UnreachableViews::default(),
            surroundings: Surroundings::default(),
            timing: Timing::default(),
        }
    }

    /// Where the camera is assumed to sit: 0.05 m in front of the flange, looking along its z axis.
    pub fn assumed_mount() -> Pose {
        Pose::translation(0.0, 0.0, 0.05)
    }

    /// The hand-eye calibration used.
    pub fn mount(&self) -> Pose {
        self.flange_from_camera.unwrap_or_else(Self::assumed_mount)
    }
}

//! Which camera poses an arm can take in its cell, one by one: no way between them is planned.

use std::f64::consts::TAU;

use super::candidates::{candidates, rolled, within_limits};
use super::cell::Cell;
use super::error::MotionError;
use super::plan::SkipReason;
use super::request::Roll;
use super::scene::{Placement, Scene};
use super::shape::pose_is_finite;
use crate::geometry::{Pose, Vector};

/// A cell prepared to be asked for poses. Shared between threads; each asks through its own [`Probe`].
pub struct Reach<'a> {
    scene: Scene<'a>,
    rolls_rad: Vec<f64>,
    seeds: Vec<Vec<f64>>,
    /// Rolling the camera only turns the last joint, all the way round: where no joint state takes a
    /// pose, none takes it rolled.
    last_joint_rolls: bool,
}

/// Asks a [`Reach`] for one pose after the other.
pub struct Probe<'r> {
    reach: &'r Reach<'r>,
    placement: Placement,
}

impl<'a> Reach<'a> {
    /// Prepares `cell` for poses with this freedom of roll. `start_rad` is the plan's start state, if
    /// it has one: numeric arms search from there too.
    ///
    /// # Errors
    /// Numbers of the cell that are out of range; a start that does not fit the arm.
    pub fn new(cell: &'a Cell, roll: Roll, start_rad: Option<&[f64]>) -> Result<Self, MotionError> {
        cell.validate()?;
        let seeds = match start_rad {
            Some(given) => vec![cell.robot.clamp_start(given)?.0],
            None => Vec::new(),
        };
        let last_joint_rolls = last_joint_rolls(cell);
        Ok(Self { scene: Scene::new(cell), rolls_rad: roll.rolls_rad(), seeds, last_joint_rolls })
    }

    /// Whether a question takes microseconds, not milliseconds.
    pub fn is_quick(&self) -> bool {
        self.scene.cell.robot.kinematics.is_closed_form()
    }

    /// Someone to ask.
    pub fn probe(&self) -> Probe<'_> {
        Probe { reach: self, placement: Placement::default() }
    }
}

impl Probe<'_> {
    /// Whether a collision-free joint state within the limits takes the pose `base_from_camera`
    /// (OpenCV axes) at one of the rolls. Stops at the first: microseconds for an arm with closed
    /// kinematics where there is one, all rolls and branches where there is none.
    pub fn reaches(&mut self, base_from_camera: &Pose) -> bool {
        let Reach { scene, rolls_rad, seeds, last_joint_rolls } = self.reach;
        if !pose_is_finite(base_from_camera) {
            return false;
        }
        let camera_from_flange = scene.cell.flange_from_camera.inverse();
        for roll_rad in rolls_rad {
            let base_from_flange = rolled(base_from_camera, *roll_rad) * camera_from_flange;
            let answer = scene.cell.robot.kinematics.inverse(&base_from_flange, seeds);
            let mut states = answer.solutions.iter().filter_map(|state| within_limits(scene, state).ok());
            if states.any(|joints| scene.is_free(&joints, &mut self.placement)) {
                return true;
            }
            if answer.solutions.is_empty() && *last_joint_rolls {
                return false;
            }
        }
        false
    }

    /// Why the pose cannot be taken, exactly as a plan would say; `None` where it can.
    pub fn reason(&mut self, base_from_camera: &Pose) -> Option<SkipReason> {
        if self.reaches(base_from_camera) {
            return None;
        }
        let Reach { scene, rolls_rad, seeds, .. } = self.reach;
        candidates(scene, base_from_camera, rolls_rad, seeds, &mut self.placement).err()
    }
}

/// Whether the optical axis is the last joint's axis, and that joint turns all the way.
fn last_joint_rolls(cell: &Cell) -> bool {
    let Some(joint) = cell.robot.joints.last() else { return false };
    let camera = |last_rad: f64| {
        let mut state = vec![0.3; cell.robot.joints.len()];
        if let Some(last) = state.last_mut() {
            *last = last_rad;
        }
        cell.robot.kinematics.forward(&state) * cell.flange_from_camera
    };
    let (first, turned) = (camera(0.0), camera(1.0));
    let stays = (first.translation.vector - turned.translation.vector).norm() < 1e-9;
    let axes = [first, turned].map(|pose| pose.rotation * Vector::z());
    stays && (axes[0] - axes[1]).norm() < 1e-9 && joint.upper_rad - joint.lower_rad >= TAU
}

//! Which camera poses an arm can take in its cell, one by one: no way between them is planned.

use super::candidates::{candidates, rolled, within_limits};
use super::cell::Cell;
use super::error::MotionError;
use super::plan::SkipReason;
use super::request::Roll;
use super::scene::{Placement, Scene};
use super::shape::pose_is_finite;
use super::work::{Allowance, Work, cost};
use crate::geometry::Pose;

/// A cell prepared to be asked for poses. Shared between threads; each asks through its own [`Probe`].
pub struct Reach<'a> {
    scene: Scene<'a>,
    rolls_rad: Vec<f64>,
    seeds: Vec<Vec<f64>>,
}

/// A joint state that takes a pose.
#[derive(Clone, Debug, PartialEq)]
pub struct KnownState {
    /// Joint angles, radians.
    pub joints_rad: Vec<f64>,
    /// Turn of the camera about its optical axis against the pose, radians.
    pub roll_rad: f64,
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
        Ok(Self { scene: Scene::new(cell), rolls_rad: roll.rolls_rad(), seeds })
    }

    /// Whether a question takes microseconds, not milliseconds.
    pub fn is_quick(&self) -> bool {
        self.scene.cell.robot.kinematics.is_closed_form()
    }

    /// The same questions in `cell`, which differs from this one in its object alone.
    ///
    /// # Errors
    /// Numbers of the cell that are out of range.
    pub fn with_object_of<'b>(&self, cell: &'b Cell) -> Result<Reach<'b>, MotionError> {
        cell.validate()?;
        Ok(Reach {
            scene: self.scene.with_object_of(cell),
            rolls_rad: self.rolls_rad.clone(),
            seeds: self.seeds.clone(),
        })
    }

    /// Someone to ask, for as much work as `allowance` has.
    pub fn probe(&self, allowance: &Allowance) -> Probe<'_> {
        Probe { reach: self, placement: Placement::new(Work::new(allowance)) }
    }

    /// The most work that a question takes where nothing is near, about: all rolls, eight states
    /// each, no distance but bounds.
    pub fn usual_work(&self) -> u64 {
        let state = cost::PLACE * 12 + cost::BOUND * self.scene.pairs().len() as u64;
        self.rolls_rad.len() as u64 * (self.scene.inverse_cost + 8 * state)
    }
}

impl Probe<'_> {
    /// Work done so far.
    pub fn spent(&self) -> u64 {
        self.placement.work.spent()
    }

    /// Whether there is none left: then every answer is no.
    pub fn is_over(&self) -> bool {
        self.placement.work.is_over()
    }

    /// A new question, for as much work as `allowance` has.
    pub fn begin(&mut self, allowance: &Allowance) {
        self.placement.work = Work::new(allowance);
    }

    /// Whether a collision-free joint state within the limits takes the pose `base_from_camera`
    /// (OpenCV axes) at one of the rolls. Stops at the first: microseconds for an arm with closed
    /// kinematics where there is one, all rolls and branches where there is none.
    pub fn reaches(&mut self, base_from_camera: &Pose) -> bool {
        self.state(base_from_camera).is_some()
    }

    /// The state that [`Probe::reaches`] finds first.
    pub fn state(&mut self, base_from_camera: &Pose) -> Option<KnownState> {
        let Reach { scene, rolls_rad, seeds } = self.reach;
        if !pose_is_finite(base_from_camera) {
            return None;
        }
        let camera_from_flange = scene.cell.flange_from_camera.inverse();
        for &roll_rad in rolls_rad {
            if self.placement.work.is_over() {
                return None;
            }
            self.placement.work.spend(scene.inverse_cost);
            let base_from_flange = rolled(base_from_camera, roll_rad) * camera_from_flange;
            let answer = scene.cell.robot.kinematics.inverse(&base_from_flange, seeds);
            let mut states = answer.solutions.iter().filter_map(|state| within_limits(scene, state).ok());
            if let Some(joints) = states.find(|joints| scene.is_free(joints, &mut self.placement)) {
                return Some(KnownState { joints_rad: joints[..scene.dof].to_vec(), roll_rad });
            }
            // Where no joint state takes the pose, none takes it rolled.
            if answer.solutions.is_empty() && scene.last_joint_rolls.is_some() {
                return None;
            }
        }
        None
    }

    /// A collision-free state for the pose next to `known`, that of a pose nearby, at the same roll.
    /// None may be found from there although there are some.
    pub fn state_from(&mut self, base_from_camera: &Pose, known: &KnownState) -> Option<KnownState> {
        let Reach { scene, .. } = self.reach;
        if self.placement.work.is_over() || !pose_is_finite(base_from_camera) {
            return None;
        }
        self.placement.work.spend(cost::DESCENT);
        let camera_from_flange = scene.cell.flange_from_camera.inverse();
        let base_from_flange = rolled(base_from_camera, known.roll_rad) * camera_from_flange;
        let state = scene.cell.robot.kinematics.inverse_from(&base_from_flange, &known.joints_rad)?;
        let joints = within_limits(scene, &state).ok()?;
        let is_free = scene.is_free(&joints, &mut self.placement);
        is_free.then(|| KnownState { joints_rad: joints[..scene.dof].to_vec(), roll_rad: known.roll_rad })
    }

    /// Why the pose cannot be taken, exactly as a plan would say; `None` where it can.
    pub fn reason(&mut self, base_from_camera: &Pose) -> Option<SkipReason> {
        if self.reaches(base_from_camera) {
            return None;
        }
        let Reach { scene, rolls_rad, seeds } = self.reach;
        candidates(scene, base_from_camera, rolls_rad, seeds, None, &mut self.placement).err()
    }
}

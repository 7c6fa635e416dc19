//! A robot: its joints, kinematics, links and where the numbers come from.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::{
    DhConvention, DhRow, DhTable, Joint, Kinematics, Link, NumberGroup, RobotError, RobotWarning, Solver,
    Source, franka, ur, xarm,
};

/// Mesh files by the name that a URDF gives them.
pub type Meshes = BTreeMap<String, Vec<u8>>;

/// A serial arm of revolute joints.
#[derive(Debug, Clone)]
pub struct RobotModel {
    /// The model's name.
    pub name: String,
    /// The joints from base to flange.
    pub joints: Vec<Joint>,
    /// Forward and inverse kinematics.
    pub kinematics: Arc<dyn Kinematics>,
    /// The links from base to last, one more than joints, in the order of
    /// [`Kinematics::link_poses_into`].
    pub links: Vec<Link>,
    /// The name of the frame that all poses of this arm refer to.
    pub base_frame: String,
    /// The name of the frame that inverse kinematics places.
    pub flange_frame: String,
    /// The chain as a DH table, if that is how it was given.
    pub dh: Option<DhTable>,
    /// For each group of numbers where it comes from or why it is assumed.
    pub sources: Vec<Source>,
    /// What was left out of or assumed about a described robot, and limits that were widened.
    pub warnings: Vec<RobotWarning>,
}

impl RobotModel {
    /// Assumed joint speed of a described robot that states none, rad/s: a
    /// third of what arms of this size do.
    pub const ASSUMED_SPEED_RAD_PER_S: f64 = 1.0;

    /// Assumed joint acceleration where makers publish none, rad/s2. Arms of
    /// this size do several times that, so that plans stay followable.
    pub const ASSUMED_ACCELERATION_RAD_PER_S2: f64 = 5.0;

    /// The names [`RobotModel::named`] knows.
    pub fn names() -> Vec<&'static str> {
        ur::NAMES.into_iter().chain(franka::NAMES).chain([xarm::NAME]).collect()
    }

    /// A built-in model, its name in any case.
    pub fn named(name: &str) -> Result<Self, RobotError> {
        let lower = name.to_ascii_lowercase();
        if lower == xarm::NAME {
            return xarm::model();
        }
        match ur::model(&lower).or_else(|| franka::model(&lower)) {
            Some(model) => model,
            None => Err(RobotError::UnknownModel {
                name: super::error::short(name),
                known: Self::names().join(", "),
            }),
        }
    }

    /// An arm of six or seven joints from its DH table (metres, radians).
    ///
    /// Rows without limits get assumed ones, each said in `warnings`. The
    /// links are capsules between the frames' origins. Errors name the row and the field.
    pub fn from_dh(rows: &[DhRow], convention: DhConvention) -> Result<Self, RobotError> {
        super::described::from_dh(rows, convention)
    }

    /// An arm of six or seven turning joints out of URDF text.
    ///
    /// `base_link` is the root and `tip_link` a link of a customary name
    /// (`tool0`, `flange`, ..) or the only leaf that fits, unless they are
    /// named. Fixed joints are folded; any other joint between base and tip is
    /// refused. Speed limits are the URDF's, accelerations assumed. Collision
    /// boxes, cylinders, capsules and spheres are kept, meshes left out with a warning; what
    /// was left out or assumed is in `warnings`. Text over 1 MiB, more than
    /// 512 links or 256 shapes are refused; errors name the joint or link.
    pub fn from_urdf(
        text: &str,
        base_link: Option<&str>,
        tip_link: Option<&str>,
    ) -> Result<Self, RobotError> {
        Self::from_urdf_and_meshes(text, base_link, tip_link, &Meshes::new())
    }

    /// As [`Self::from_urdf`], with files for the collision meshes it names: for
    /// each the smallest box or capsule found that holds it is kept. Files that are neither STL nor
    /// OBJ are refused by name; meshes without a file are left out with a warning.
    pub fn from_urdf_and_meshes(
        text: &str,
        base_link: Option<&str>,
        tip_link: Option<&str>,
        meshes: &Meshes,
    ) -> Result<Self, RobotError> {
        super::urdf::from_urdf(text, base_link, tip_link, meshes)
    }

    /// The same arm with other limits, for cells that allow less than the maker
    /// does; `source` says where they come from. Errors name the joint and the field.
    pub fn with_joints(mut self, joints: Vec<Joint>, source: &str) -> Result<Self, RobotError> {
        joints.iter().try_for_each(super::described::check_joint)?;
        self.kinematics = self.kinematics.with_joints(joints.clone())?;
        self.joints = joints;
        self.sources.push(Source::new(NumberGroup::ReplacedLimits, source));
        Ok(self)
    }

    /// How the inverse kinematics works.
    pub fn solver(&self) -> Solver {
        self.kinematics.solver()
    }

    /// A joint state within the limits; see [`super::clamp_start`].
    pub fn clamp_start(&self, start_rad: &[f64]) -> Result<(Vec<f64>, Vec<super::ClampedJoint>), RobotError> {
        super::clamp_start(&self.joints, start_rad)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_taken_in_any_case_and_unknown_ones_list_the_known() {
        assert_eq!(RobotModel::named("UR5e").unwrap().name, "ur5e");
        let error = RobotModel::named("ur6").unwrap_err().to_string();
        assert!(error.contains("ur6") && error.contains("ur10e") && error.contains("panda"), "{error}");
        assert!(RobotModel::named(&"x".repeat(1_000_000)).unwrap_err().to_string().len() < 300);
    }

    #[test]
    fn every_model_has_matching_joints_links_and_sources() {
        for name in RobotModel::names() {
            let robot = RobotModel::named(name).unwrap();
            assert_eq!(robot.kinematics.dof(), robot.joints.len());
            assert_eq!(robot.links.len(), robot.joints.len() + 1);
            assert_eq!(robot.kinematics.link_poses(&[]).len(), robot.links.len());
            assert_eq!(robot.sources.len(), 5);
            assert_eq!(robot.dh.as_ref().map(|dh| dh.rows.len()), Some(robot.joints.len()));
        }
    }

    #[test]
    fn narrower_limits_bind_the_solutions() {
        let robot = RobotModel::named("ur5e").unwrap();
        let target = robot.kinematics.forward(&[0.3, -1.2, 1.4, -0.9, 1.1, 0.4]);
        let mut joints = robot.joints.clone();
        joints[2].lower_rad = 0.0;
        let narrow = robot.with_joints(joints.clone(), "the cell's guard").unwrap();
        let solutions = narrow.kinematics.inverse(&target, &[]).solutions;
        assert!(solutions.len() == 4 && solutions.iter().all(|q| q[2] >= 0.0));
        joints[1].max_speed_rad_per_s = f64::NAN;
        let error = narrow.clone().with_joints(joints, "").unwrap_err().to_string();
        assert!(error.contains("shoulder_lift_joint: speed limit is NaN"), "{error}");
        assert!(narrow.with_joints(Vec::new(), "").is_err());
    }
}

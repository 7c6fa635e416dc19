//! What carries the camera: an arm, or nothing.

use std::sync::Arc;

use super::{Flight, Following};
use crate::geometry::Pose;
use crate::robot::Kinematics;

/// What carries the camera through the views.
#[derive(Clone, Debug)]
pub enum Carrier {
    /// An arm on its trajectory.
    Arm {
        /// The motion.
        motion: Following,
        /// The arm's kinematics.
        kinematics: Arc<dyn Kinematics>,
        /// Hand-eye calibration.
        flange_from_camera: Pose,
    },
    /// A free camera.
    Free(Flight),
}

/// A photo to take.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shot {
    /// Id of the view.
    pub view: usize,
    /// When, seconds since the start.
    pub time_s: f64,
}

impl Carrier {
    /// The photos in the order of time. An arm takes the photo when it has rested at the view for as
    /// long as it will, after its vibrations have settled.
    pub fn shots(&self) -> Vec<Shot> {
        match self {
            Self::Free(flight) => flight.shots().map(|(view, time_s)| Shot { view, time_s }).collect(),
            Self::Arm { motion, .. } => {
                let points = motion.points();
                let rested = |index: usize, time_s: f64| {
                    let place = points.get(index).map(|point| &point.positions_rad);
                    let rest = points.iter().skip(index).take_while(|p| Some(&p.positions_rad) == place);
                    rest.last().map_or(time_s, |point| point.time_s)
                };
                let marked = points.iter().enumerate();
                marked
                    .filter_map(|(index, point)| {
                        point.view.map(|view| Shot { view, time_s: rested(index, point.time_s) })
                    })
                    .collect()
            }
        }
    }

    /// Time of the whole run, seconds.
    pub fn duration_s(&self) -> f64 {
        match self {
            Self::Arm { motion, .. } => motion.duration_s(),
            Self::Free(flight) => flight.shots().last().map_or(0.0, |(_, time_s)| time_s),
        }
    }

    /// Joint angles at `time_s`, radians; `None` without an arm.
    pub fn joints_at(&self, time_s: f64) -> Option<Vec<f64>> {
        match self {
            Self::Arm { motion, .. } => Some(motion.joints_at(time_s)),
            Self::Free(_) => None,
        }
    }

    /// Names of the joints; empty without an arm.
    pub fn joint_names(&self) -> &[String] {
        match self {
            Self::Arm { motion, .. } => motion.joint_names(),
            Self::Free(_) => &[],
        }
    }

    /// `base_from_camera` at `time_s`: by forward kinematics of the joints at that time.
    pub fn camera_at(&self, time_s: f64) -> Pose {
        match self {
            Self::Arm { motion, kinematics, flange_from_camera } => {
                kinematics.forward(&motion.joints_at(time_s)) * flange_from_camera
            }
            Self::Free(flight) => flight.pose_at(time_s).unwrap_or_else(Pose::identity),
        }
    }
}

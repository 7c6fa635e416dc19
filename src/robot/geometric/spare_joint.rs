//! Seven axes: with one joint held, the other six have a spherical wrist.
//!
//! For the Franka arms this is the solution of He and Liu (2021): the last
//! joint is held, the first three axes meet in the shoulder, and seen from the
//! flange axes 6 and 5 meet while axis 4 carries the shoulder.

use super::six::SixAxes;
use crate::geometry::Pose;
use crate::robot::axis::Axis;

/// The structure of a seven-joint arm.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct SpareJoint {
    six: SixAxes,
    held: Axis,
    held_joint: usize,
}

impl SpareJoint {
    /// The structure if holding the last or the first joint leaves a spherical wrist up to `tolerance`.
    pub fn of(axes: &[Axis; 7], tolerance: f64) -> Option<Self> {
        let [a1, a2, a3, a4, a5, a6, a7] = *axes;
        let last = SixAxes::of(&[a1, a2, a3, a4, a5, a6], tolerance).map(|six| Self {
            six,
            held: a7,
            held_joint: 6,
        });
        last.or_else(|| {
            let six = SixAxes::of(&[a2, a3, a4, a5, a6, a7], tolerance)?;
            Some(Self { six, held: a1, held_joint: 0 })
        })
    }

    /// How far the axes are from the structure, metres or sine.
    pub fn misfit(&self) -> f64 {
        self.six.misfit()
    }

    /// Index of the joint whose angle is chosen.
    pub fn held_joint(&self) -> usize {
        self.held_joint
    }

    /// The eight ways with the held joint at `held_rad`; see [`SixAxes::ways`].
    pub fn ways(&self, motion: &Pose, held_rad: f64, seed_rad: &[f64; 7]) -> [[f64; 7]; 8] {
        let first = self.held_joint == 0;
        let back = self.held.turn(-held_rad);
        let rest = if first { back * motion } else { motion * back };
        let shift = usize::from(first);
        let seed: [f64; 6] = std::array::from_fn(|i| seed_rad[i + shift]);
        self.six.ways(&rest, &seed).map(|way| {
            let [a, b, c, d, e, f] = way.joints_rad;
            if first { [held_rad, a, b, c, d, e, f] } else { [a, b, c, d, e, f, held_rad] }
        })
    }
}

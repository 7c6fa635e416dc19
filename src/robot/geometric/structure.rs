//! The structure of a chain, found in its axes, whatever its frames and zero angles are.

use super::offset_wrist::OffsetWrist;
use super::six::SixAxes;
use super::spare_joint::SpareJoint;
use crate::robot::axis::Axis;
use crate::robot::{ArmStructure, Chain, Solver};

/// Misfit under which the structure counts as exact, metres and sines. Ten
/// times below what a solution may miss by.
const EXACT_FIT: f64 = 1e-10;

/// Largest misfit for which the closed form still gives good starts: what calibration finds.
const ROUGH_FIT: f64 = 0.01;

/// How the chain is solved.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Structure {
    SphericalWrist(SixAxes),
    OffsetWrist(OffsetWrist),
    SpareJoint(SpareJoint),
}

impl Structure {
    /// The structure of a chain; `None` if it has none of the known ones.
    pub fn of(chain: &Chain) -> Option<Self> {
        let axes = Axis::all_of(chain);
        let finite = |axis: &Axis| axis.point.iter().chain(axis.along.iter()).all(|v| v.is_finite());
        if !axes.iter().all(finite) {
            return None;
        }
        [EXACT_FIT, ROUGH_FIT].into_iter().find_map(|tolerance| Self::within(&axes, tolerance))
    }

    fn within(axes: &[Axis], tolerance: f64) -> Option<Self> {
        if let Ok(axes) = <&[Axis; 7]>::try_from(axes) {
            return SpareJoint::of(axes, tolerance).map(Self::SpareJoint);
        }
        let axes = <&[Axis; 6]>::try_from(axes).ok()?;
        let spherical = SixAxes::of(axes, tolerance).map(Self::SphericalWrist);
        spherical.or_else(|| OffsetWrist::of(axes, tolerance).map(Self::OffsetWrist))
    }

    /// What to tell about it.
    pub fn solver(&self) -> Solver {
        let (structure, misfit) = match self {
            Self::SphericalWrist(six) => (ArmStructure::SphericalWrist, six.misfit()),
            Self::OffsetWrist(wrist) => (ArmStructure::OffsetWrist, wrist.misfit()),
            Self::SpareJoint(spare) => (ArmStructure::SpareJoint, spare.misfit()),
        };
        Solver { structure, exact: misfit <= EXACT_FIT }
    }
}

//! Six axes of which the first or the last three meet in a point.

use nalgebra::{Unit, UnitQuaternion};

use super::positioner::Positioner;
use super::wrist::Wrist;
use crate::geometry::{Point, Pose};
use crate::robot::ReachBound;
use crate::robot::axis::Axis;

/// One of the eight ways to reach a pose, not yet measured.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Way {
    /// Angles of the six joints, radians.
    pub joints_rad: [f64; 6],
    /// The bound that keeps it away, if one does.
    pub held_by: Option<ReachBound>,
}

/// Six axes solved in closed form: three of them meet in a point, the others carry it.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct SixAxes {
    positioner: Positioner,
    wrist: Wrist,
    centre: Point,
    first_three: [Axis; 3],
    /// The spherical part comes first: everything is seen from the flange.
    reversed: bool,
    misfit: f64,
}

impl SixAxes {
    /// The structure in six axes if they have it up to `tolerance` (metres and sines).
    pub fn of(axes: &[Axis; 6], tolerance: f64) -> Option<Self> {
        let mut reversed = *axes;
        reversed.reverse();
        let found = [Self::directed(axes, false, tolerance), Self::directed(&reversed, true, tolerance)];
        // The better fit of the two.
        found.into_iter().flatten().min_by(|a, b| a.misfit.total_cmp(&b.misfit))
    }

    fn directed(axes: &[Axis; 6], reversed: bool, tolerance: f64) -> Option<Self> {
        let [a1, a2, a3, a4, a5, a6] = *axes;
        let first_three = [a1, a2, a3];
        let (wrist, centre, gap_m) = Wrist::of([a4, a5, a6], tolerance)?;
        let (positioner, slant) = Positioner::of(first_three, centre, tolerance)?;
        Some(Self { positioner, wrist, centre, first_three, reversed, misfit: gap_m.max(slant) })
    }

    /// How far the axes are from the structure, metres or sine.
    pub fn misfit(&self) -> f64 {
        self.misfit
    }

    /// The eight ways to move everything behind the last joint by `motion`
    /// (`base_from_flange * base_from_flange_at_zero^-1`). Free angles take `seed_rad`'s.
    pub fn ways(&self, motion: &Pose, seed_rad: &[f64; 6]) -> [Way; 8] {
        // From the flange the same joints turn the other way round, in the other order.
        let turn_round = |q: &[f64; 6]| -> [f64; 6] { std::array::from_fn(|i| -q[5 - i]) };
        let (motion, seed) =
            if self.reversed { (motion.inverse(), turn_round(seed_rad)) } else { (*motion, *seed_rad) };
        let mut ways = [Way { joints_rad: [0.0; 6], held_by: None }; 8];
        let mut slots = ways.iter_mut();
        for placement in self.positioner.place(&(motion * self.centre), [seed[0], seed[1], seed[2]]) {
            let [q1, q2, q3] = placement.angles_rad;
            // The wrist does what the first three joints leave to do.
            let left = undone(&self.first_three, placement.angles_rad, motion.rotation);
            for [q4, q5, q6] in self.wrist.turn(&left, seed[3]) {
                let joints = [q1, q2, q3, q4, q5, q6];
                let joints_rad = if self.reversed { turn_round(&joints) } else { joints };
                slots.next().into_iter().for_each(|slot| {
                    *slot = Way { joints_rad, held_by: placement.held_by };
                });
            }
        }
        ways
    }
}

/// `rotation` without what the axes turned before: `(R1 R2 R3)^-1 rotation`.
pub(super) fn undone(
    axes: &[Axis; 3],
    angles_rad: [f64; 3],
    rotation: UnitQuaternion<f64>,
) -> UnitQuaternion<f64> {
    axes.iter().zip(angles_rad).fold(rotation, |left, (axis, angle)| {
        UnitQuaternion::from_axis_angle(&Unit::new_unchecked(axis.along), -angle) * left
    })
}

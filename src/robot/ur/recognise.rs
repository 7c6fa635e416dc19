//! Finds the UR structure in a chain, whatever its frames, zero angles and directions are.
//!
//! Many arms share it: axis 1 meets axis 2 at a right angle, axes 2, 3 and 4
//! are parallel, 4 and 5, and 5 and 6 meet at right angles. A URDF of such an
//! arm turns its base and its zero angles as it likes, and a calibrated one has
//! the structure nearly. The axes in the zero posture give the lengths; comparing
//! forward kinematics tells how well they fit.

use nalgebra::{Matrix3, Rotation3, Translation3, UnitQuaternion};

use super::UrParameters;
use super::inverse::{Branches, EXACT};
use crate::geometry::{Point, Pose, Vector};
use crate::robot::axis::Axis;
use crate::robot::dh::chain_from_dh;
use crate::robot::{Chain, DhConvention};

/// Largest misfit for which the closed form still gives good starts, metres and radians.
const ROUGH: f64 = 0.04;

/// Cosine above which axes do not count as square to each other, or below which not as parallel.
const SLANT: f64 = 0.1;

/// A chain seen as a UR arm on a mount.
#[derive(Debug, Clone, PartialEq)]
pub struct UrShape {
    parameters: UrParameters,
    base_from_ur: Pose,
    flange_from_ur_flange: Pose,
    /// UR angle = sign * joint angle + offset.
    signs: [f64; 6],
    offsets_rad: [f64; 6],
    exact: bool,
}

impl UrShape {
    /// The UR arm in `chain`, if it is one at least nearly.
    pub fn of(chain: &Chain) -> Option<Self> {
        let mut shape = Self::from_axes(chain)?;
        let rows = shape.parameters.dh_rows();
        let ur = chain_from_dh(&rows, DhConvention::Standard, &Pose::identity()).ok()?;
        let misfit = shape.misfit(chain, &ur);
        shape.exact = misfit <= EXACT;
        (misfit <= ROUGH).then_some(shape)
    }

    /// Whether the chain is a UR arm to rounding, so that the closed form has every solution.
    pub fn is_exact(&self) -> bool {
        self.exact
    }

    /// The branches for `base_from_flange`, in UR angles (see [`Self::joints_rad`]).
    pub fn branches(&self, base_from_flange: &Pose, seed_rad: &[f64]) -> Option<Branches> {
        let mut seed = [0.0; 6];
        for (i, slot) in seed.iter_mut().enumerate() {
            let angle = seed_rad.get(i).copied().filter(|q| q.is_finite()).unwrap_or(0.0);
            *slot = self.signs[i] * angle + self.offsets_rad[i];
        }
        let target = self.base_from_ur.inverse() * base_from_flange * self.flange_from_ur_flange;
        self.parameters.branches(&target, &seed)
    }

    /// Joint angles of the chain for UR angles.
    pub fn joints_rad(&self, ur_rad: &[f64; 6]) -> [f64; 6] {
        std::array::from_fn(|i| self.signs[i] * (ur_rad[i] - self.offsets_rad[i]))
    }

    fn from_axes(chain: &Chain) -> Option<Self> {
        let [a1, a2, a3, a4, a5, a6]: [Axis; 6] = Axis::all_of(chain).try_into().ok()?;
        let same_way = |axis: &Axis| if axis.along.dot(&a2.along) < 0.0 { -1.0 } else { 1.0 };
        let (s3, s4) = (same_way(&a3), same_way(&a4));
        let parallel = |x: &Axis| x.along.dot(&a2.along).abs() > 1.0 - SLANT;
        let square = |x: &Axis, y: &Axis| x.along.dot(&y.along).abs() < SLANT;
        if !(parallel(&a3) && parallel(&a4) && square(&a1, &a2) && square(&a4, &a5) && square(&a5, &a6)) {
            return None;
        }
        let u = (a2.along + a3.along * s3 + a4.along * s4).normalize();
        let [shoulder, wrist_1, wrist_2] = [a1.meets(&a2)?, a4.meets(&a5)?, a5.meets(&a6)?];
        let beside = |v: Vector| v - u * v.dot(&u);
        let (upper_arm, forearm) = (beside(a3.point - shoulder), beside(a4.point - a3.point));
        let (a2_m, a3_m) = (upper_arm.norm(), forearm.norm());
        if a2_m < 0.02 || a3_m < 0.02 {
            return None;
        }
        let x1 = a1.along.cross(&u).normalize();
        let (x2, x3) = (upper_arm / a2_m, forearm / a3_m);
        let x4 = u.cross(&a5.along).normalize();
        let x5 = a6.along.cross(&a5.along).normalize();
        let angle =
            |from: &Vector, to: &Vector, about: &Vector| from.cross(to).dot(about).atan2(from.dot(to));
        let base_from_ur = frame(&shoulder, &x1, &a1.along);
        let base_from_ur_flange = frame(&wrist_2, &x5, &a6.along);
        Some(Self {
            parameters: UrParameters {
                d1_m: 0.0,
                a2_m,
                a3_m,
                d4_m: (wrist_1 - shoulder).dot(&u),
                d5_m: (wrist_2 - wrist_1).dot(&a5.along),
                d6_m: 0.0,
            },
            base_from_ur,
            flange_from_ur_flange: chain.forward(&[]).inverse() * base_from_ur_flange,
            signs: [1.0, 1.0, s3, s4, 1.0, 1.0],
            offsets_rad: [
                0.0,
                angle(&x1, &x2, &u),
                angle(&x2, &x3, &u),
                angle(&x3, &x4, &u),
                angle(&x4, &x5, &a5.along),
                0.0,
            ],
            exact: false,
        })
    }

    /// The largest difference of forward kinematics over a few states, metres or radians.
    fn misfit(&self, chain: &Chain, ur: &Chain) -> f64 {
        let ur_flange_from_flange = self.flange_from_ur_flange.inverse();
        (0..8).fold(0.0, |worst: f64, k| {
            // Angles that share no period with each other.
            let q: [f64; 6] = std::array::from_fn(|i| f64::from(k) * (0.7 + 0.31 * i as f64));
            let angles: [f64; 6] = std::array::from_fn(|i| self.signs[i] * q[i] + self.offsets_rad[i]);
            let seen = self.base_from_ur * ur.forward(&angles) * ur_flange_from_flange;
            let is = chain.forward(&q);
            let shift = (seen.translation.vector - is.translation.vector).norm();
            let turned = (seen.rotation.inverse() * is.rotation).scaled_axis().norm();
            // `max` would let a NaN pass.
            if shift.is_nan() || turned.is_nan() { f64::INFINITY } else { worst.max(shift).max(turned) }
        })
    }
}

/// The frame at `origin` with axes `x` and `z`, which are square to each other.
fn frame(origin: &Point, x: &Vector, z: &Vector) -> Pose {
    let axes = Rotation3::from_matrix_unchecked(Matrix3::from_columns(&[*x, z.cross(x), *z]));
    Pose::from_parts(Translation3::from(origin.coords), UnitQuaternion::from_rotation_matrix(&axes))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robot::DhRow;

    fn ur5e_rows() -> [DhRow; 6] {
        super::super::parameters::SHEETS[3].parameters.dh_rows()
    }

    fn chain(rows: &[DhRow]) -> Chain {
        chain_from_dh(rows, DhConvention::Standard, &Pose::translation(0.0, 0.01, 0.15)).unwrap()
    }

    #[test]
    fn a_ur_table_with_other_zero_angles_and_a_tool_is_recognised_exactly() {
        let mut rows = ur5e_rows();
        rows.iter_mut().enumerate().for_each(|(i, row)| row.theta_offset_rad = 0.3 * i as f64 - 0.7);
        assert!(UrShape::of(&chain(&rows)).unwrap().is_exact());
    }

    #[test]
    fn a_calibrated_table_is_recognised_roughly() {
        let mut rows = ur5e_rows();
        rows[1].alpha_rad += 0.002;
        rows[3].a_m += 0.0004;
        assert!(!UrShape::of(&chain(&rows)).unwrap().is_exact());
    }

    #[test]
    fn other_structures_are_left_alone() {
        let mut rows = ur5e_rows();
        rows[3].a_m = 0.1;
        assert_eq!(UrShape::of(&chain(&rows)), None);
        rows[1].alpha_rad = 1.0;
        assert_eq!(UrShape::of(&chain(&rows)), None);
        let spherical = [
            DhRow::new(0.0, std::f64::consts::FRAC_PI_2, 0.4, 0.0),
            DhRow::new(0.4, 0.0, 0.0, 0.0),
            DhRow::new(0.0, std::f64::consts::FRAC_PI_2, 0.0, 0.0),
            DhRow::new(0.0, -std::f64::consts::FRAC_PI_2, 0.4, 0.0),
            DhRow::new(0.0, std::f64::consts::FRAC_PI_2, 0.0, 0.0),
            DhRow::new(0.0, 0.0, 0.1, 0.0),
        ];
        assert_eq!(UrShape::of(&chain(&spherical)), None);
    }
}

//! Chains from Denavit-Hartenberg tables.

use nalgebra::{Translation3, UnitQuaternion};

use super::bounds::{DH_LONGEST_M, DH_WIDEST_RAD};
use super::{Chain, RobotError, Segment};
use crate::geometry::{Pose, Vector};

/// Which of the two DH conventions a table follows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DhConvention {
    /// `T_i = Rz(q_i + offset_i) Tz(d_i) Tx(a_i) Rx(alpha_i)` (Universal Robots).
    Standard,
    /// Craig's: `T_i = Rx(alpha_i) Tx(a_i) Rz(q_i + offset_i) Tz(d_i)` with row i
    /// holding `alpha_{i-1}` and `a_{i-1}` (Franka).
    Modified,
}

/// One row of a DH table, with the limits of its joint.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct DhRow {
    /// Length along x, metres.
    pub a_m: f64,
    /// Twist about x, radians.
    pub alpha_rad: f64,
    /// Offset along z, metres.
    pub d_m: f64,
    /// Added to the joint angle, radians.
    pub theta_offset_rad: f64,
    /// Name of the joint; `joint_1`, `joint_2`, .. if absent.
    pub name: Option<String>,
    /// Smallest angle, radians; -2 pi if absent.
    pub lower_rad: Option<f64>,
    /// Largest angle, radians; 2 pi if absent.
    pub upper_rad: Option<f64>,
    /// Largest speed, rad/s; [`super::RobotModel::ASSUMED_SPEED_RAD_PER_S`] if absent.
    pub max_speed_rad_per_s: Option<f64>,
    /// Largest acceleration, rad/s2; [`super::RobotModel::ASSUMED_ACCELERATION_RAD_PER_S2`] if absent.
    pub max_acceleration_rad_per_s2: Option<f64>,
}

impl DhRow {
    /// The geometry alone: everything else assumed.
    pub fn new(a_m: f64, alpha_rad: f64, d_m: f64, theta_offset_rad: f64) -> Self {
        Self { a_m, alpha_rad, d_m, theta_offset_rad, ..Self::default() }
    }
}

/// A whole table, with the flange behind it.
#[derive(Debug, Clone, PartialEq)]
pub struct DhTable {
    /// The convention of the rows.
    pub convention: DhConvention,
    /// Base to last joint.
    pub rows: Vec<DhRow>,
    /// The flange in the last row's frame.
    pub last_from_flange: Pose,
}

impl DhTable {
    /// The chain of the table. Errors name the row and the field.
    pub(super) fn chain(&self) -> Result<Chain, RobotError> {
        chain_from_dh(&self.rows, self.convention, &self.last_from_flange)
    }
}

/// The chain of a DH table with a flange fixed to the last frame by `last_from_flange`.
pub(super) fn chain_from_dh(
    rows: &[DhRow],
    convention: DhConvention,
    last_from_flange: &Pose,
) -> Result<Chain, RobotError> {
    for (i, row) in rows.iter().enumerate() {
        check_row(i, row)?;
    }
    let mut pending = Pose::identity();
    let mut segments = Vec::with_capacity(rows.len());
    for row in rows {
        // A turn by the offset about z commutes with the joint's own turn.
        let offset = turn(Vector::z() * row.theta_offset_rad);
        let x_screw = slide(row.a_m, 0.0, 0.0) * turn(Vector::x() * row.alpha_rad);
        let z_slide = slide(0.0, 0.0, row.d_m);
        let (before, after) = match convention {
            DhConvention::Standard => (offset, z_slide * x_screw),
            DhConvention::Modified => (x_screw * offset, z_slide),
        };
        segments.push(Segment { previous_from_joint: pending * before, axis_in_joint: Vector::z_axis() });
        pending = after;
    }
    Chain::new(segments, pending * last_from_flange)
}

fn slide(x: f64, y: f64, z: f64) -> Pose {
    Pose::from_parts(Translation3::new(x, y, z), UnitQuaternion::identity())
}

fn turn(scaled_axis: Vector) -> Pose {
    Pose::from_parts(Translation3::identity(), UnitQuaternion::from_scaled_axis(scaled_axis))
}

fn check_row(index: usize, row: &DhRow) -> Result<(), RobotError> {
    let lengths = [("a", row.a_m), ("d", row.d_m)];
    let angles = [("alpha", row.alpha_rad), ("theta", row.theta_offset_rad)];
    let check = |(field, value): (&'static str, f64), bound: f64, hint| {
        // A NaN is not within any range.
        if (-bound..=bound).contains(&value) {
            return Ok(());
        }
        Err(RobotError::DhRow { row: index, field, value, least: -bound, most: bound, hint })
    };
    lengths.into_iter().try_for_each(|l| check(l, DH_LONGEST_M, "; millimetres given as metres?"))?;
    angles.into_iter().try_for_each(|a| check(a, DH_WIDEST_RAD, "; degrees given as radians?"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn millimetres_degrees_and_numbers_that_are_none_are_refused_with_row_and_field() {
        let refused = |row: DhRow| {
            chain_from_dh(&[row], DhConvention::Standard, &Pose::identity()).unwrap_err().to_string()
        };
        assert!(refused(DhRow::new(-425.0, 0.0, 0.0, 0.0)).contains("dh[0].a is -425"));
        assert!(refused(DhRow::new(0.0, 0.0, 162.5, 0.0)).contains("millimetres"));
        assert!(refused(DhRow::new(0.0, 90.0, 0.0, 0.0)).contains("degrees"));
        assert!(refused(DhRow::new(0.0, 0.0, f64::NAN, 0.0)).contains("dh[0].d is NaN"));
        assert!(refused(DhRow::new(0.0, 0.0, 0.0, f64::NEG_INFINITY)).contains("dh[0].theta is -inf"));
    }

    #[test]
    fn the_offset_adds_to_the_joint_angle_in_both_conventions() {
        for convention in [DhConvention::Standard, DhConvention::Modified] {
            let with = chain_from_dh(&vec![DhRow::new(0.3, 0.5, 0.2, 0.7); 2], convention, &Pose::identity());
            let without =
                chain_from_dh(&vec![DhRow::new(0.3, 0.5, 0.2, 0.0); 2], convention, &Pose::identity());
            let (a, b) = (with.unwrap().forward(&[0.1, -0.4]), without.unwrap().forward(&[0.8, 0.3]));
            assert!((a.to_homogeneous() - b.to_homogeneous()).norm() < 1e-12);
        }
    }
}

//! Bounds of what a request says about an arm. The API description declares what is checked by these.

use std::ops::RangeInclusive;

/// Fewest and most moving joints of a described arm.
pub const JOINTS: RangeInclusive<usize> = 6..=7;
/// Longest plausible `a` or `d` of a DH table, metres; more looks like millimetres.
pub const DH_LONGEST_M: f64 = 5.0;
/// Largest `alpha` and `theta` of a DH table, radians.
pub const DH_WIDEST_RAD: f64 = std::f64::consts::TAU;
/// Largest angle that a described joint's limit may have, radians: four turns.
pub const LIMIT_WIDEST_RAD: f64 = 4.0 * std::f64::consts::TAU;
/// Speeds (rad/s) and accelerations (rad/s2) taken as meant.
pub const RATES: RangeInclusive<f64> = 1e-3..=1e3;
/// Jerks taken as meant, rad/s3.
pub const JERKS: RangeInclusive<f64> = 1e-3..=1e6;
/// Longest URDF text, bytes.
pub const LONGEST_URDF_BYTES: usize = 1 << 20;

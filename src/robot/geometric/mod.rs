//! Closed forms found in the geometry of a chain: three axes that meet, two that are parallel.
//!
//! With the chain at zero as reference, the target is a motion: the product of
//! the turns about the joints' axes (Brockett 1984). No frames, signs or
//! offsets of a table enter.

mod kinematics;
mod offset_wrist;
mod positioner;
mod six;
mod spare_joint;
mod structure;
mod subproblems;
mod wrist;

pub(super) use kinematics::GeometricKinematics;

#[cfg(test)]
mod tests;

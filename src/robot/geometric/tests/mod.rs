//! The closed forms against arms of real makers, random structures and the numeric solver.

mod arms;
mod offset_wrist;
mod spare_joint;
mod spherical_wrist;

//! Inverse kinematics for chains without a closed form.

mod descent;
mod kinematics;
mod starts;

pub(super) use descent::{Bounds, descend};
pub use kinematics::NumericKinematics;

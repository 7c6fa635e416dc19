//! Inverse kinematics for chains without a closed form.

mod descent;
mod kinematics;
mod starts;

pub(super) use descent::{Bounds, Descent, descend};
pub use kinematics::NumericKinematics;
pub(super) use starts::radical_inverse;

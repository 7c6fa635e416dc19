//! Arms of Universal Robots.

mod inverse;
mod kinematics;
mod links;
mod model;
mod parameters;
mod recognise;

pub use inverse::{Branch, Branches};
pub use kinematics::UrKinematics;
pub(super) use model::model;
pub(super) use parameters::NAMES;
pub use parameters::UrParameters;
pub(super) use recognise::UrShape;

#[cfg(test)]
mod million;
#[cfg(test)]
mod tests;

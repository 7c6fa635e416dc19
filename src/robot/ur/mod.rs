//! Arms of Universal Robots.

mod links;
mod model;
mod parameters;

pub(super) use model::model;
pub(super) use parameters::NAMES;
pub use parameters::UrParameters;

//! Pictures of plans: the hemisphere of views seen from above, as SVG.
//!
//! Knows directions only: what a plan or a request says becomes a [`Panel`] in `api`. Bytes follow
//! from the panels alone.

mod common_point;
mod dome;
mod hemisphere;
mod panel;
mod reach_map;
mod svg;

#[cfg(test)]
mod tests;

pub use common_point::common_point;
pub use hemisphere::hemispheres;
pub use panel::Panel;
pub use reach_map::ReachMap;

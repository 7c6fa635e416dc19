//! Where the cameras stand: Tammes sets on a band of a sphere, the initial views, poses.
//!
//! Directions point from the object's centre to the camera, in the robot's base
//! frame, z up. A set comes from the committed table if its band is the default
//! one, from the generator in `packing` otherwise; both are deterministic.

mod band;
mod best_known;
mod covering;
mod error;
mod initial;
mod packing;
mod search;
mod spread;
mod table;
mod tammes;
mod view_set;
mod view_space;

pub use band::Band;
pub use best_known::best_known_rad;
pub use covering::covering_radius_rad;
pub use error::ViewsError;
pub use initial::{InitialView, initial_views, initial_views_five};
pub use search::{SearchLine, search_round};
pub use spread::{Lattice, spread};
pub use table::{generate_table, improved_table};
pub use tammes::{MAX_VIEWS, tammes};
pub use view_set::{ViewSet, separation_rad};
pub use view_space::ViewSpace;

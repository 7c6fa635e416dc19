//! A simulated arm and camera that carry out a plan.
//!
//! The arm follows a trajectory at its rate, stops at each view and takes a photo from where its
//! joints really put the camera. Without an arm the camera flies freely along the plan's path.

mod carrier;
mod error;
mod execute;
mod flight;
mod following;
mod pace;
mod photo_set;
mod rendered_object;

pub use carrier::{Carrier, Shot};
pub use error::SimulateError;
pub use execute::{End, Observer, Photo, Photograph, Run, execute};
pub use flight::{FLIGHT_SETTLE_S, FLIGHT_SPEED_M_PER_S, Flight};
pub use following::Following;
pub use pace::{MAX_SPEED_FACTOR, MIN_SPEED_FACTOR};
pub use photo_set::{photo_set_text, write_photo_set};
pub use rendered_object::RenderedObject;

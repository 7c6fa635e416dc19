//! What one panel of a picture shows.

use super::ReachMap;
use crate::geometry::Direction;

/// One plan: unit directions from the object's centre to the cameras, robot base frame.
#[derive(Clone, Debug, Default)]
pub struct Panel {
    /// Stands above the hemisphere.
    pub title: String,
    /// Planned views in the order of the path; numbered from 1.
    pub planned: Vec<Direction>,
    /// Views left out, each with the code of its reason.
    pub skipped: Vec<(Direction, String)>,
    /// The part of the band that the arm reaches; nothing is shaded without.
    pub reach: Option<ReachMap>,
    /// Azimuth from the object to the robot's base, radians from +x towards +y.
    pub base_azimuth_rad: Option<f64>,
    /// Lines of text below: name and value.
    pub captions: Vec<(String, String)>,
}

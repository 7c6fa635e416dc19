//! A set of directions and how well it is spread.

use crate::geometry::{Direction, Vector};

/// Directions from the object's centre to the cameras.
#[derive(Debug, Clone, PartialEq)]
pub struct ViewSet {
    /// Unit vectors in the robot's base frame; the first is the top view.
    pub directions: Vec<Direction>,
    /// Least angle between two of them, radians; pi for a single view.
    pub separation_rad: f64,
}

impl ViewSet {
    /// The set of these directions, its separation measured.
    pub fn from_directions(directions: Vec<Direction>) -> ViewSet {
        let separation_rad = separation_rad(&directions);
        ViewSet { directions, separation_rad }
    }
}

/// Least angle between two of `directions`, radians; pi if there are fewer than two.
pub fn separation_rad(directions: &[Direction]) -> f64 {
    let mut least = std::f64::consts::PI;
    for (i, a) in directions.iter().enumerate() {
        for b in &directions[..i] {
            least = least.min(angle(a, b));
        }
    }
    least
}

/// Angle between two unit vectors, accurate for small and large angles alike.
pub(super) fn angle(a: &Vector, b: &Vector) -> f64 {
    2.0 * (a - b).norm().atan2((a + b).norm())
}

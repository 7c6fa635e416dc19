//! The photos taken before anything is known about the object.

use crate::geometry::{Direction, direction_from_azimuth_elevation};

/// Elevation of the side views, degrees: the second ring of the five-view set the paper starts from.
const SIDE_ELEVATION_DEG: f64 = 12.1;

/// One of the named first views.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct InitialView {
    /// `top`, `left`, `front`, `right` or `back`.
    pub name: &'static str,
    /// From the object's centre to the camera, in the robot's base frame.
    pub direction: Direction,
}

/// The three photos the network is trained on: top, left, front. The two sides
/// stand 80 degrees apart. Executed in the order left, front, top or any other
/// that ends at the top, where the next path starts.
pub fn initial_views() -> [InitialView; 3] {
    [top(), side("left", 154.0), side("front", 234.0)]
}

/// Top and four sides, `right` and `back` facing `left` and `front`: more photos
/// for training and for measuring what each is worth.
pub fn initial_views_five() -> [InitialView; 5] {
    [top(), side("left", 154.0), side("front", 234.0), side("right", 334.0), side("back", 54.0)]
}

fn top() -> InitialView {
    InitialView { name: "top", direction: crate::geometry::Vector::z_axis() }
}

fn side(name: &'static str, azimuth_deg: f64) -> InitialView {
    let direction =
        direction_from_azimuth_elevation(azimuth_deg.to_radians(), SIDE_ELEVATION_DEG.to_radians());
    InitialView { name, direction }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn opposite_sides_are_half_a_turn_apart() {
        let views = initial_views_five();
        for (a, b) in [(1, 3), (2, 4)] {
            let (a, b) = (views[a].direction, views[b].direction);
            assert!((a.x + b.x).abs() < 1e-12 && (a.y + b.y).abs() < 1e-12 && (a.z - b.z).abs() < 1e-12);
        }
    }

    #[test]
    fn the_three_are_the_first_of_the_five() {
        assert_eq!(initial_views()[..], initial_views_five()[..3]);
    }
}

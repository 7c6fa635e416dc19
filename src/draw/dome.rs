//! From directions to places on the picture.

use std::f64::consts::FRAC_PI_2;

use super::svg::number;
use crate::geometry::{Direction, azimuth_elevation_from_direction};

/// An azimuthal equidistant projection about straight above: distance from the middle is the angle
/// from the vertical. +x points right and +y up, as seen from above.
pub(super) struct Dome {
    /// Middle of the projection, pixels from the upper left corner.
    pub(super) middle: (f64, f64),
    /// Pixels a radian.
    pub(super) scale: f64,
}

impl Dome {
    /// Distance of an elevation's ring from the middle, pixels.
    pub(super) fn radius(&self, elevation_rad: f64) -> f64 {
        self.scale * (FRAC_PI_2 - elevation_rad)
    }

    /// Pixels from the upper left corner, `distance` pixels from the middle.
    pub(super) fn polar(&self, azimuth_rad: f64, distance: f64) -> (f64, f64) {
        let (sin, cos) = azimuth_rad.sin_cos();
        (self.middle.0 + distance * cos, self.middle.1 - distance * sin)
    }

    /// The same for a direction.
    pub(super) fn place(&self, direction: &Direction) -> (f64, f64) {
        let (azimuth, elevation) = azimuth_elevation_from_direction(direction);
        self.polar(azimuth, self.radius(elevation))
    }

    /// `x y` of an azimuth and an elevation.
    pub(super) fn text_at(&self, azimuth_rad: f64, elevation_rad: f64) -> String {
        let (x, y) = self.polar(azimuth_rad, self.radius(elevation_rad));
        format!("{} {}", number(x), number(y))
    }

    /// Path data of the great circles that join `directions` one after the other. Between opposite
    /// directions there is no shortest one: they are joined by a straight line.
    pub(super) fn great_circles(&self, directions: &[Direction]) -> String {
        // 3 degrees: on a dome of 200 pixels no chord leaves its curve by a tenth of a pixel.
        const STEP_RAD: f64 = 0.052;
        let mut data = String::new();
        let mut add = |direction: &Direction| {
            let (x, y) = self.place(direction);
            data += &format!("{}{} {}", if data.is_empty() { "M" } else { "L" }, number(x), number(y));
        };
        directions.iter().take(1).for_each(&mut add);
        for (from, to) in directions.iter().zip(directions.iter().skip(1)) {
            let steps = (from.angle(to) / STEP_RAD).ceil() as usize;
            for step in 1..steps {
                if let Some(between) = from.try_slerp(to, step as f64 / steps as f64, 1e-6) {
                    add(&between);
                }
            }
            add(to);
        }
        data
    }
}

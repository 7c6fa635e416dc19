//! The band of elevations that views may come from.

use std::f64::consts::FRAC_PI_2;

use super::ViewsError;
use crate::geometry::{Direction, azimuth_elevation_from_direction};

/// Closed range of elevations, radians, seen from the object's centre: 0 is
/// the horizontal plane through it, `pi/2` straight above.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Band {
    /// Lowest elevation of a view, radians.
    pub min_elevation_rad: f64,
    /// Highest elevation of a view, radians.
    pub max_elevation_rad: f64,
}

impl Band {
    /// Largest elevation, up or down, degrees.
    pub const STEEPEST_DEG: f64 = 90.0;
    /// 5 to 90 degrees: the upper hemisphere without views that graze the table.
    pub const DEFAULT: Band =
        Band { min_elevation_rad: 5.0 * std::f64::consts::PI / 180.0, max_elevation_rad: FRAC_PI_2 };

    /// The band between two elevations in degrees.
    ///
    /// # Errors
    /// Bounds that are no elevations, or in the wrong order.
    pub fn from_degrees(min_elevation_deg: f64, max_elevation_deg: f64) -> Result<Band, ViewsError> {
        let band = Band {
            min_elevation_rad: min_elevation_deg.to_radians(),
            max_elevation_rad: max_elevation_deg.to_radians(),
        };
        band.validate()?;
        Ok(band)
    }

    /// Checks that both bounds are elevations and in order.
    ///
    /// # Errors
    /// Names the bound that is not.
    pub fn validate(&self) -> Result<(), ViewsError> {
        let (min, max) = (self.min_elevation_rad, self.max_elevation_rad);
        // Degrees turned into radians and back may miss 90 by an ulp.
        let limit = Self::STEEPEST_DEG.to_radians() + 1e-12;
        for (field, value) in [("min_elevation", min), ("max_elevation", max)] {
            if !(value.abs() <= limit) {
                return Err(ViewsError::Elevation { field, value_deg: value.to_degrees() });
            }
        }
        if max < min {
            return Err(ViewsError::EmptyBand { min_deg: min.to_degrees(), max_deg: max.to_degrees() });
        }
        Ok(())
    }

    /// Whether `direction` lies in the band, give or take `tolerance_rad`.
    pub fn contains(&self, direction: &Direction, tolerance_rad: f64) -> bool {
        let (_, elevation) = azimuth_elevation_from_direction(direction);
        elevation >= self.min_elevation_rad - tolerance_rad
            && elevation <= self.max_elevation_rad + tolerance_rad
    }

    /// Heights on the unit sphere (sines) of the two bounds, rounded to 2^-40.
    ///
    /// Sines differ in their last bit from one C library to the next; rounding
    /// keeps that bit out of the packing, which is otherwise built from
    /// operations that IEEE 754 defines exactly.
    pub(super) fn heights(&self) -> (f64, f64) {
        let scale = (1u64 << 40) as f64;
        let height = |elevation: f64| (elevation.sin() * scale).round() / scale;
        (height(self.min_elevation_rad), height(self.max_elevation_rad))
    }
}

impl Default for Band {
    fn default() -> Self {
        Band::DEFAULT
    }
}

//! A dense lattice of a band.

use std::f64::consts::TAU;

use crate::geometry::{Direction, Vector};
use crate::views::Band;

/// Part of a turn from one direction of the spiral to the next: 2 - golden ratio, which keeps
/// neighbours apart at every number of directions.
const GOLDEN_TURN: f64 = 0.381_966_011_250_105_1;

/// Directions that cover a band evenly: its top first, a spiral of equal areas, and both rims,
/// where packings like to stand.
#[derive(Clone, Debug)]
pub struct Lattice {
    /// The band.
    pub band: Band,
    /// The directions.
    pub directions: Vec<Direction>,
    /// How many of them, from index 1 on, stand for equal areas of the band.
    pub equal_areas: usize,
    /// Angle between neighbours, about, radians.
    pub spacing_rad: f64,
}

impl Lattice {
    /// The lattice of `equal_areas` (at least 1) directions, the top and the rims beside them.
    pub fn new(band: Band, equal_areas: usize) -> Lattice {
        let equal_areas = equal_areas.max(1);
        let (low, high) = band.heights();
        let at = |z: f64, turn: f64| {
            let (sin, cos) = (turn * TAU).sin_cos();
            let radius = (1.0 - z * z).max(0.0).sqrt();
            Direction::new_normalize(Vector::new(radius * cos, radius * sin, z))
        };
        let spacing_rad = (TAU * (high - low) / equal_areas as f64).sqrt();
        let mut directions = vec![at(high, 0.0)];
        directions.extend((0..equal_areas).map(|i| {
            let share = (i as f64 + 0.5) / equal_areas as f64;
            at(high - (high - low) * share, (i as f64 * GOLDEN_TURN).fract())
        }));
        for rim in [low, high] {
            let length_rad = TAU * (1.0 - rim * rim).max(0.0).sqrt();
            // A band without area is all rim.
            let places = (length_rad / spacing_rad.max(1e-9)).ceil().min(equal_areas as f64) as usize;
            let first = usize::from(rim == high);
            if places > 4 {
                directions.extend((first..places).map(|i| at(rim, i as f64 / places as f64)));
            }
        }
        let spacing_rad = spacing_rad.max(TAU / equal_areas as f64);
        Lattice { band, directions, equal_areas, spacing_rad }
    }

    /// Share of the band's area where `usable`, the predicate direction by direction, holds.
    pub fn usable_share(&self, usable: &[bool]) -> f64 {
        let areas = usable.iter().skip(1).take(self.equal_areas);
        areas.filter(|usable| **usable).count() as f64 / self.equal_areas as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::views::covering_radius_rad;

    #[test]
    fn no_part_of_the_band_is_far_from_the_lattice_and_areas_are_counted_right() {
        for (low, high) in [(5.0, 90.0), (-40.0, 30.0), (60.0, 61.0)] {
            let band = Band::from_degrees(low, high).unwrap();
            let lattice = Lattice::new(band, 150);
            assert!(lattice.directions.iter().all(|direction| band.contains(direction, 1e-9)));
            let hole_rad = covering_radius_rad(&lattice.directions, band);
            assert!(hole_rad < 1.3 * lattice.spacing_rad, "{low} {high}: {hole_rad} {}", lattice.spacing_rad);
            let half: Vec<bool> = lattice.directions.iter().map(|d| d.x > 0.0).collect();
            assert!((lattice.usable_share(&half) - 0.5).abs() < 0.02);
        }
    }

    #[test]
    fn a_band_of_one_elevation_has_its_circle() {
        let band = Band::from_degrees(30.0, 30.0).unwrap();
        let lattice = Lattice::new(band, 100);
        assert!(covering_radius_rad(&lattice.directions, band) < 0.05);
    }
}

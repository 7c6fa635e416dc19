//! The part of the band that an arm reaches.

use std::f64::consts::TAU;

use super::dome::Dome;
use super::svg::number;

/// A grid over a band of elevations.
#[derive(Clone, Debug)]
pub struct ReachMap {
    /// Lower end of the band, radians above the horizontal plane.
    pub min_elevation_rad: f64,
    /// Upper end of the band, radians.
    pub max_elevation_rad: f64,
    /// By row and column. Rows divide the band evenly, lowest first; the middle of column 0 is
    /// azimuth 0 (+x), and columns go towards +y all the way round.
    pub reached: Vec<Vec<bool>>,
}

impl ReachMap {
    /// The reached cells as data of one SVG path.
    pub(super) fn path(&self, dome: &Dome) -> String {
        let mut data = String::new();
        let step = (self.max_elevation_rad - self.min_elevation_rad) / self.reached.len().max(1) as f64;
        for (row, cells) in self.reached.iter().enumerate() {
            let low = self.min_elevation_rad + step * row as f64;
            for (from, to) in runs(cells) {
                let azimuth = |column: usize| TAU * (column as f64 - 0.5) / cells.len() as f64;
                data += &sector(dome, (low, low + step), (azimuth(from), azimuth(to)));
            }
        }
        data
    }
}

/// Runs of reached cells, `from..to`, none longer than a third of the circle: an arc of SVG is told by
/// its ends, and near half a circle their rounding moves its middle by pixels.
fn runs(cells: &[bool]) -> Vec<(usize, usize)> {
    let longest = (cells.len() / 3).max(1);
    let mut runs: Vec<(usize, usize)> = Vec::new();
    for (column, _) in cells.iter().enumerate().filter(|(_, reached)| **reached) {
        match runs.last_mut() {
            Some((from, to)) if *to == column && column - *from < longest => *to += 1,
            _ => runs.push((column, column + 1)),
        }
    }
    runs
}

fn sector(dome: &Dome, (low, high): (f64, f64), (from, to): (f64, f64)) -> String {
    let (outer, inner) = (number(dome.radius(low)), number(dome.radius(high)));
    let at = |azimuth: f64, elevation: f64| dome.text_at(azimuth, elevation);
    format!(
        "M{}A{outer} {outer} 0 0 0 {}L{}A{inner} {inner} 0 0 1 {}Z",
        at(from, low),
        at(to, low),
        at(to, high),
        at(from, high)
    )
}

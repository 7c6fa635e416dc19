//! The long search: sets from far more starts than a request can wait for, kept in a file that
//! grows by a line a round.
//!
//! A line is `min_deg max_deg n round separation_deg | x y x y ...`; the coordinates, as in the
//! table of sets, stand only in lines of the default band.

use super::packing::{Effort, pack_series};
use super::table::{coordinates, directions};
use super::tammes::MAX_VIEWS;
use super::{Band, ViewSet, ViewsError};

/// What one round of the search found.
#[derive(Clone, Debug, PartialEq)]
pub struct SearchLine {
    /// Lowest and highest elevation of the band, degrees.
    pub band_deg: (f64, f64),
    /// Number of views.
    pub count: usize,
    /// Which round, from 0; each has random draws of its own.
    pub round: u16,
    /// The set's separation, degrees.
    pub separation_deg: f64,
    /// The set, where the line holds it.
    pub set: Option<ViewSet>,
}

/// Runs round `round` for `count` views between two elevations, degrees: some seconds at a hundred
/// views. The same arguments give the same line on every machine.
///
/// # Errors
/// A count or a band out of range.
pub fn search_round(band_deg: (f64, f64), count: usize, round: u16) -> Result<SearchLine, ViewsError> {
    if !(1..=MAX_VIEWS).contains(&count) {
        return Err(ViewsError::Count { count, min: 1, max: MAX_VIEWS });
    }
    let band = Band::from_degrees(band_deg.0, band_deg.1)?;
    let set = ViewSet::from_directions(pack_series(count, band, Effort::ROUND, round));
    let separation_deg = set.separation_rad.to_degrees();
    Ok(SearchLine { band_deg, count, round, separation_deg, set: Some(set) })
}

impl SearchLine {
    /// The line's text, without line break.
    pub fn to_text(&self) -> String {
        let (low, high) = self.band_deg;
        let kept = self.set.as_ref().filter(|_| is_default(self.band_deg));
        let coordinates = kept.map(|set| coordinates(&set.directions)).unwrap_or_default();
        format!("{low} {high} {} {} {:.7} |{coordinates}", self.count, self.round, self.separation_deg)
    }

    /// The line of this text; `None` for a comment, an empty or a broken line (the last one of a
    /// search that was killed).
    pub fn parse(text: &str) -> Option<SearchLine> {
        let (head, coordinates) = text.split_once('|')?;
        let mut words = head.split_ascii_whitespace();
        let band_deg = (words.next()?.parse().ok()?, words.next()?.parse().ok()?);
        let count = words.next()?.parse().ok()?;
        let round = words.next()?.parse().ok()?;
        let separation_deg = words.next()?.parse().ok()?;
        let set = if is_default(band_deg) {
            let found = directions(coordinates).filter(|found| found.len() == count)?;
            Some(ViewSet::from_directions(found))
        } else {
            None
        };
        Some(SearchLine { band_deg, count, round, separation_deg, set })
    }
}

fn is_default(band_deg: (f64, f64)) -> bool {
    Band::from_degrees(band_deg.0, band_deg.1) == Ok(Band::DEFAULT)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_survives_the_file_and_a_broken_one_is_none() {
        let line = search_round((5.0, 90.0), 7, 1).unwrap();
        let text = line.to_text();
        let read = SearchLine::parse(&text).unwrap();
        assert_eq!((read.count, read.round, read.band_deg), (7, 1, (5.0, 90.0)));
        let set = read.set.unwrap();
        assert!((set.separation_rad.to_degrees() - line.separation_deg).abs() < 2e-6);
        let cut = text.rsplit_once(' ').unwrap().0;
        assert_eq!(SearchLine::parse(cut), None);
        assert_eq!(SearchLine::parse("# a heading"), None);
    }

    #[test]
    fn rounds_are_different_searches_of_one_packing() {
        let [a, b] = [0, 1].map(|round| search_round((10.0, 80.0), 12, round).unwrap());
        assert_ne!(a.set, b.set);
        assert!((a.separation_deg - b.separation_deg).abs() < 0.01 * a.separation_deg);
    }
}

//! The best separations known, from a search far longer than a request can wait for.

use super::Band;

/// Lines `min_deg max_deg n separation_deg rounds`, made by `prv views --search`.
const BEST_KNOWN: &str = include_str!("best_known.txt");

/// The largest separation known, radians, of `count` views on `band` with one at its top; `None`
/// for bands and counts that were not searched. 0 to 90, 5 to 90 and 10 to 80 degrees were, from 3
/// to 100 views.
pub fn best_known_rad(count: usize, band: Band) -> Option<f64> {
    BEST_KNOWN.lines().find_map(|line| {
        let mut words = line.split_ascii_whitespace();
        let (low, high) = (words.next()?.parse().ok()?, words.next()?.parse().ok()?);
        let n: usize = words.next()?.parse().ok()?;
        let separation_deg: f64 = words.next()?.parse().ok()?;
        let matches = n == count && Band::from_degrees(low, high) == Ok(band);
        matches.then(|| separation_deg.to_radians())
    })
}

//! The best separations known, from two rounds of a search that takes some seconds a set, longer than a request can
//! wait for. The second round found at most 0.13 % more than the first.

use super::Band;

/// Lines `min_deg max_deg n separation_deg rounds`, made by `prv views --search`.
const BEST_KNOWN: &str = include_str!("best_known.txt");

/// The largest separation known, radians, of `count` views on `band` with one at its top; `None`
/// for bands and counts that were not searched.
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::views::tammes;

    #[test]
    fn the_table_comes_within_a_thousandth_of_the_best_known() {
        for count in 3..=100 {
            let best_rad = best_known_rad(count, Band::DEFAULT).unwrap();
            let share = tammes(count, Band::DEFAULT).unwrap().separation_rad / best_rad;
            assert!((0.999..1.0 + 1e-6).contains(&share), "{count}: {share}");
        }
    }

    #[test]
    fn more_views_are_never_farther_apart() {
        for (low, high) in [(0.0, 90.0), (5.0, 90.0), (10.0, 80.0)] {
            let band = Band::from_degrees(low, high).unwrap();
            let best: Vec<f64> = (3..=100).map_while(|count| best_known_rad(count, band)).collect();
            assert!(best.len() == 98, "{low} to {high}: {}", best.len());
            assert!(best.is_sorted_by(|a, b| *b <= a + 1e-9), "{low} to {high}");
        }
        assert_eq!(best_known_rad(20, Band::from_degrees(20.0, 90.0).unwrap()), None);
    }
}

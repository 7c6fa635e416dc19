//! The committed sets for the default band: best of a longer search than a request could wait for.
//!
//! One line per number of views: `n separation_deg best_deg share generator_share | x y x y ...`,
//! the directions from the second on (the first is the pole) with x and y in units of 1e-10 (z
//! follows, it is never negative). `best_deg` is the best separation known from the long search
//! (`-` where there was none), `share` the set's separation divided by it, `generator_share` the
//! separation that the generator reaches at request time divided by the set's.

use std::fmt::Write;

use super::packing::{Effort, pack_for};
use super::{Band, MAX_VIEWS, SearchLine, ViewSet, best_known_rad};
use crate::geometry::{Direction, Vector};

const TABLE: &str = include_str!("table_5_90.txt");
/// Length of one unit of the table's numbers.
const UNIT: f64 = 1e-10;
/// A point of the table this near to the rim stands on it: its height was lost to the units.
const AT_RIM: f64 = 1e-8;

/// The set of `n` views for [`Band::DEFAULT`], if the table holds it.
pub(super) fn look_up(n: usize) -> Option<Vec<Direction>> {
    let line = TABLE.lines().filter(|line| !line.starts_with('#')).nth(n.checked_sub(1)?)?;
    let (head, coordinates) = line.split_once('|')?;
    if head.split(' ').next()?.parse() != Ok(n) {
        return None;
    }
    directions(coordinates).filter(|found| found.len() == n)
}

/// The directions of a line's coordinates, the pole first.
pub(super) fn directions(coordinates: &str) -> Option<Vec<Direction>> {
    let rim = Band::DEFAULT.heights().0;
    let mut directions = vec![Vector::z_axis()];
    let mut numbers = coordinates.split_ascii_whitespace();
    while let Some(x) = numbers.next() {
        let (x, y) =
            (x.parse::<i64>().ok()? as f64 * UNIT, numbers.next()?.parse::<i64>().ok()? as f64 * UNIT);
        let horizontal = x * x + y * y;
        let z = (1.0 - horizontal).max(0.0).sqrt();
        let (z, scale) =
            if z < rim + AT_RIM { (rim, ((1.0 - rim * rim) / horizontal).sqrt()) } else { (z, 1.0) };
        directions.push(Direction::new_normalize(Vector::new(x * scale, y * scale, z)));
    }
    Some(directions)
}

/// The coordinates of all `directions` but the first, each after a space.
pub(super) fn coordinates(directions: &[Direction]) -> String {
    let mut text = String::new();
    for direction in directions.iter().skip(1) {
        // Writing to a string cannot fail.
        let _ = write!(text, " {} {}", (direction.x / UNIT).round(), (direction.y / UNIT).round());
    }
    text
}

/// Generates the table's lines anew (minutes), handing over each with the number of its views; 0
/// is the heading's.
///
/// # Errors
/// Those of `line`, which end the work.
pub fn generate_table<E>(mut line: impl FnMut(usize, &str) -> Result<(), E>) -> Result<(), E> {
    line(
        0,
        "# Views for elevations 5 to 90 deg, written by `prv views --table`; src/views/table.rs tells the format.",
    )?;
    for n in 1..=MAX_VIEWS {
        let [quick, set] = pack_for(n, Band::DEFAULT, [Effort::INTERACTIVE, Effort::THOROUGH], 0)
            .map(ViewSet::from_directions);
        let share = quick.separation_rad / set.separation_rad;
        let (separation_deg, coordinates) = (set.separation_rad.to_degrees(), coordinates(&set.directions));
        let best = known(best_known_rad(n, Band::DEFAULT), set.separation_rad);
        line(n, &format!("{n} {separation_deg:.7} {best} {share:.6} |{coordinates}"))?;
    }
    Ok(())
}

/// The committed table's lines with those sets replaced for which the search has found better ones.
pub fn improved_table(found: &[SearchLine]) -> Vec<String> {
    let line = |text: &str| -> Option<String> {
        if text.starts_with('#') {
            return Some(text.to_owned());
        }
        let (head, _) = text.split_once('|')?;
        let count = head.split(' ').next()?.parse().ok()?;
        let generator_share: f64 = head.split_ascii_whitespace().last()?.parse().ok()?;
        let old = ViewSet::from_directions(look_up(count)?);
        let sets = found.iter().filter(|line| line.count == count).filter_map(|line| line.set.as_ref());
        let best = sets.max_by(|a, b| a.separation_rad.total_cmp(&b.separation_rad));
        let set = best.filter(|set| set.separation_rad > old.separation_rad * (1.0 + 1e-8)).unwrap_or(&old);
        let searched = best.map(|_| set.separation_rad).or(best_known_rad(count, Band::DEFAULT));
        Some(format!(
            "{count} {:.7} {} {:.6} |{}",
            set.separation_rad.to_degrees(),
            known(searched, set.separation_rad),
            generator_share * old.separation_rad / set.separation_rad,
            coordinates(&set.directions)
        ))
    };
    TABLE.lines().filter_map(line).collect()
}

/// `best_deg share` of a set.
fn known(best_rad: Option<f64>, separation_rad: f64) -> String {
    match best_rad {
        Some(best) => format!("{:.7} {:.6}", best.to_degrees(), separation_rad / best),
        None => "- -".to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::views::packing::pack;

    #[test]
    fn the_table_holds_every_number_of_views_as_well_separated_as_it_says() {
        for line in TABLE.lines().filter(|line| !line.starts_with('#')) {
            let mut head = line.split(' ');
            let n: usize = head.next().unwrap().parse().unwrap();
            let separation_deg: f64 = head.next().unwrap().parse().unwrap();
            let set = ViewSet::from_directions(look_up(n).unwrap());
            assert_eq!(set.directions.len(), n);
            assert_eq!(set.directions[0], Vector::z_axis());
            assert!(set.directions.iter().all(|direction| Band::DEFAULT.contains(direction, 1e-9)));
            assert!((set.separation_rad.to_degrees() - separation_deg).abs() < 2e-6, "{n}");
        }
        assert_eq!(TABLE.lines().filter(|line| !line.starts_with('#')).count(), MAX_VIEWS);
    }

    #[test]
    fn the_generator_alone_comes_close_to_the_table() {
        for n in [5, 12, 35] {
            let table = ViewSet::from_directions(look_up(n).unwrap());
            let generated = ViewSet::from_directions(pack(n, Band::DEFAULT, Effort::INTERACTIVE));
            assert!(generated.separation_rad > 0.997 * table.separation_rad, "{n}");
        }
    }
}

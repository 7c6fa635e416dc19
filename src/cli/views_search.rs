//! `prv views --search FILE`: rounds of a long search for well separated sets, and what became of it.

use std::collections::{BTreeMap, HashSet};
use std::io::Write;
use std::path::Path;

use indicatif::{ProgressBar, ProgressStyle};
use prv::views::{SearchLine, improved_table, search_round};

use super::CliResult;

/// Numbers of views searched when none are named.
const COUNTS: std::ops::RangeInclusive<usize> = 3..=100;

/// Appends the lines of all rounds that `file` does not hold yet.
pub(super) fn run(file: &Path, band_deg: (f64, f64), counts: &[usize], rounds: u16) -> CliResult {
    let counts = if counts.is_empty() { COUNTS.collect() } else { counts.to_vec() };
    let known = std::fs::read_to_string(file).unwrap_or_default();
    let of_band = known.lines().filter_map(SearchLine::parse).filter(|line| line.band_deg == band_deg);
    let done: HashSet<(u16, usize)> = of_band.map(|line| (line.round, line.count)).collect();
    let mut out = std::fs::OpenOptions::new().create(true).append(true).open(file)?;
    if !known.is_empty() && !known.ends_with('\n') {
        // What a kill left of a line stays one, and is skipped.
        writeln!(out)?;
    }
    let bar = ProgressBar::new(u64::from(rounds) * counts.len() as u64);
    if let Ok(style) = ProgressStyle::with_template("{wide_bar} {pos}/{len} sets, {eta} left") {
        bar.set_style(style);
    }
    for round in 0..rounds {
        for count in counts.iter().filter(|count| !done.contains(&(round, **count))) {
            writeln!(out, "{}", search_round(band_deg, *count, round)?.to_text())?;
            bar.inc(1);
        }
    }
    bar.finish_and_clear();
    Ok(())
}

/// Prints `min_deg max_deg n separation_deg rounds` of the best sets in `file`.
pub(super) fn summary(file: &Path) -> CliResult {
    let mut best: BTreeMap<(String, usize), (f64, usize)> = BTreeMap::new();
    for line in std::fs::read_to_string(file)?.lines().filter_map(SearchLine::parse) {
        let band = format!("{} {}", line.band_deg.0, line.band_deg.1);
        let (separation_deg, rounds) = best.entry((band, line.count)).or_insert((0.0, 0));
        *separation_deg = separation_deg.max(line.separation_deg);
        *rounds += 1;
    }
    for ((band, count), (separation_deg, rounds)) in best {
        println!("{band} {count} {separation_deg:.7} {rounds}");
    }
    Ok(())
}

/// Prints the table of sets with the better ones of `file`.
pub(super) fn improve(file: &Path) -> CliResult {
    let found: Vec<SearchLine> =
        std::fs::read_to_string(file)?.lines().filter_map(SearchLine::parse).collect();
    improved_table(&found).iter().for_each(|line| println!("{line}"));
    Ok(())
}

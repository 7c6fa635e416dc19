//! Planning and checking random cells, many of them, over as many runs as it takes.

use std::collections::{BTreeMap, BTreeSet};
use std::io::Write;
use std::path::Path;

use indicatif::{ProgressBar, ProgressStyle};
use prv::plan::RandomCells;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::check::Verdict;

/// Seeds that are run and logged together.
const CHUNK: u64 = 100;

/// A run over seeds.
pub struct Run<'a> {
    /// First seed.
    pub first: u64,
    /// Number of seeds.
    pub count: u64,
    /// Most views of a cell.
    pub most_views: usize,
    /// File of counts to append to.
    pub log: Option<&'a Path>,
    /// Whether to print JSON.
    pub json: bool,
}

/// Counts over seeds.
#[derive(Default, Serialize, Deserialize)]
struct Counts {
    first_seed: u64,
    cells: u64,
    most_views: usize,
    planned: usize,
    skipped: BTreeMap<String, usize>,
    detours: usize,
    refused: usize,
    /// Seed and reason of each refused request.
    #[serde(default)]
    refusals: Vec<(u64, String)>,
    /// Seed and the first finding of each plan with one.
    violations: Vec<(u64, String)>,
}

impl Run<'_> {
    /// Runs what is not logged yet; whether every cell got a plan, and no plan has a violation.
    pub fn start(&self) -> Verdict {
        let mut total = Counts { first_seed: self.first, most_views: self.most_views, ..Counts::default() };
        let mut known = BTreeSet::new();
        for counts in self.logged()? {
            let inside = counts.first_seed >= self.first
                && counts.first_seed + counts.cells <= self.first.saturating_add(self.count);
            if inside && counts.most_views == self.most_views && known.insert(counts.first_seed) {
                total.add(counts);
            }
        }
        let end = self.first.saturating_add(self.count);
        let style = ProgressStyle::with_template("{bar:40} {pos}/{len} cells, {eta} left, {msg}")?;
        let bar = ProgressBar::new(self.count).with_style(style);
        for first in (self.first..end).step_by(CHUNK as usize) {
            bar.set_position(first - self.first);
            bar.set_message(format!("{} violations", total.violations.len()));
            if known.contains(&first) {
                continue;
            }
            let counts = self.chunk(first, end.min(first + CHUNK));
            for (seed, finding) in &counts.violations {
                bar.suspend(|| eprintln!("seed {seed}: {finding}"));
            }
            for (seed, reason) in &counts.refusals {
                bar.suspend(|| eprintln!("seed {seed} refused: {reason}"));
            }
            if let Some(path) = self.log {
                let mut file = std::fs::OpenOptions::new().create(true).append(true).open(path)?;
                writeln!(file, "{}", serde_json::to_string(&counts)?)?;
            }
            total.add(counts);
        }
        bar.finish_and_clear();
        total.print(self.json)?;
        Ok(total.violations.is_empty() && total.refusals.is_empty())
    }

    fn logged(&self) -> Result<Vec<Counts>, Box<dyn std::error::Error>> {
        let Some(path) = self.log else { return Ok(Vec::new()) };
        match std::fs::read_to_string(path) {
            // A line that a kill cut off is run again.
            Ok(text) => Ok(text.lines().filter_map(|line| serde_json::from_str(line).ok()).collect()),
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => Ok(Vec::new()),
            Err(error) => Err(format!("{}: {error}", path.display()).into()),
        }
    }

    fn chunk(&self, first: u64, end: u64) -> Counts {
        let cells = RandomCells { most_views: self.most_views };
        let outcomes: Vec<_> = (first..end).into_par_iter().map(|seed| (seed, cells.run(seed))).collect();
        let mut counts = Counts {
            first_seed: first,
            cells: end - first,
            most_views: self.most_views,
            ..Counts::default()
        };
        for (seed, outcome) in outcomes {
            counts.planned += outcome.planned;
            counts.detours += outcome.detours;
            if let Some(reason) = outcome.refused {
                counts.refused += 1;
                counts.refusals.push((seed, reason));
            }
            for (code, count) in outcome.skipped {
                *counts.skipped.entry(code.to_owned()).or_insert(0) += count;
            }
            if let Some(finding) = outcome.findings.first() {
                let more = outcome.findings.len() - 1;
                counts
                    .violations
                    .push((seed, format!("{}: {} (and {more} more)", finding.code, finding.message)));
            }
        }
        counts
    }
}

impl Counts {
    fn add(&mut self, other: Counts) {
        self.cells += other.cells;
        self.planned += other.planned;
        self.detours += other.detours;
        self.refused += other.refused;
        self.refusals.extend(other.refusals);
        for (code, count) in other.skipped {
            *self.skipped.entry(code).or_insert(0) += count;
        }
        self.violations.extend(other.violations);
    }

    fn print(&self, json: bool) -> Result<(), serde_json::Error> {
        if json {
            println!("{}", serde_json::to_string(self)?);
            return Ok(());
        }
        println!(
            "{} cells: {} views planned, {} detours, {} requests refused",
            self.cells, self.planned, self.detours, self.refused
        );
        self.skipped.iter().for_each(|(code, count)| println!("{count} views skipped: {code}"));
        self.refusals.iter().for_each(|(seed, reason)| println!("seed {seed} refused: {reason}"));
        self.violations.iter().for_each(|(seed, finding)| println!("seed {seed}: {finding}"));
        println!("{} plans with violations", self.violations.len());
        Ok(())
    }
}

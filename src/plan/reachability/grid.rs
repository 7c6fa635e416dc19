//! The band in rows and columns.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use crate::geometry::{Pose, direction_from_azimuth_elevation};
use crate::plan::asks::Asks;
use crate::views::ViewSpace;

/// The code of cells that were not answered before the work ended.
pub(super) const WORK_LIMIT: &str = "work_limit";

/// The code of every cell's middle.
pub(super) struct Grid {
    pub(super) elevations_rad: Vec<f64>,
    pub(super) azimuths_rad: Vec<f64>,
    pub(super) codes: Vec<Vec<Option<&'static str>>>,
    /// Share of the band's area in each row.
    shares: Vec<f64>,
}

impl Grid {
    pub(super) fn ask(asks: &mut Asks, space: &ViewSpace, rows: usize, columns: usize) -> Grid {
        let (low, high) = (space.band.min_elevation_rad, space.band.max_elevation_rad);
        let edge = |row: usize| low + (high - low) * row as f64 / rows as f64;
        let elevations_rad: Vec<f64> = (0..rows).map(|row| 0.5 * (edge(row) + edge(row + 1))).collect();
        let azimuths_rad: Vec<f64> =
            (0..columns).map(|column| TAU * column as f64 / columns as f64).collect();
        let area = high.sin() - low.sin();
        let share = |row: usize| match area > 0.0 {
            true => (edge(row + 1).sin() - edge(row).sin()) / area,
            false => 1.0 / rows as f64,
        };
        let shares = (0..rows).map(share).collect();
        let pose = |cell: usize| {
            let elevation_rad = elevations_rad.get(cell / columns).copied().unwrap_or(low);
            let azimuth_rad = TAU * (cell % columns) as f64 / columns as f64;
            space.pose(&direction_from_azimuth_elevation(azimuth_rad, elevation_rad), 0.0)
        };
        let poses: Vec<Pose> = (0..rows * columns).map(pose).collect();
        let reasons = asks.ask(&poses, |probe, pose| probe.reason(pose).map(|reason| reason.code()));
        let cells: Vec<Option<&'static str>> =
            reasons.into_iter().map(|reason| reason.unwrap_or(Some(WORK_LIMIT))).collect();
        let codes = cells.chunks(columns).map(<[_]>::to_vec).collect();
        Grid { elevations_rad, azimuths_rad, codes, shares }
    }

    pub(super) fn fraction(&self) -> f64 {
        self.by_row().iter().zip(&self.shares).map(|(reached, share)| reached * share).sum()
    }

    pub(super) fn by_row(&self) -> Vec<f64> {
        let reached = |row: &Vec<Option<_>>| row.iter().filter(|code| code.is_none()).count() as f64;
        self.codes.iter().map(|row| reached(row) / row.len().max(1) as f64).collect()
    }

    pub(super) fn by_column(&self) -> Vec<f64> {
        let reached = |column: usize| {
            let rows = self.codes.iter().zip(&self.shares);
            rows.filter(|(row, _)| row.get(column) == Some(&None)).map(|(_, share)| share).sum()
        };
        (0..self.azimuths_rad.len()).map(reached).collect()
    }

    pub(super) fn counts(&self) -> BTreeMap<&'static str, usize> {
        let mut counts = BTreeMap::new();
        self.codes.iter().flatten().flatten().for_each(|code| *counts.entry(*code).or_default() += 1);
        counts
    }
}

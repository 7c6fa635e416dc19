//! Which part of the band an arm can serve, direction by direction, and where the object would be
//! served better.

mod grid;
mod suggest;

use std::collections::BTreeMap;
use std::time::{Duration, Instant};

use super::asks::Asks;
use super::bounds::MOST_ROWS_AND_COLUMNS;
use super::{PlanError, PlanRequest, Warning, cell, check, work_bound};
use crate::geometry::Point;
use crate::motion::{Allowance, MotionError, Reach, Stop};

/// Rows and columns of the grid, when the request names none.
const RESOLUTION: (usize, usize) = (17, 36);
/// The same for arms whose inverse kinematics are searched for numerically: milliseconds a pose.
const RESOLUTION_NUMERIC: (usize, usize) = (6, 12);
/// Most cells of the grid, and of that for arms of numeric kinematics.
const MOST_CELLS: (usize, usize) = (16_200, 648);

/// Part of the work that may go into the grid; the rest is for places of the object.
const GRID: f64 = 0.6;

/// What an arm can reach of the band about an object.
#[derive(Clone, Debug)]
pub struct Reachability {
    /// Middle elevation of each row, lowest first, radians.
    pub elevations_rad: Vec<f64>,
    /// Middle azimuth of each column, from 0 (the base's x axis) on, radians.
    pub azimuths_rad: Vec<f64>,
    /// By row and column: `None` where the view can be taken, else the code of the reason.
    pub grid: Vec<Vec<Option<&'static str>>>,
    /// Reachable part of the band's area, 0 to 1.
    pub fraction: f64,
    /// Reachable part of each row.
    pub by_elevation: Vec<f64>,
    /// Reachable part of the area of each column.
    pub by_azimuth: Vec<f64>,
    /// Cells by reason.
    pub counts: BTreeMap<&'static str, usize>,
    /// The object's place as given, judged as the suggestions are.
    pub given: Place,
    /// Up to three other places, best first, at least 5 cm from each other.
    pub suggestions: Vec<Place>,
    /// What the caller should know.
    pub warnings: Vec<Warning>,
    /// Time by step.
    pub timings: Vec<(&'static str, Duration)>,
}

/// A place for the object.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// The object's centre, metres.
    pub center_in_base: Point,
    /// Reachable part of the band about it, 0 to 1, estimated from some 200 directions.
    pub fraction: f64,
}

/// Asks for every cell of a grid over the band of `request` whether its arm can take the view
/// there, and searches for places of the object on the same table that serve more of the band.
/// The number of views and photos of the request do not matter.
///
/// # Errors
/// Those of the request's check; no robot; a resolution out of its bounds.
pub fn reachability(
    request: &PlanRequest,
    elevations: Option<usize>,
    azimuths: Option<usize>,
) -> Result<Reachability, PlanError> {
    reachability_until(request, elevations, azimuths, &Stop::default())
}

/// [`reachability`], which ends with [`MotionError::Stopped`] soon after `stop` is asked for.
///
/// # Errors
/// Those of [`reachability`].
pub fn reachability_until(
    request: &PlanRequest,
    elevations: Option<usize>,
    azimuths: Option<usize>,
    stop: &Stop,
) -> Result<Reachability, PlanError> {
    let begin = Instant::now();
    let mut warnings = check(request)?;
    let Some(arm) = &request.arm else {
        return Err(PlanError::missing("robot", "given: reachability is a matter of the arm"));
    };
    let cell = cell(request, arm);
    let reach = Reach::new(&cell, arm.roll, arm.start_rad.as_deref())?;
    let default = if reach.is_quick() { RESOLUTION } else { RESOLUTION_NUMERIC };
    let rows = within("elevations", elevations.unwrap_or(default.0), MOST_ROWS_AND_COLUMNS.0)?;
    let columns = within("azimuths", azimuths.unwrap_or(default.1), MOST_ROWS_AND_COLUMNS.1)?;
    let most_cells = if reach.is_quick() { MOST_CELLS.0 } else { MOST_CELLS.1 };
    within("azimuths", rows * columns, most_cells).map_err(|_| {
        let most = most_cells / rows;
        PlanError::number(
            "out_of_range",
            "azimuths",
            columns as f64,
            format!("from 1 to {most} at {rows} elevations"),
        )
    })?;
    work_bound::of_poses(request, arm, rows * columns, "cells of the grid")?;
    let space = request.view_space();
    let all = Allowance::plan(stop);
    let mut asks = Asks::new(&reach, all.share(GRID));
    let grid = grid::Grid::ask(&mut asks, &space, rows, columns);
    let asked = begin.elapsed();
    let mut judge = suggest::Judge { request, arm, reach: &reach, left: all.share(1.0 - GRID) };
    let given = suggest::given(&mut judge);
    let suggestions = if reach.is_quick() {
        suggest::suggest(&mut judge, &given)
    } else {
        warnings.push(Warning::new(
            "no_suggestions",
            "no other places are suggested for arms whose inverse kinematics are searched for numerically",
        ));
        Vec::new()
    };
    if stop.is_asked() {
        return Err(MotionError::Stopped.into());
    }
    let counts = grid.counts();
    if let Some(open) = counts.get(grid::WORK_LIMIT) {
        let text = format!(
            "the cell is so hard that the work ended before {open} of {} cells of the grid were answered: they \
             count as out of reach",
            rows * columns
        );
        warnings.push(Warning::new("work_limit", text));
    }
    if judge.left.is_over() {
        let text = "the cell is so hard that the work ended before all places for the object were looked at";
        warnings.push(Warning::new("work_limit", text));
    }
    Ok(Reachability {
        fraction: grid.fraction(),
        by_elevation: grid.by_row(),
        by_azimuth: grid.by_column(),
        counts,
        elevations_rad: grid.elevations_rad,
        azimuths_rad: grid.azimuths_rad,
        grid: grid.codes,
        given,
        suggestions,
        warnings,
        timings: vec![("grid", asked), ("suggestions", begin.elapsed() - asked), ("total", begin.elapsed())],
    })
}

fn within(field: &str, value: usize, most: usize) -> Result<usize, PlanError> {
    if (1..=most).contains(&value) {
        return Ok(value);
    }
    Err(PlanError::number("out_of_range", field, value as f64, format!("from 1 to {most}")))
}

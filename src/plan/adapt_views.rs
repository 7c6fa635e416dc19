//! Views that suit the arm: those it cannot reach are spread again over the part of the band it can.

use std::time::{Duration, Instant};

use super::arm_path::{ArmPath, Asked, arm_path};
use super::asks::Asks;
use super::survey::{Survey, from_neighbours};
use super::view_poses::ViewPoses;
use super::{
    Arm, Coverage, CoverageReport, PlanError, PlanRequest, UnreachableViews, ViewStatus, cell, replaced,
};
use crate::geometry::{Direction, Pose};
use crate::motion::{Allowance, Cell, KnownState, Objective, Reach, Stop, Timing};
use crate::views::{ViewSpace, covering_radius_rad, separation_rad, spread};

/// How often the moves of views off the lattice may ask an arm whose inverse kinematics are searched for.
const ASKED_NUMERIC: usize = 4000;
/// How often views are spread again because no way to some was found.
const MORE_ROUNDS: usize = 2;
/// Parts of the work that may go into the set as it is, and into the search for what is reachable.
const FIRST: f64 = 0.35;
const SEARCH: f64 = 0.3;
/// Reachable views of the set that take the place of missing ones keep this far from the others, as
/// a part of the set's separation.
const APART: f64 = 0.5;

/// Plans the motion through the views of `set` or, where some cannot be reached and the request
/// allows it, through as many that can.
///
/// The set as it is is planned first. What is planned instead is at least as many views and, of as
/// many, leaves no larger hole.
pub(super) fn adapted_path(
    request: &PlanRequest,
    arm: &Arm,
    set: &ViewPoses,
    end_at_top: bool,
    stop: &Stop,
) -> Result<(ArmPath, Option<CoverageReport>), PlanError> {
    let cell = cell(request, arm);
    let rounds = Rounds { request, arm, cell: &cell, end_at_top };
    let all = Allowance::plan(stop);
    let Some(directions) = &set.directions else {
        return Ok((rounds.path(&set.poses, &[], false, all)?, None));
    };
    let space = request.view_space();
    if arm.unreachable_views == UnreachableViews::Skip {
        let path = rounds.path(&set.poses, &[], false, all)?;
        let planned = coverage(&taken(directions, &path.statuses), &space);
        return Ok((
            path,
            Some(CoverageReport { before: planned, after: planned, reachable_fraction: None }),
        ));
    }
    let mut clock = Stopwatch::start();
    let reach = Reach::new(&cell, arm.roll, arm.start_rad.as_deref())?;
    let mut asks = Asks::new(&reach, all.share(SEARCH));
    let searching = asks.left.most;
    let answers = asks.ask(&set.poses, |probe, pose| probe.reaches(pose));
    let whole = answers.iter().all(|answer| *answer == Some(true));
    // A set that will be replaced is planned for its views alone.
    clock.pause();
    let first = rounds.path(&set.poses, &[], !whole, all.share(FIRST))?;
    let mut spent = first.work;
    let before = coverage(&taken(directions, &first.statuses), &space);
    if before.views == directions.len() {
        return Ok((first, Some(CoverageReport { before, after: before, reachable_fraction: None })));
    }
    let statuses = first.statuses.clone();
    clock.go_on();
    let survey = Survey::ask(&reach, &space, directions.len(), &mut asks);
    let fraction = survey.fraction;
    let mut adapter = Adapter { reach: &reach, space, survey, excluded: Vec::new(), asks };
    if whole {
        adapter.exclude(&without_way(&statuses, directions), separation_rad(directions));
    }
    let mut best = Round { path: first, at: directions.clone(), coverage: before };
    let mut dropped = Duration::ZERO;
    for _ in 0..=MORE_ROUNDS {
        let Some((at, known)) = adapter.views(directions, &statuses, before.views) else { break };
        clock.pause();
        let left = all.less(spent + searching - adapter.asks.left.most);
        let path = rounds.path(&poses(&space, &at), &known, false, left)?;
        clock.go_on();
        spent += path.work;
        let lost = without_way(&path.statuses, &at);
        let found = Round { coverage: coverage(&taken(&at, &path.statuses), &space), path, at };
        adapter.exclude(&lost, separation_rad(&found.at));
        let (count, better) = (found.at.len(), found.is_better_than(&best));
        let other = if better { std::mem::replace(&mut best, found) } else { found };
        dropped += other.path.time();
        // Where most views are cut off it is the whole that is: leaving places out cannot help.
        if lost.is_empty() || 2 * lost.len() > count {
            break;
        }
    }
    let report = CoverageReport { before, after: best.coverage, reachable_fraction: Some(fraction) };
    let is_replaced = best.at != *directions;
    let mut path = best.path;
    if is_replaced {
        path.warnings.push(replaced::warning(&report, &statuses, arm.roll));
    } else if !whole {
        dropped += path.time();
        let left = all.less(spent + searching - adapter.asks.left.most);
        path = rounds.path(&set.poses, &[], false, left)?;
    }
    path.timings.extend([("adapt", clock.elapsed()), ("dropped_motions", dropped)]);
    Ok((path, Some(report)))
}

/// What all rounds have in common.
struct Rounds<'a> {
    request: &'a PlanRequest,
    arm: &'a Arm,
    cell: &'a Cell,
    end_at_top: bool,
}

impl Rounds<'_> {
    /// A draft tells which views can be taken: the way between them and its samples are of no use.
    fn path(
        &self,
        poses: &[Pose],
        known: &[Option<KnownState>],
        is_draft: bool,
        allowance: Allowance,
    ) -> Result<ArmPath, PlanError> {
        let (objective, timing) = match is_draft {
            false => (self.arm.objective, self.arm.timing),
            true => (
                Objective::Distance,
                Timing { sample_period_s: Timing::SAMPLE_PERIOD_S.1, ..self.arm.timing },
            ),
        };
        let asked = Asked { poses, known, end_at_top: self.end_at_top, objective, timing, allowance };
        arm_path(self.request, self.arm, self.cell, &asked)
    }
}

/// A set of views and the motion through it.
struct Round {
    path: ArmPath,
    at: Vec<Direction>,
    /// Of the planned views.
    coverage: Coverage,
}

impl Round {
    /// More views, or as many and a smaller hole.
    fn is_better_than(&self, other: &Round) -> bool {
        let (this, other) = (&self.coverage, &other.coverage);
        this.views > other.views
            || (this.views == other.views && this.largest_hole_rad < other.largest_hole_rad)
    }
}

fn poses(space: &ViewSpace, directions: &[Direction]) -> Vec<Pose> {
    directions.iter().map(|direction| space.pose(direction, 0.0)).collect()
}

fn taken(at: &[Direction], statuses: &[ViewStatus]) -> Vec<Direction> {
    let planned = at.iter().zip(statuses).filter(|(_, status)| **status == ViewStatus::Planned);
    planned.map(|(direction, _)| *direction).collect()
}

fn has_code(status: &ViewStatus, code: &str) -> bool {
    matches!(status, ViewStatus::Skipped(reason) if reason.code == code)
}

fn without_way(statuses: &[ViewStatus], at: &[Direction]) -> Vec<Direction> {
    let lost = at.iter().zip(statuses).filter(|(_, status)| has_code(status, "no_path"));
    lost.map(|(direction, _)| *direction).collect()
}

/// How well `directions` are spread over the whole band.
fn coverage(directions: &[Direction], space: &ViewSpace) -> Coverage {
    Coverage {
        views: directions.len(),
        separation_rad: separation_rad(directions),
        largest_hole_rad: covering_radius_rad(directions, space.band),
    }
}

/// Finds views that can be reached.
struct Adapter<'a> {
    reach: &'a Reach<'a>,
    space: ViewSpace,
    survey: Survey,
    /// Directions without a way to them, and how far around nothing is tried, radians.
    excluded: Vec<(Direction, f64)>,
    asks: Asks<'a>,
}

impl Adapter<'_> {
    fn exclude(&mut self, lost: &[Direction], apart_rad: f64) {
        self.excluded.extend(lost.iter().map(|direction| (*direction, 0.5 * apart_rad)));
    }

    /// As many views as `set` has, with the states that are known for them: reachable ones well
    /// apart and, if there are too few, after them others of the set, whose `statuses` tell which
    /// can be reached. `None` where no more than `more_than` of them could be taken.
    fn views(
        &mut self,
        set: &[Direction],
        statuses: &[ViewStatus],
        more_than: usize,
    ) -> Option<(Vec<Direction>, Vec<Option<KnownState>>)> {
        let Self { reach, space, survey, excluded, asks } = self;
        let allowed = |direction: &Direction| {
            let near = |(lost, radius_rad): &(Direction, f64)| lost.dot(direction) > radius_rad.cos();
            !excluded.iter().any(near)
        };
        let directions = survey.lattice.directions.iter();
        let usable: Vec<bool> =
            directions.zip(&survey.usable).map(|(d, usable)| *usable && allowed(d)).collect();
        let mut probe = reach.probe(&asks.left);
        let mut moved: Vec<(Direction, KnownState)> = Vec::new();
        let quick = reach.is_quick();
        let mut usable_at = |direction: &Direction| {
            let pose = space.pose(direction, 0.0);
            if !allowed(direction) || quick {
                return allowed(direction) && probe.reaches(&pose);
            }
            let state = from_neighbours(&mut probe, space, &pose, &survey.states);
            moved.extend(state.iter().map(|state| (*direction, state.clone())));
            state.is_some()
        };
        let most_asked = if quick { usize::MAX } else { ASKED_NUMERIC };
        let mut views = spread(set.len(), &survey.lattice, &usable, most_asked, &mut usable_at);
        asks.left = asks.left.less(probe.spent());
        // A coarse lattice may hold fewer than the set itself has: those that stand clear of them.
        let apart = (APART * separation_rad(set)).cos();
        for (direction, status) in set.iter().zip(statuses) {
            let stands_clear = views.iter().all(|view| view.dot(direction) < apart);
            if views.len() < set.len() && *status == ViewStatus::Planned && allowed(direction) && stands_clear
            {
                views.push(*direction);
            }
        }
        if views.len() <= more_than {
            return None;
        }
        let missing = set.len().saturating_sub(views.len());
        let rest = set
            .iter()
            .zip(statuses)
            .filter(|(d, status)| **status != ViewStatus::Planned && !views.contains(d));
        let rest: Vec<Direction> = rest.map(|(direction, _)| *direction).collect();
        views.extend(rest.into_iter().take(missing));
        let state = |view: &Direction| {
            let of_move = moved.iter().rev().find(|(at, _)| at == view).map(|(_, state)| state);
            of_move.or_else(|| survey.state(view)).cloned()
        };
        let known = views.iter().map(state).collect();
        Some((views, known))
    }
}

/// Measures with pauses.
struct Stopwatch {
    so_far: Duration,
    since: Option<Instant>,
}

impl Stopwatch {
    fn start() -> Self {
        Self { so_far: Duration::ZERO, since: Some(Instant::now()) }
    }

    fn pause(&mut self) {
        self.so_far = self.elapsed();
        self.since = None;
    }

    fn go_on(&mut self) {
        self.since = Some(Instant::now());
    }

    fn elapsed(&self) -> Duration {
        self.so_far + self.since.map_or(Duration::ZERO, |since| since.elapsed())
    }
}

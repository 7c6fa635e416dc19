//! Views that suit the arm: those it cannot reach are spread again over the part of the band it can.

use std::collections::BTreeMap;
use std::time::Instant;

use rayon::prelude::*;

use super::arm_path::{ArmPath, arm_path};
use super::view_poses::ViewPoses;
use super::{
    Arm, Coverage, CoverageReport, PlanError, PlanRequest, UnreachableViews, ViewStatus, Warning, cell,
};
use crate::geometry::{Direction, Pose};
use crate::motion::{Reach, Roll};
use crate::views::{Lattice, ViewSpace, covering_radius_rad, separation_rad, spread};

/// Directions asked for to know the reachable part of the band, beside its top and its rims.
const LATTICE: usize = 1200;
/// The same for arms whose inverse kinematics are searched for numerically: milliseconds a pose.
const LATTICE_NUMERIC: usize = 150;
/// How often the moves of views off that lattice may ask for such an arm.
const ASKED_NUMERIC: usize = 150;
/// How often views are spread again because no way to some was found.
const MORE_ROUNDS: usize = 2;

/// Plans the motion through the views of `set` or, where some cannot be reached and the request
/// allows it, through as many that can.
pub(super) fn adapted_path(
    request: &PlanRequest,
    arm: &Arm,
    set: &ViewPoses,
    end_at_top: bool,
) -> Result<(ArmPath, Option<CoverageReport>), PlanError> {
    let cell = cell(request, arm);
    let Some(directions) = &set.directions else {
        return Ok((arm_path(request, arm, &cell, &set.poses, end_at_top)?, None));
    };
    let begin = Instant::now();
    let space = request.view_space();
    let reach = Reach::new(&cell, arm.roll, arm.start_rad.as_deref())?;
    let codes = reason_codes(&reach, &set.poses);
    let left: Vec<Direction> =
        directions.iter().zip(&codes).filter(|(_, code)| code.is_none()).map(|(d, _)| *d).collect();
    let before = coverage(&left, &space);
    let mut adapter = Adapter { reach: &reach, space, survey: None, excluded: Vec::new() };
    let mut views = set.poses.clone();
    let mut at = directions.clone();
    let replace = arm.unreachable_views == UnreachableViews::Replace;
    if replace && left.len() < directions.len() {
        at = adapter.views(directions, &codes);
        views = poses(&space, &at);
    }
    let mut best = arm_path(request, arm, &cell, &views, end_at_top)?;
    let mut best_at = at.clone();
    let mut latest = (best.statuses.clone(), at);
    for _ in 0..if replace { MORE_ROUNDS } else { 0 } {
        let lost = without_way(&latest.0, &latest.1);
        // Where most views are cut off it is the whole that is: leaving places out cannot help.
        if lost.is_empty() || 2 * lost.len() > latest.1.len() {
            break;
        }
        adapter.exclude(&lost, 0.5 * separation_rad(&latest.1));
        let at = adapter.views(directions, &codes);
        let found = arm_path(request, arm, &cell, &poses(&space, &at), end_at_top)?;
        latest = (found.statuses.clone(), at);
        if planned(&found.statuses) > planned(&best.statuses) {
            (best, best_at) = (found, latest.1.clone());
        }
    }
    let taken: Vec<Direction> = best_at
        .iter()
        .zip(&best.statuses)
        .filter(|(_, status)| **status == ViewStatus::Planned)
        .map(|(direction, _)| *direction)
        .collect();
    let reachable_fraction = adapter.survey.as_ref().map(|survey| survey.fraction);
    let report = CoverageReport { before, after: coverage(&taken, &space), reachable_fraction };
    if best_at != *directions {
        best.warnings.push(replaced_warning(&report, &codes, directions.len(), arm.roll));
    }
    // Motions that were dropped for a better one count here.
    let kept = best.timings.iter().map(|(_, time)| *time).sum();
    best.timings.push(("adapt", begin.elapsed().saturating_sub(kept)));
    Ok((best, Some(report)))
}

/// Stable code of the reason why each pose cannot be taken; `None` for those that can.
fn reason_codes(reach: &Reach, poses: &[Pose]) -> Vec<Option<&'static str>> {
    poses
        .par_iter()
        .map_init(|| reach.probe(), |probe, pose| probe.reason(pose).map(|reason| reason.code()))
        .collect()
}

fn poses(space: &ViewSpace, directions: &[Direction]) -> Vec<Pose> {
    directions.iter().map(|direction| space.pose(direction, 0.0)).collect()
}

fn planned(statuses: &[ViewStatus]) -> usize {
    statuses.iter().filter(|status| **status == ViewStatus::Planned).count()
}

fn without_way(statuses: &[ViewStatus], at: &[Direction]) -> Vec<Direction> {
    let no_way =
        |status: &ViewStatus| matches!(status, ViewStatus::Skipped(reason) if reason.code == "no_path");
    at.iter().zip(statuses).filter(|(_, status)| no_way(status)).map(|(direction, _)| *direction).collect()
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
    survey: Option<Survey>,
    /// Directions without a way to them, and how far around nothing is tried, radians.
    excluded: Vec<(Direction, f64)>,
}

/// The band, asked direction by direction.
struct Survey {
    lattice: Lattice,
    usable: Vec<bool>,
    fraction: f64,
}

impl Adapter<'_> {
    fn exclude(&mut self, lost: &[Direction], radius_rad: f64) {
        self.excluded.extend(lost.iter().map(|direction| (*direction, radius_rad)));
    }

    /// As many views as `set` has: reachable ones well apart and, if too few exist, after them
    /// those of `set` that cannot be reached.
    fn views(&mut self, set: &[Direction], codes: &[Option<&'static str>]) -> Vec<Direction> {
        let (reach, space) = (self.reach, self.space);
        let survey = self.survey.get_or_insert_with(|| survey(reach, &space));
        let excluded = &self.excluded;
        let allowed = |direction: &Direction| {
            let near = |(lost, radius_rad): &(Direction, f64)| lost.dot(direction) > radius_rad.cos();
            !excluded.iter().any(near)
        };
        let directions = survey.lattice.directions.iter();
        let usable: Vec<bool> =
            directions.zip(&survey.usable).map(|(d, usable)| *usable && allowed(d)).collect();
        let mut probe = reach.probe();
        let mut usable_at =
            |direction: &Direction| allowed(direction) && probe.reaches(&space.pose(direction, 0.0));
        let most_asked = if reach.is_quick() { usize::MAX } else { ASKED_NUMERIC };
        let mut views = spread(set.len(), &survey.lattice, &usable, most_asked, &mut usable_at);
        let (left, unreachable): (Vec<_>, Vec<_>) =
            set.iter().zip(codes).partition(|(_, code)| code.is_none());
        // A coarse lattice may hold fewer than the set itself has.
        if views.len() < set.len() && views.len() <= left.iter().filter(|(d, _)| allowed(d)).count() {
            return set.to_vec();
        }
        let missing = set.len() - views.len().min(set.len());
        let rest = unreachable.iter().chain(&left);
        views.extend(rest.take(missing).map(|(direction, _)| **direction));
        views
    }
}

fn survey(reach: &Reach, space: &ViewSpace) -> Survey {
    let lattice = Lattice::new(space.band, if reach.is_quick() { LATTICE } else { LATTICE_NUMERIC });
    let usable: Vec<bool> = lattice
        .directions
        .par_iter()
        .map_init(|| reach.probe(), |probe, direction| probe.reaches(&space.pose(direction, 0.0)))
        .collect();
    let fraction = lattice.usable_share(&usable);
    Survey { lattice, usable, fraction }
}

fn replaced_warning(
    report: &CoverageReport,
    codes: &[Option<&'static str>],
    count: usize,
    roll: Roll,
) -> Warning {
    let CoverageReport { before, after, reachable_fraction } = report;
    let unreachable = codes.iter().flatten().count();
    let what = match unreachable {
        0 => format!("no way was found to some of the {count} views of the set"),
        _ => format!("{unreachable} of {count} views of the set cannot be reached ({})", counts(codes)),
    };
    let share = reachable_fraction.map_or(String::new(), |share| format!(" {:.0} % of the", 100.0 * share));
    let hint = if roll == Roll::Fixed { "; roll \"free\" may reach more" } else { "" };
    Warning::new(
        "views_replaced",
        format!(
            "{what}: {} views are spread over the reachable{share} band instead, separation {:.1} deg and largest \
             hole {:.1} deg, where leaving views out would keep {} with {:.1} and {:.1} deg{hint}",
            after.views,
            after.separation_rad.to_degrees(),
            after.largest_hole_rad.to_degrees(),
            before.views,
            before.separation_rad.to_degrees(),
            before.largest_hole_rad.to_degrees(),
        ),
    )
}

/// `3 no_ik, 4 self_collision`.
fn counts(codes: &[Option<&'static str>]) -> String {
    let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
    codes.iter().flatten().for_each(|code| *counts.entry(code).or_default() += 1);
    counts.iter().map(|(code, count)| format!("{count} {code}")).collect::<Vec<_>>().join(", ")
}

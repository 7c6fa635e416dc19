//! The pipeline.

use std::time::{Duration, Instant};

use super::adapt_views::adapted_path;
use super::free_path::free_path;
use super::photo_content::views_cut_off;
use super::{
    Plan, PlanError, PlanRequest, PlanView, ViewCount, ViewSource, ViewStatus, Warning, check,
    expected_views, predict_count, view_poses,
};
use crate::motion::Stop;
use crate::predict::Predictor;

/// Plans `request`: check, number of views, set, poses, order and, with an arm, its motion.
///
/// `predictor` is needed for photos only; `Err` says why there is none. The plan depends on the
/// request and the model alone, except for its timings.
///
/// # Errors
/// [`PlanError`]. Views that cannot be reached are no error: they are skipped with their reasons.
pub fn make_plan(request: &PlanRequest, predictor: Result<&Predictor, &str>) -> Result<Plan, PlanError> {
    make_plan_until(request, predictor, &Stop::default())
}

/// [`make_plan`], which ends with [`MotionError::Stopped`](crate::motion::MotionError::Stopped) soon
/// after `stop` is asked for.
///
/// # Errors
/// Those of [`make_plan`].
pub fn make_plan_until(
    request: &PlanRequest,
    predictor: Result<&Predictor, &str>,
    stop: &Stop,
) -> Result<Plan, PlanError> {
    let mut clock = Clock::start();
    let mut warnings = check(request)?;
    clock.lap("check");

    let (mut count, views, expected) = match &request.source {
        ViewSource::Photos(images) => {
            let predictor = predictor.map_err(|cause| PlanError::NoPredictor { cause: cause.to_owned() })?;
            let (prediction, doubts) = predict_count(request, predictor)?;
            warnings.extend(doubts);
            clock.lap("predict");
            let count = ViewCount { prediction: Some(prediction), used: prediction.rounded as usize };
            let expected = expected_views(&request.view_space(), images.len());
            (count, view_poses::set(request, count.used)?, Some(expected))
        }
        ViewSource::Count(used) => {
            let count = ViewCount { prediction: None, used: *used };
            (count, view_poses::set(request, *used)?, None)
        }
        ViewSource::Initial { five } => {
            let views = view_poses::initial(request, *five);
            (ViewCount { prediction: None, used: views.poses.len() }, views, None)
        }
    };
    clock.lap("views");
    if views.poses.len() < count.used {
        let text = format!(
            "the band has room for {} of the {} views only: all elevations in it are the same",
            views.poses.len(),
            count.used
        );
        warnings.push(Warning::new("fewer_views", text));
        count.used = views.poses.len();
    }
    if let (Some(camera), false) = (&request.camera, matches!(request.source, ViewSource::Photos(_))) {
        warnings.extend(views_cut_off(camera, request.shell.radius_m, request.object().radius_m));
    }

    let end_at_top = matches!(request.source, ViewSource::Initial { .. });
    let (statuses, poses, path, motion_time, trajectory, coverage) = match &request.arm {
        Some(arm) => {
            let (found, coverage) = adapted_path(request, arm, &views, end_at_top, stop)?;
            clock.laps.extend(found.timings);
            warnings.extend(found.warnings);
            (found.statuses, found.poses, found.path, found.motion_time, found.trajectory, coverage)
        }
        None => {
            let (statuses, path) = free_path(request, &views.poses, end_at_top)?;
            clock.lap("order");
            (statuses, views.poses, path, None, None, None)
        }
    };
    warnings.extend(skipped_warning(&statuses));
    let views = poses
        .into_iter()
        .zip(views.names)
        .zip(statuses)
        .map(|((pose, name), status)| PlanView { name, pose, status })
        .collect();
    clock.total();
    Ok(Plan {
        count,
        views,
        path,
        motion_time,
        trajectory,
        coverage,
        expected,
        warnings,
        timings: clock.laps,
    })
}

fn skipped_warning(statuses: &[ViewStatus]) -> Option<Warning> {
    let skipped = statuses.iter().filter(|status| **status != ViewStatus::Planned).count();
    if skipped > 0 && skipped == statuses.len() {
        let text = format!(
            "none of the {skipped} views can be reached, there is no path; their reasons stand with them"
        );
        return Some(Warning::new("nothing_reachable", text));
    }
    let text = || format!("{skipped} of {} views are skipped; their reasons stand with them", statuses.len());
    (skipped > 0).then(|| Warning::new("views_skipped", text()))
}

/// Time by step.
struct Clock {
    begin: Instant,
    last: Instant,
    laps: Vec<(&'static str, Duration)>,
}

impl Clock {
    fn start() -> Self {
        let now = Instant::now();
        Self { begin: now, last: now, laps: Vec::new() }
    }

    fn lap(&mut self, name: &'static str) {
        let now = Instant::now();
        self.laps.push((name, now - self.last));
        self.last = now;
    }

    fn total(&mut self) {
        self.laps.push(("total", self.begin.elapsed()));
    }
}

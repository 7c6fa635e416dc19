//! Answers.

use std::collections::BTreeMap;
use std::time::Duration;

use super::pose_json;
use crate::api::wire::{
    CoverageJson, CoverageReportJson, ExpectedPose, MotionFiguresJson, MotionTimeJson, PlanAnswer,
    PlannedView, SkipReason, TrajectoryJson, TrajectoryPointJson, ViewCountJson, ViewStatusJson, WarningJson,
};
use crate::plan::{
    Coverage, CoverageReport, ExpectedView, MotionTime, Plan, PlanView, Trajectory, TrajectoryPoint,
    ViewStatus, Warning,
};

/// The plan's JSON.
pub fn plan_answer(id: String, plan: Plan) -> PlanAnswer {
    PlanAnswer {
        id,
        view_count: ViewCountJson {
            predicted: plan.count.prediction.map(|prediction| prediction.rounded),
            raw: plan.count.prediction.map(|prediction| prediction.raw),
            interval: plan.count.prediction.map(|prediction| prediction.interval),
            novelty: plan.count.prediction.map(|prediction| prediction.novelty),
            used: plan.count.used as u32,
        },
        views: plan.views.into_iter().enumerate().map(view_json).collect(),
        order: plan.path.order.iter().map(|id| *id as u32).collect(),
        path_length_m: plan.path.length_m,
        path_optimal: plan.path.optimal,
        path_lower_bound_m: plan.path.lower_bound_m,
        motion_time: plan.motion_time.as_ref().map(motion_time_json),
        trajectory: plan.trajectory.map(trajectory_json),
        coverage: plan.coverage.as_ref().map(coverage_json),
        expected_image_poses: plan.expected.as_deref().map(expected_views),
        warnings: warnings_json(&plan.warnings),
        timings_ms: timings_json(&plan.timings),
    }
}

/// How well the views cover the band.
pub fn coverage_json(report: &CoverageReport) -> CoverageReportJson {
    let figures = |coverage: &Coverage| CoverageJson {
        views: coverage.views as u32,
        separation_deg: coverage.separation_rad.to_degrees(),
        largest_hole_deg: coverage.largest_hole_rad.to_degrees(),
    };
    CoverageReportJson {
        before: figures(&report.before),
        after: figures(&report.after),
        reachable_fraction: report.reachable_fraction,
    }
}

fn motion_time_json(motion_time: &MotionTime) -> MotionTimeJson {
    MotionTimeJson {
        duration_s: motion_time.planned.duration_s,
        by_distance: motion_time.by_distance.map(|figures| MotionFiguresJson {
            duration_s: figures.duration_s,
            path_length_m: figures.path_length_m,
        }),
        least_duration_s: motion_time.least_duration_s,
    }
}

fn view_json((id, view): (usize, PlanView)) -> PlannedView {
    let (status, reason) = match view.status {
        ViewStatus::Planned => (ViewStatusJson::Planned, None),
        ViewStatus::Skipped(reason) => {
            // A number that JSON cannot hold stands in the message.
            let finite = reason.numbers.iter().filter(|(_, number)| number.is_finite());
            let numbers = finite.map(|(name, number)| ((*name).to_owned(), *number)).collect();
            let reason = SkipReason {
                code: reason.code.to_owned(),
                message: reason.message,
                parts: reason.parts,
                numbers,
            };
            (ViewStatusJson::Skipped, Some(reason))
        }
    };
    PlannedView {
        id: id as u32,
        name: view.name.map(str::to_owned),
        pose: pose_json(&view.pose),
        status,
        reason,
    }
}

/// The trajectory's JSON.
fn trajectory_json(trajectory: Trajectory) -> TrajectoryJson {
    let point = |point: TrajectoryPoint| TrajectoryPointJson {
        positions: point.positions_rad,
        velocities: point.velocities_rad_per_s,
        accelerations: point.accelerations_rad_per_s2,
        time_from_start: point.time_s,
        view: point.view.map(|view| view as u32),
    };
    TrajectoryJson {
        joint_names: trajectory.joint_names,
        points: trajectory.points.into_iter().map(point).collect(),
    }
}

/// The trajectory out of a stored plan.
pub fn trajectory(json: TrajectoryJson) -> Trajectory {
    let point = |point: TrajectoryPointJson| TrajectoryPoint {
        positions_rad: point.positions,
        velocities_rad_per_s: point.velocities,
        accelerations_rad_per_s2: point.accelerations,
        time_s: point.time_from_start,
        view: point.view.map(|view| view as usize),
    };
    Trajectory { joint_names: json.joint_names, points: json.points.into_iter().map(point).collect() }
}

/// Expected poses.
pub fn expected_views(views: &[ExpectedView]) -> Vec<ExpectedPose> {
    views
        .iter()
        .map(|view| ExpectedPose { name: view.name.to_owned(), pose: pose_json(&view.pose) })
        .collect()
}

/// Warnings.
pub fn warnings_json(warnings: &[Warning]) -> Vec<WarningJson> {
    warnings.iter().map(|w| WarningJson { code: w.code.to_owned(), message: w.message.clone() }).collect()
}

/// Times by step, milliseconds.
pub fn timings_json(timings: &[(&'static str, Duration)]) -> BTreeMap<String, f64> {
    timings.iter().map(|(name, time)| ((*name).to_owned(), time.as_secs_f64() * 1000.0)).collect()
}

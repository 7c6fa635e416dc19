//! Checks of plans.

use super::{pose, trajectory};
use crate::api::problem::Problem;
use crate::api::wire::{
    CheckAnswer, CheckedJson, CheckedPlanJson, ClearanceJson, TrajectoryPointJson, ViewStatusJson,
    ViolationJson,
};
use crate::motion::{ClaimedView, Nearest, UNDERCUT_BOUND_M};
use crate::plan::{ClaimedPlan, Finding, PlanRequest, PlanVerdict};
use crate::views::MAX_VIEWS;

/// Largest angle (rad), speed (rad/s) and acceleration (rad/s2) of a point, and time (s): beyond any
/// arm's, and small enough for every figure of the verdict to be one that JSON can hold.
pub const MOST_OF_POINT: [f64; 4] = [1e4, 1e6, 1e9, 1e7];
/// Largest share of a limit that is told: what is beyond is wrong however much it is.
const MOST_SHARE: f64 = 1e9;
/// Most points of a trajectory that is judged.
pub const MOST_POINTS: usize = 200_000;

/// What the plan claims.
///
/// # Errors
/// 422 for a plan without views or with too many entries, for ids that do not count from 0, for poses that are none
/// and for numbers that no arm has.
pub fn claimed_plan(json: CheckedPlanJson) -> Result<ClaimedPlan, Problem> {
    let points = json.trajectory.as_ref().map_or(0, |trajectory| trajectory.points.len());
    for (field, count, least, most) in [
        ("plan.views", json.views.len(), 1, MAX_VIEWS),
        ("plan.order", json.order.len(), 0, MAX_VIEWS),
        ("plan.trajectory.points", points, 0, MOST_POINTS),
    ] {
        if !(least..=most).contains(&count) {
            let bound = format!("from {least} to {most} entries");
            return Err(Problem::field("out_of_range", field, count, bound));
        }
    }
    let mut views = Vec::with_capacity(json.views.len());
    for (index, view) in json.views.iter().enumerate() {
        if view.id as usize != index {
            let field = format!("plan.views[{index}].id");
            return Err(Problem::field("view_ids", field, view.id, format!("{index}: ids count from 0")));
        }
        views.push(ClaimedView {
            base_from_camera: pose(&format!("plan.views[{index}].pose"), &view.pose)?,
            planned: view.status == ViewStatusJson::Planned,
        });
    }
    json.trajectory.iter().try_for_each(|trajectory| check_points(&trajectory.points))?;
    let motion = json.trajectory.map(trajectory);
    let (joint_names, points) = motion.map_or_else(Default::default, |m| (m.joint_names, m.points));
    Ok(ClaimedPlan { views, order: json.order.iter().map(|id| *id as usize).collect(), joint_names, points })
}

/// Refuses numbers that are no arm's.
fn check_points(points: &[TrajectoryPointJson]) -> Result<(), Problem> {
    let [angle, speed, acceleration, time] = MOST_OF_POINT;
    let within = |value: f64, most: f64| (-most..=most).contains(&value);
    for (index, point) in points.iter().enumerate() {
        let path = |member: &str| format!("plan.trajectory.points[{index}].{member}");
        for (member, values, most, unit) in [
            ("positions", &point.positions, angle, "rad"),
            ("velocities", &point.velocities, speed, "rad/s"),
            ("accelerations", &point.accelerations, acceleration, "rad/s2"),
        ] {
            if let Some((joint, value)) = values.iter().enumerate().find(|(_, value)| !within(**value, most))
            {
                let field = format!("{}[{joint}]", path(member));
                return Err(Problem::field("out_of_range", field, *value, format!("within +-{most} {unit}")));
            }
        }
        if !within(point.time_from_start, time) {
            let bound = format!("within +-{time} s");
            return Err(Problem::field(
                "out_of_range",
                path("time_from_start"),
                point.time_from_start,
                bound,
            ));
        }
    }
    Ok(())
}

/// The verdict's JSON.
pub fn check_answer(request: &PlanRequest, plan: &ClaimedPlan, verdict: PlanVerdict) -> CheckAnswer {
    let looked = verdict.looked;
    let has_jerk = request.arm.as_ref().is_some_and(|arm| arm.timing.jerk_limited);
    let unjudged = verdict.findings.iter().any(|f| f.code == "not_proven") || looked.states == 0;
    CheckAnswer {
        sound: verdict.findings.is_empty(),
        violations: verdict.findings.into_iter().map(violation).collect(),
        checked: CheckedJson {
            views: plan.views.len() as u32,
            points: plan.points.len() as u32,
            seconds: plan.points.last().map_or(0.0, |point| point.time_s),
            states: looked.states as u64,
            undercut_bound_m: (!unjudged).then_some(UNDERCUT_BOUND_M),
            smallest_clearance: looked.nearest.map(clearance),
            smallest_self_clearance: looked.nearest_self.map(clearance),
            largest_speed_share: looked.speed_share.min(MOST_SHARE),
            largest_acceleration_share: looked.acceleration_share.min(MOST_SHARE),
            largest_jerk_share: has_jerk.then_some(looked.jerk_share.min(MOST_SHARE)),
            largest_pose_error_m: looked.pose_error_m,
            largest_pose_error_rad: looked.pose_error_rad,
        },
    }
}

fn violation(finding: Finding) -> ViolationJson {
    // A number that JSON cannot hold stands in the message.
    let finite = finding.numbers.iter().filter(|(_, number)| number.is_finite());
    ViolationJson {
        code: finding.code.to_owned(),
        numbers: finite.map(|(name, number)| ((*name).to_owned(), *number)).collect(),
        time: finding.time_s,
        parts: finding.parts,
        message: finding.message,
    }
}

fn clearance(nearest: Nearest) -> ClearanceJson {
    ClearanceJson {
        distance_m: nearest.distance_m,
        between: [nearest.first, nearest.second],
        time: nearest.time_s,
    }
}

//! Whether the motion visits what it says, where it says, and stands still there.

use std::collections::BTreeSet;

use super::findings::Findings;
use super::{Claim, Violation};
use crate::geometry::{Pose, Vector};
use crate::motion::plan::TrajectoryPoint;
use crate::motion::request::Roll;

/// Camera pose error that counts as rounding: metres and radians (arms without closed formulas included).
const POSE_TOLERANCE: f64 = 1e-5;
/// What counts as standing still, radians and radians a second.
const STILL: f64 = 1e-9;

pub(super) fn judge(claim: &Claim, well_formed: bool, findings: &mut Findings) {
    if let (Some(start), Some(first)) = (claim.start, claim.trajectory.first()) {
        let differences = first.positions_rad.iter().zip(start).map(|(a, b)| (a - b).abs());
        let largest_rad = differences.fold(0.0, f64::max);
        if first.positions_rad.len() != start.len()
            || !(largest_rad <= crate::robot::START_TOLERANCE_RAD + 1e-12)
        {
            findings.push(Violation::Start { largest_rad });
        }
    }
    let marked: Vec<usize> = claim.trajectory.iter().filter_map(|p| p.view).collect();
    judge_visits(claim, &marked, findings);
    if marked != claim.order {
        let pairs = marked.iter().map(Some).chain([None]).zip(claim.order.iter().map(Some).chain([None]));
        let differing = pairs.into_iter().find(|(a, b)| a != b).and_then(|(a, b)| b.or(a));
        let view = differing.copied().unwrap_or(0);
        findings.push(Violation::View { view, problem: "is not visited where the order says" });
    }
    if !well_formed {
        return;
    }
    // A second visit is wrong anyhow: each view's rest is walked through once.
    let mut walked = vec![false; claim.views.len()];
    for (i, point) in claim.trajectory.iter().enumerate() {
        let Some(view) = point.view else { continue };
        if point.velocities_rad_per_s.iter().any(|v| v.abs() > STILL) {
            findings.push(Violation::View { view, problem: "is passed without a stop" });
        }
        let is_first = walked.get_mut(view).is_some_and(|walked| !std::mem::replace(walked, true));
        let rest = claim.trajectory.get(i..).unwrap_or_default();
        if is_first && !rests(rest, claim.timing.settle_s) {
            findings.push(Violation::View { view, problem: "is left before the camera has settled" });
        }
        let robot = &claim.cell.robot.kinematics;
        let camera = robot.forward(&point.positions_rad) * claim.cell.flange_from_camera;
        judge_pose(claim, view, &camera, findings);
    }
}

/// Whether each view is marked as often as it should be; `marked` are those of all points.
fn judge_visits(claim: &Claim, marked: &[usize], findings: &mut Findings) {
    let mut times = vec![0usize; claim.views.len()];
    let mut strangers = BTreeSet::new();
    for view in marked {
        match times.get_mut(*view) {
            Some(times) => *times += 1,
            None => {
                strangers.insert(*view);
            }
        }
    }
    for (view, (claimed, times)) in claim.views.iter().zip(times).enumerate() {
        let problem = match (claimed.planned, times) {
            (true, 0) => "is planned but never visited",
            (true, 2..) => "is visited more than once",
            (false, 1..) => "is skipped but visited",
            _ => continue,
        };
        findings.push(Violation::View { view, problem });
    }
    for view in strangers {
        findings.push(Violation::View { view, problem: "is not in the plan" });
    }
}

/// Whether the arm stands still from the first of `points` on for `settle_s`.
fn rests(points: &[TrajectoryPoint], settle_s: f64) -> bool {
    let Some((first, later)) = points.split_first() else { return true };
    let end_s = first.time_from_start_s + settle_s - 1e-9;
    let mut last_s = first.time_from_start_s;
    // Twice the tolerance: the point at the very end of the rest belongs to it, however it is rounded.
    for point in later.iter().take_while(|point| point.time_from_start_s <= end_s + 2e-9) {
        let mut joints = point.positions_rad.iter().zip(&first.positions_rad);
        if joints.any(|(a, b)| (a - b).abs() > STILL) {
            return settle_s <= 0.0;
        }
        last_s = point.time_from_start_s;
    }
    settle_s <= 0.0 || last_s >= end_s
}

fn judge_pose(claim: &Claim, view: usize, camera: &Pose, findings: &mut Findings) {
    let Some(wanted) = claim.views.get(view).map(|v| v.base_from_camera) else { return };
    let position_m = (camera.translation.vector - wanted.translation.vector).norm();
    let rotation_rad = match claim.roll {
        Roll::Fixed => camera.rotation.angle_to(&wanted.rotation),
        Roll::Free { .. } => {
            let (a, b) = (camera.rotation * Vector::z(), wanted.rotation * Vector::z());
            a.cross(&b).norm().atan2(a.dot(&b))
        }
    };
    let looked = &mut findings.verdict.looked;
    looked.pose_error_m = looked.pose_error_m.max(position_m);
    looked.pose_error_rad = looked.pose_error_rad.max(rotation_rad);
    if !(position_m <= POSE_TOLERANCE && rotation_rad <= POSE_TOLERANCE) {
        findings.push(Violation::PoseError { view, position_m, rotation_rad });
    }
}

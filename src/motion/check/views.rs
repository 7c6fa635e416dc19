//! Whether the motion visits what it says, where it says, and stands still there.

use super::{Claim, Verdict, Violation};
use crate::geometry::{Pose, Vector};
use crate::motion::request::Roll;

/// Camera pose error that counts as rounding: metres and radians (arms without closed formulas included).
const POSE_TOLERANCE: f64 = 1e-5;
/// What counts as standing still, radians and radians a second.
const STILL: f64 = 1e-9;

pub(super) fn judge(claim: &Claim, well_formed: bool, verdict: &mut Verdict) {
    let violations = &mut verdict.violations;
    if let (Some(start), Some(first)) = (claim.start, claim.trajectory.first()) {
        let differences = first.positions_rad.iter().zip(start).map(|(a, b)| (a - b).abs());
        let largest_rad = differences.fold(0.0, f64::max);
        if first.positions_rad.len() != start.len()
            || !(largest_rad <= crate::robot::START_TOLERANCE_RAD + 1e-12)
        {
            violations.push(Violation::Start { largest_rad });
        }
    }
    let marked: Vec<usize> = claim.trajectory.iter().filter_map(|p| p.view).collect();
    let views = marked.iter().chain(claim.order).map(|view| view + 1).fold(claim.views.len(), usize::max);
    // A number of a view that nobody asked for must not make this long.
    for view in
        (0..claim.views.len()).chain((claim.views.len()..views).filter(|v| marked.contains(v)).take(10))
    {
        let times = marked.iter().filter(|v| **v == view).count();
        let problem = match (claim.views.get(view).map(|v| v.planned), times) {
            (None, _) => "is not in the plan",
            (Some(true), 0) => "is planned but never visited",
            (Some(true), 2..) => "is visited more than once",
            (Some(false), 1..) => "is skipped but visited",
            _ => continue,
        };
        violations.push(Violation::View { view, problem });
    }
    if marked != claim.order {
        let pairs = marked.iter().map(Some).chain([None]).zip(claim.order.iter().map(Some).chain([None]));
        let differing = pairs.into_iter().find(|(a, b)| a != b).and_then(|(a, b)| b.or(a));
        let view = differing.copied().unwrap_or(0);
        violations.push(Violation::View { view, problem: "is not visited where the order says" });
    }
    if !well_formed {
        return;
    }
    for (i, point) in claim.trajectory.iter().enumerate() {
        let Some(view) = point.view else { continue };
        if point.velocities_rad_per_s.iter().any(|v| v.abs() > STILL) {
            verdict.violations.push(Violation::View { view, problem: "is passed without a stop" });
        }
        let end_s = point.time_from_start_s + claim.timing.settle_s - 1e-9;
        let moves = |other: &crate::motion::plan::TrajectoryPoint| {
            let pairs = other.positions_rad.iter().zip(&point.positions_rad);
            pairs.into_iter().any(|(a, b)| (a - b).abs() > STILL)
        };
        let later = claim.trajectory.iter().skip(i + 1);
        // Twice the tolerance: the point at the very end of the rest belongs to it, however it is rounded.
        let until = later.take_while(|p| p.time_from_start_s <= end_s + 2e-9);
        let (mut stands, mut last_s) = (true, point.time_from_start_s);
        for other in until {
            stands &= !moves(other);
            last_s = other.time_from_start_s;
        }
        if claim.timing.settle_s > 0.0 && !(stands && last_s >= end_s) {
            let problem = "is left before the camera has settled";
            verdict.violations.push(Violation::View { view, problem });
        }
        let robot = &claim.cell.robot.kinematics;
        let camera = robot.forward(&point.positions_rad) * claim.cell.flange_from_camera;
        judge_pose(claim, view, &camera, verdict);
    }
}

fn judge_pose(claim: &Claim, view: usize, camera: &Pose, verdict: &mut Verdict) {
    let Some(wanted) = claim.views.get(view).map(|v| v.base_from_camera) else { return };
    let position_m = (camera.translation.vector - wanted.translation.vector).norm();
    let rotation_rad = match claim.roll {
        Roll::Fixed => camera.rotation.angle_to(&wanted.rotation),
        Roll::Free { .. } => {
            let (a, b) = (camera.rotation * Vector::z(), wanted.rotation * Vector::z());
            a.cross(&b).norm().atan2(a.dot(&b))
        }
    };
    let looked = &mut verdict.looked;
    looked.pose_error_m = looked.pose_error_m.max(position_m);
    looked.pose_error_rad = looked.pose_error_rad.max(rotation_rad);
    if !(position_m <= POSE_TOLERANCE && rotation_rad <= POSE_TOLERANCE) {
        verdict.violations.push(Violation::PoseError { view, position_m, rotation_rad });
    }
}

//! Whether the motion visits what it says, where it says, and stands still there.

use super::Violation;
use crate::geometry::{Pose, Vector};
use crate::motion::plan::{MotionPlan, ViewOutcome};
use crate::motion::request::{MotionRequest, Roll};

/// Camera pose error that counts as rounding: metres and radians (arms without closed formulas included).
const POSE_TOLERANCE: f64 = 1e-5;

pub(super) fn judge(request: &MotionRequest, plan: &MotionPlan, violations: &mut Vec<Violation>) {
    if let (Some(start), Some(first)) = (request.start, plan.trajectory.first()) {
        let tolerance = crate::robot::START_TOLERANCE_RAD + 1e-12;
        if !first.positions_rad.iter().zip(start).all(|(a, b)| (a - b).abs() <= tolerance) {
            violations.push(Violation::Start);
        }
    }
    let marked: Vec<usize> = plan.trajectory.iter().filter_map(|p| p.view).collect();
    for view in 0..request.views.len().max(plan.views.len()) {
        let times = marked.iter().filter(|v| **v == view).count();
        let planned = matches!(plan.views.get(view), Some(ViewOutcome::Planned(_)));
        let problem = match (plan.views.get(view), planned, times) {
            (None, ..) => "has no outcome",
            (_, true, 0) => "is planned but never visited",
            (_, true, 2..) => "is visited more than once",
            (_, false, 1..) => "is skipped but visited",
            _ => continue,
        };
        violations.push(Violation::View { view, problem });
    }
    if marked != plan.order {
        let view = plan.order.first().copied().unwrap_or(0);
        violations
            .push(Violation::View { view, problem: "begins an order that the trajectory does not follow" });
    }
    for (i, point) in plan.trajectory.iter().enumerate() {
        let Some(view) = point.view else { continue };
        if point.velocities_rad_per_s.iter().any(|v| *v != 0.0) {
            violations.push(Violation::View { view, problem: "is passed without a stop" });
        }
        let settle_s = request.timing.settle_s;
        if settle_s > 0.0 {
            let stands = plan.trajectory.get(i + 1).is_some_and(|next| {
                next.positions_rad == point.positions_rad
                    && next.time_from_start_s - point.time_from_start_s >= settle_s - 1e-9
            });
            if !stands {
                violations.push(Violation::View { view, problem: "is left before the settle time is over" });
            }
        }
        let camera =
            request.cell.robot.kinematics.forward(&point.positions_rad) * request.cell.flange_from_camera;
        judge_pose(request, view, &camera, violations);
    }
}

fn judge_pose(request: &MotionRequest, view: usize, camera: &Pose, violations: &mut Vec<Violation>) {
    let Some(wanted) = request.views.get(view) else { return };
    let position_m = (camera.translation.vector - wanted.translation.vector).norm();
    let rotation_rad = match request.roll {
        Roll::Fixed => camera.rotation.angle_to(&wanted.rotation),
        Roll::Free { .. } => {
            let (a, b) = (camera.rotation * Vector::z(), wanted.rotation * Vector::z());
            a.cross(&b).norm().atan2(a.dot(&b))
        }
    };
    if !(position_m <= POSE_TOLERANCE && rotation_rad <= POSE_TOLERANCE) {
        violations.push(Violation::PoseError { view, position_m, rotation_rad });
    }
}

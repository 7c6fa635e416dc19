//! Limits and the time law, by finite differences.

use super::Violation;
use crate::motion::plan::MotionPlan;
use crate::motion::request::MotionRequest;

/// Relative excess over a limit that counts as rounding.
const ROUNDING: f64 = 1e-6;

/// Judges points and their differences; whether all points are well formed.
pub(super) fn judge(request: &MotionRequest, plan: &MotionPlan, violations: &mut Vec<Violation>) -> bool {
    let joints = &request.cell.robot.joints;
    let mut well_formed = true;
    for (i, point) in plan.trajectory.iter().enumerate() {
        let vectors = [&point.positions_rad, &point.velocities_rad_per_s, &point.accelerations_rad_per_s2];
        let finite = vectors.iter().all(|v| v.len() == joints.len() && v.iter().all(|x| x.is_finite()));
        if !finite || !point.time_from_start_s.is_finite() {
            violations.push(Violation::Malformed { point: i });
            well_formed = false;
        }
    }
    if !well_formed {
        return false;
    }
    for (i, point) in plan.trajectory.iter().enumerate() {
        for (j, joint) in joints.iter().enumerate() {
            let (q, v, a) =
                (point.positions_rad[j], point.velocities_rad_per_s[j], point.accelerations_rad_per_s2[j]);
            let mut limit = |quantity, value: f64, limit: f64| {
                if value > limit * (1.0 + ROUNDING) + 1e-9 {
                    violations.push(Violation::Limit { point: i, quantity, joint: j, value, limit });
                }
            };
            limit("position beyond its range", joint.violation_rad(q), 0.0);
            limit("speed", v.abs(), joint.max_speed_rad_per_s);
            limit("acceleration", a.abs(), joint.max_acceleration_rad_per_s2);
        }
    }
    for (i, pair) in plan.trajectory.windows(2).enumerate() {
        let [before, after] = pair else { continue };
        let dt = after.time_from_start_s - before.time_from_start_s;
        if dt <= 0.0 {
            violations.push(Violation::Time { point: i + 1, time_s: after.time_from_start_s });
            continue;
        }
        for (j, joint) in joints.iter().enumerate() {
            let moved = after.positions_rad[j] - before.positions_rad[j];
            let (v0, v1) = (before.velocities_rad_per_s[j], after.velocities_rad_per_s[j]);
            let (fastest, hardest) = (joint.max_speed_rad_per_s, joint.max_acceleration_rad_per_s2);
            let mut limit = |quantity, value: f64, limit: f64| {
                if value > limit * (1.0 + ROUNDING) + 1e-9 / dt {
                    violations.push(Violation::Limit { point: i + 1, quantity, joint: j, value, limit });
                }
            };
            limit("mean speed", (moved / dt).abs(), fastest);
            limit("mean acceleration", ((v1 - v0) / dt).abs(), hardest);
            // With acceleration within its limit, the trapezoidal rule is this good.
            let jump_rad = (moved - 0.5 * dt * (v0 + v1)).abs();
            if jump_rad > 0.25 * hardest * dt * dt * (1.0 + ROUNDING) + 1e-9 {
                violations.push(Violation::Jump { point: i + 1, joint: j, jump_rad });
            }
        }
    }
    true
}

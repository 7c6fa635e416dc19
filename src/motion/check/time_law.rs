//! Limits and the time law, by finite differences.

use super::findings::Findings;
use super::{Claim, Violation};
use crate::motion::request::Timing;
use crate::robot::Joint;

/// Relative excess over a limit that counts as rounding.
const ROUNDING: f64 = 1e-6;
/// Points less than this apart in time are taken for simultaneous, seconds: differences over less say
/// nothing.
const LEAST_STEP_S: f64 = 1e-9;

/// The limits of a joint, scaled as the timing asks.
struct Limits<'a> {
    joint: &'a Joint,
    speed: f64,
    acceleration: f64,
    jerk: Option<f64>,
}

/// Judges points and their differences; whether all points are well formed.
pub(super) fn judge(claim: &Claim, findings: &mut Findings) -> bool {
    let joints = &claim.cell.robot.joints;
    let mut well_formed = true;
    for (i, point) in claim.trajectory.iter().enumerate() {
        let vectors = [&point.positions_rad, &point.velocities_rad_per_s, &point.accelerations_rad_per_s2];
        let finite = vectors.iter().all(|v| v.len() == joints.len() && v.iter().all(|x| x.is_finite()));
        if !finite || !point.time_from_start_s.is_finite() {
            findings.push(Violation::Malformed { point: i });
            well_formed = false;
        }
    }
    if !well_formed {
        return false;
    }
    let scale = claim.timing.speed_scale;
    for (j, joint) in joints.iter().enumerate() {
        let limits = Limits {
            joint,
            speed: joint.max_speed_rad_per_s * scale,
            acceleration: joint.max_acceleration_rad_per_s2 * scale * scale,
            jerk: claim.timing.jerk_limited.then(|| Timing::jerk_limit_rad_per_s3(joint) * scale.powi(3)),
        };
        judge_points(claim, j, &limits, findings);
        judge_differences(claim, j, &limits, findings);
    }
    for (i, pair) in claim.trajectory.windows(2).enumerate() {
        let [before, after] = pair else { continue };
        if !(after.time_from_start_s - before.time_from_start_s >= LEAST_STEP_S) {
            let time_s = after.time_from_start_s;
            findings.push(Violation::Time { point: i + 1, time_s });
        }
    }
    true
}

fn judge_points(claim: &Claim, j: usize, limits: &Limits, findings: &mut Findings) {
    for (i, point) in claim.trajectory.iter().enumerate() {
        let (q, v, a) =
            (point.positions_rad[j], point.velocities_rad_per_s[j], point.accelerations_rad_per_s2[j]);
        let mut limit = |quantity, value: f64, limit: f64, over: bool| {
            if over {
                let joint = limits.joint.name.clone();
                findings.push(Violation::Limit { point: i, quantity, joint, value, limit });
            }
        };
        let beyond = limits.joint.violation_rad(q) > 1e-9;
        let bound = if q > limits.joint.upper_rad { limits.joint.upper_rad } else { limits.joint.lower_rad };
        limit("position", q, bound, beyond);
        limit("speed", v.abs(), limits.speed, is_over(v.abs(), limits.speed, 1e-9));
        limit("acceleration", a.abs(), limits.acceleration, is_over(a.abs(), limits.acceleration, 1e-9));
        let looked = &mut findings.verdict.looked;
        looked.speed_share = looked.speed_share.max(v.abs() / limits.speed);
    }
}

fn judge_differences(claim: &Claim, j: usize, limits: &Limits, findings: &mut Findings) {
    for (i, pair) in claim.trajectory.windows(2).enumerate() {
        let [before, after] = pair else { continue };
        let dt = after.time_from_start_s - before.time_from_start_s;
        if !(dt >= LEAST_STEP_S) {
            continue;
        }
        let moved = after.positions_rad[j] - before.positions_rad[j];
        let (v0, v1) = (before.velocities_rad_per_s[j], after.velocities_rad_per_s[j]);
        let (a0, a1) = (before.accelerations_rad_per_s2[j], after.accelerations_rad_per_s2[j]);
        let (speed, acceleration, jerk) =
            ((moved / dt).abs(), ((v1 - v0) / dt).abs(), ((a1 - a0) / dt).abs());
        let mut judge = |quantity, value: f64, limit: f64| {
            if is_over(value, limit, 1e-9 / dt) {
                let joint = limits.joint.name.clone();
                findings.push(Violation::Limit { point: i + 1, quantity, joint, value, limit });
            }
        };
        judge("mean speed", speed, limits.speed);
        judge("mean acceleration", acceleration, limits.acceleration);
        if let Some(limit) = limits.jerk {
            judge("jerk", jerk, limit);
            // Where accelerations are continuous, speeds follow from them by the trapezoidal rule.
            let unexplained = ((v1 - v0) - 0.5 * dt * (a0 + a1)).abs();
            judge("jerk", 4.0 * unexplained / (dt * dt), limit);
            let looked = &mut findings.verdict.looked;
            looked.jerk_share = looked.jerk_share.max(jerk / limit);
        }
        let looked = &mut findings.verdict.looked;
        looked.speed_share = looked.speed_share.max(speed / limits.speed);
        looked.acceleration_share = looked.acceleration_share.max(acceleration / limits.acceleration);
        // With acceleration within its limit, the trapezoidal rule is this good.
        let jump_rad = (moved - 0.5 * dt * (v0 + v1)).abs();
        if jump_rad > 0.25 * limits.acceleration * dt * dt * (1.0 + ROUNDING) + 1e-9 {
            let joint = limits.joint.name.clone();
            findings.push(Violation::Jump { point: i + 1, joint, jump_rad });
        }
    }
}

fn is_over(value: f64, limit: f64, noise: f64) -> bool {
    value > limit * (1.0 + ROUNDING) + noise
}

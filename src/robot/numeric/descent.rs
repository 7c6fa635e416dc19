//! Levenberg-Marquardt descent from one joint state to a flange pose.
//!
//! Minimises `|position error|^2 + (w * rotation error)^2` with the geometric
//! Jacobian (Levenberg 1944, Marquardt 1963; damping `J J^T + lambda I` as in
//! Nakamura and Hanafusa 1986), joint limits kept by an active set.

use nalgebra::{Matrix6, Vector6};

use crate::geometry::Pose;
use crate::robot::{Chain, Joint, MAX_JOINTS};

/// What a radian of rotation error weighs against a metre.
const METRES_A_RADIAN: f64 = 0.3;

/// Descent stops below this error, metres and radians.
const GOAL: f64 = 1e-11;

/// Most Jacobians of one descent.
const MOST_STEPS: usize = 60;

/// Longest move of a joint in one step, radians.
const LONGEST_STEP_RAD: f64 = 0.7;

/// What the joints may do during a descent.
#[derive(Debug, Clone, Copy)]
pub(in crate::robot) enum Bounds<'a> {
    /// Turn freely.
    Free,
    /// Stay within their limits.
    Limits(&'a [Joint]),
}

/// Where a descent ended.
#[derive(Debug, Clone, Copy)]
pub(in crate::robot) struct Descent {
    /// Joint state; entries past the chain's joints are 0.
    pub joints_rad: [f64; MAX_JOINTS],
    /// Distance to the target, metres.
    pub position_residual_m: f64,
    /// Angle to the target, radians.
    pub rotation_residual_rad: f64,
}

impl Descent {
    /// Whether both residuals are at most `tolerance` (metres and radians).
    pub fn reaches(&self, tolerance: f64) -> bool {
        self.position_residual_m <= tolerance && self.rotation_residual_rad <= tolerance
    }

    /// The residuals as one number, for comparisons.
    pub fn miss(&self) -> f64 {
        self.position_residual_m.hypot(METRES_A_RADIAN * self.rotation_residual_rad)
    }
}

/// Position and rotation that lead from `pose` to `target`, base axes; metres and radians.
fn error(pose: &Pose, target: &Pose) -> Vector6<f64> {
    let shift = target.translation.vector - pose.translation.vector;
    let turn = (target.rotation * pose.rotation.inverse()).scaled_axis();
    Vector6::new(shift.x, shift.y, shift.z, turn.x, turn.y, turn.z)
}

fn weighted(v: &Vector6<f64>) -> Vector6<f64> {
    let w = METRES_A_RADIAN;
    Vector6::new(v[0], v[1], v[2], w * v[3], w * v[4], w * v[5])
}

/// The best state on the way down from `start_rad`. Allocates nothing.
pub(in crate::robot) fn descend(
    chain: &Chain,
    bounds: Bounds<'_>,
    target: &Pose,
    start_rad: &[f64; MAX_JOINTS],
) -> Descent {
    let dof = chain.dof();
    let mut q = *start_rad;
    let (pose, mut columns) = chain.forward_with_columns(&q);
    let mut miss = error(&pose, target);
    let mut cost = weighted(&miss).norm_squared();
    let mut lambda = (0.1 * cost).clamp(1e-12, 1e-2);
    let mut slow_steps = 0;
    for _ in 0..MOST_STEPS {
        if !cost.is_finite()
            || (miss.fixed_rows::<3>(0).norm() <= GOAL && miss.fixed_rows::<3>(3).norm() <= GOAL)
        {
            break;
        }
        let Some(step) = step(&columns, dof, &weighted(&miss), lambda, &q, bounds) else {
            lambda = (lambda * 10.0).max(1e-9);
            continue;
        };
        let mut moved = q;
        for (value, change) in moved.iter_mut().zip(&step) {
            *value += change;
        }
        keep_within(&mut moved, bounds);
        let (pose, moved_columns) = chain.forward_with_columns(&moved);
        let moved_miss = error(&pose, target);
        let moved_cost = weighted(&moved_miss).norm_squared();
        if moved_cost < cost {
            slow_steps = if moved_cost > 0.97 * cost { slow_steps + 1 } else { 0 };
            (q, columns, miss, cost) = (moved, moved_columns, moved_miss, moved_cost);
            // Down to the error squared: the last steps are Newton's.
            lambda = (0.2 * lambda).min(0.1 * cost).max(1e-15);
        } else {
            slow_steps += 1;
            lambda = (8.0 * lambda).min(1e3);
        }
        if slow_steps >= 8 {
            break;
        }
    }
    Descent {
        joints_rad: q,
        position_residual_m: miss.fixed_rows::<3>(0).norm(),
        rotation_residual_rad: miss.fixed_rows::<3>(3).norm(),
    }
}

/// One damped step. A joint at its limit that would be pushed out is held and
/// the others make up for it.
fn step(
    columns: &[Vector6<f64>; MAX_JOINTS],
    dof: usize,
    miss: &Vector6<f64>,
    lambda: f64,
    q: &[f64; MAX_JOINTS],
    bounds: Bounds<'_>,
) -> Option<[f64; MAX_JOINTS]> {
    let mut scaled = [Vector6::zeros(); MAX_JOINTS];
    for (slot, column) in scaled.iter_mut().zip(columns).take(dof) {
        *slot = weighted(column);
    }
    let mut held = [false; MAX_JOINTS];
    loop {
        let mut normal = Matrix6::identity() * lambda;
        for (column, _) in scaled.iter().zip(&held).filter(|(_, held)| !**held) {
            normal.ger(1.0, column, column, 1.0);
        }
        let pull = normal.cholesky()?.solve(miss);
        let mut step = [0.0; MAX_JOINTS];
        for ((slot, column), held) in step.iter_mut().zip(&scaled).zip(&held) {
            *slot = if *held { 0.0 } else { column.dot(&pull) };
        }
        let Bounds::Limits(joints) = bounds else { return Some(shortened(step)) };
        let mut pushed = false;
        for (((joint, &angle), &change), held) in joints.iter().zip(q).zip(&step).zip(&mut held) {
            let outward =
                (angle <= joint.lower_rad && change < 0.0) || (angle >= joint.upper_rad && change > 0.0);
            if outward && !*held {
                (*held, pushed) = (true, true);
            }
        }
        // Each round holds at least one more joint, so this ends.
        if !pushed {
            return Some(shortened(step));
        }
    }
}

fn shortened(mut step: [f64; MAX_JOINTS]) -> [f64; MAX_JOINTS] {
    let longest = step.iter().fold(0.0f64, |m, s| m.max(s.abs()));
    if longest > LONGEST_STEP_RAD {
        step.iter_mut().for_each(|s| *s *= LONGEST_STEP_RAD / longest);
    }
    step
}

fn keep_within(q: &mut [f64; MAX_JOINTS], bounds: Bounds<'_>) {
    if let Bounds::Limits(joints) = bounds {
        for (value, joint) in q.iter_mut().zip(joints) {
            *value = value.max(joint.lower_rad).min(joint.upper_rad);
        }
    }
}

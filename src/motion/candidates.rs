//! For one view: every collision-free joint state that takes it, or the reason why there is none.

use std::f64::consts::TAU;

use nalgebra::UnitQuaternion;

use super::contact::Contact;
use super::joints::{Joints, joints_from};
use super::plan::SkipReason;
use super::reach::KnownState;
use super::scene::{Placement, Scene};
use crate::geometry::{Pose, Vector};
use crate::robot::{InverseFailure, InverseSolutions, UnreachableReason, nearest_wrap};

/// A joint state that takes a view, up to whole turns of its joints.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Candidate {
    pub joints: Joints,
    pub roll_rad: f64,
}

/// A camera pose turned about its optical axis.
pub(crate) fn rolled(base_from_camera: &Pose, roll_rad: f64) -> Pose {
    let mut pose = *base_from_camera;
    pose.rotation *= UnitQuaternion::from_axis_angle(&Vector::z_axis(), roll_rad);
    pose
}

/// All collision-free states of a view over `rolls_rad` and all branches of the inverse kinematics;
/// those found until the work ends, or [`SkipReason::WorkLimit`] where none was.
///
/// Whole turns are left to the choice of states: they move no geometry, so one check serves all.
/// `known`, where it is one, is a state to search from too.
pub(crate) fn candidates(
    scene: &Scene,
    base_from_camera: &Pose,
    rolls_rad: &[f64],
    seeds: &[Vec<f64>],
    known: Option<&KnownState>,
    placement: &mut Placement,
) -> Result<Vec<Candidate>, SkipReason> {
    let camera_from_flange = scene.cell.flange_from_camera.inverse();
    let kinematics = scene.cell.robot.kinematics.as_ref();
    let mut free = Vec::new();
    let mut colliding: Vec<Joints> = Vec::new();
    let mut best_failure: Option<InverseFailure> = None;
    let mut best_limit: Option<(SkipReason, f64)> = None;
    // A search is worth doing once, where the last joint does the rest.
    let last_joint_rolls = scene.last_joint_rolls.filter(|_| !kinematics.is_closed_form());
    let mut level: Option<InverseSolutions> = None;
    for &roll_rad in rolls_rad {
        if placement.work.is_over() {
            break;
        }
        let answer = match (&level, last_joint_rolls) {
            (Some(level), Some(turn)) => with_last_turned(level, turn * roll_rad),
            _ => {
                placement.work.spend(scene.inverse_cost);
                let base_from_flange = rolled(base_from_camera, roll_rad) * camera_from_flange;
                match known.filter(|known| last_joint_rolls.is_some() || known.roll_rad == roll_rad) {
                    Some(known) => {
                        let mut from = known.joints_rad.clone();
                        if let (Some(turn), Some(last)) = (last_joint_rolls, from.last_mut()) {
                            *last += turn * (roll_rad - known.roll_rad);
                        }
                        let seeds: Vec<Vec<f64>> = seeds.iter().cloned().chain([from]).collect();
                        kinematics.inverse(&base_from_flange, &seeds)
                    }
                    None => kinematics.inverse(&base_from_flange, seeds),
                }
            }
        };
        for solution in &answer.solutions {
            let joints = match within_limits(scene, solution) {
                Ok(joints) => joints,
                Err(limit) => {
                    best_limit = Some(best_limit.filter(|b| b.1 <= limit.1).unwrap_or(limit));
                    continue;
                }
            };
            if scene.is_free(&joints, placement) {
                free.push(Candidate { joints, roll_rad });
            } else if free.is_empty() {
                colliding.push(joints);
            }
        }
        if last_joint_rolls.is_some() && level.is_none() {
            level = Some(answer.clone());
        }
        if let Some(failure) = answer.failure {
            best_failure = Some(nearer(best_failure, failure));
        }
    }
    if !free.is_empty() {
        return Ok(free);
    }
    if placement.work.is_over() {
        return Err(SkipReason::WorkLimit);
    }
    let mut least: Option<Contact> = None;
    for q in &colliding {
        if least.is_some() && placement.work.is_over() {
            break;
        }
        let less_than_m = least.as_ref().map_or(f64::INFINITY, |contact| contact.depth_m);
        least = scene.deepest_contact(q, placement, less_than_m).or(least);
    }
    if let Some(contact) = least {
        return Err(SkipReason::Collision(contact));
    }
    Err(best_limit.map_or_else(|| reason_of(best_failure), |(reason, _)| reason))
}

/// Solutions of a pose as those of the pose rolled, where the last joint rolls it.
fn with_last_turned(level: &InverseSolutions, by_rad: f64) -> InverseSolutions {
    let mut turned = level.clone();
    for state in &mut turned.solutions {
        if let Some(last) = state.last_mut() {
            *last += by_rad;
        }
    }
    turned
}

/// A solution turned into the model's limits, which a request may have
/// narrowed below those that the kinematics know; or the joint that breaks
/// its limit most, and by how much.
pub(crate) fn within_limits(scene: &Scene, solution: &[f64]) -> Result<Joints, (SkipReason, f64)> {
    let mut joints = joints_from(solution);
    let mut worst: Option<(SkipReason, f64)> = None;
    for (joint, q) in scene.cell.robot.joints.iter().zip(&mut joints) {
        if joint.contains(*q) {
            continue;
        }
        if let Some(turned) = nearest_wrap(joint, *q, joint.middle_rad()) {
            *q = turned;
            continue;
        }
        // Of all turns the least far outside.
        let value_rad = *q + ((joint.middle_rad() - *q) / TAU).round() * TAU;
        let beyond = joint.violation_rad(value_rad);
        if worst.as_ref().is_none_or(|(_, most)| beyond > *most) {
            let limit_rad = if value_rad > joint.upper_rad { joint.upper_rad } else { joint.lower_rad };
            worst =
                Some((SkipReason::JointLimit { joint: joint.name.clone(), value_rad, limit_rad }, beyond));
        }
    }
    worst.map_or(Ok(joints), Err)
}

/// The failure that is nearer to success: a joint limit before a pose out of reach.
fn nearer(best: Option<InverseFailure>, other: InverseFailure) -> InverseFailure {
    let rank = |f: &InverseFailure| match &f.reason {
        UnreachableReason::JointLimit { value_rad, bound_rad, .. } => (0, (value_rad - bound_rad).abs()),
        UnreachableReason::OutOfReach { beyond_m, .. } => (1, *beyond_m),
        UnreachableReason::NotFound { .. } => (1, f.position_residual_m),
        UnreachableReason::NotFinite => (2, f64::INFINITY),
    };
    match best {
        Some(best) if rank(&best) <= rank(&other) => best,
        _ => other,
    }
}

fn reason_of(failure: Option<InverseFailure>) -> SkipReason {
    match failure {
        Some(InverseFailure {
            reason: UnreachableReason::JointLimit { joint, value_rad, bound_rad },
            ..
        }) => SkipReason::JointLimit { joint, value_rad, limit_rad: bound_rad },
        Some(failure) => SkipReason::NoIk {
            position_residual_m: failure.position_residual_m,
            rotation_residual_rad: failure.rotation_residual_rad,
            cause: failure.reason,
        },
        None => SkipReason::NoIk {
            position_residual_m: f64::INFINITY,
            rotation_residual_rad: f64::INFINITY,
            cause: UnreachableReason::NotFound { attempts: 0 },
        },
    }
}

/// The whole turns of each joint that fit its limits, for every combination, at most `most`.
pub(crate) fn turns(joints: &Joints, lower: &Joints, upper: &Joints, most: usize) -> Vec<Joints> {
    let mut states = vec![*joints];
    for j in 0..joints.len() {
        let first = ((lower[j] - joints[j]) / TAU - 1e-9).ceil() as i64;
        let last = ((upper[j] - joints[j]) / TAU + 1e-9).floor() as i64;
        let count = states.len();
        for turn in (first..=last).filter(|t| *t != 0).take(4) {
            for i in 0..count {
                if states.len() >= most {
                    return states;
                }
                let mut state = states[i];
                state[j] = (state[j] + turn as f64 * TAU).clamp(lower[j], upper[j]);
                states.push(state);
            }
        }
    }
    states
}

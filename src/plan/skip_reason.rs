//! Why the arm leaves a view out, in the plan's words.

use super::Reason;
use crate::motion::{LegStart, SkipReason};

/// The reason with its numbers; `view_of` gives the plan's number of a view of the motion.
pub(super) fn reason(skipped: &SkipReason, view_of: impl Fn(usize) -> usize) -> Reason {
    let code = skipped.code();
    let message = skipped.to_string();
    let (parts, numbers) = match skipped {
        SkipReason::NoIk { position_residual_m, rotation_residual_rad, .. } => (
            Vec::new(),
            vec![
                ("position_residual_m", *position_residual_m),
                ("rotation_residual_rad", *rotation_residual_rad),
            ],
        ),
        SkipReason::JointLimit { joint, value_rad, limit_rad } => (
            vec![joint.clone()],
            vec![
                ("value_rad", *value_rad),
                ("limit_rad", *limit_rad),
                ("beyond_rad", (value_rad - limit_rad).abs()),
            ],
        ),
        SkipReason::WorkLimit => (Vec::new(), Vec::new()),
        SkipReason::Collision(contact) => (
            vec![contact.first.clone(), contact.second.clone()],
            vec![("depth_m", contact.depth_m), ("distance_m", contact.distance_m)],
        ),
        SkipReason::NoPath { from, attempts } => {
            let from = match from {
                LegStart::Start => "start".to_owned(),
                LegStart::View(view) => format!("view {}", view_of(*view)),
            };
            let message =
                format!("no collision-free way to the pose was found: {attempts} ways tried from {from}");
            return Reason {
                code,
                message,
                parts: vec![from],
                numbers: vec![("attempts", *attempts as f64)],
            };
        }
    };
    Reason { code, message, numbers, parts }
}

//! Surroundings and timing.

use super::solid::{keep_out, mounted_solids};
use crate::api::problem::Problem;
use crate::api::wire::{PlanRequestJson, TimingJson};
use crate::motion::{Cell, Timing};
use crate::plan::Surroundings;

/// What stands around the arm and hangs on its flange.
///
/// # Errors
/// 422 naming the member.
pub fn surroundings(json: &PlanRequestJson) -> Result<Surroundings, Problem> {
    let camera_body = json.camera_body.as_deref();
    Ok(Surroundings {
        keep_out: keep_out(&json.keep_out)?,
        camera_body: camera_body.map(|solids| mounted_solids("camera_body", solids)).transpose()?,
        tool: mounted_solids("tool", &json.tool)?,
        margin_m: json.margin.unwrap_or(Cell::DEFAULT_MARGIN_M),
    })
}

/// The timing; its numbers are checked with the plan's request.
pub fn timing(json: Option<&TimingJson>) -> Timing {
    let json = json.copied().unwrap_or_default();
    Timing {
        speed_scale: json.speed_scale,
        settle_s: json.settle,
        sample_period_s: json.sample_period,
        jerk_limited: json.jerk_limited,
    }
}

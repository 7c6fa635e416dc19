//! Reachability.

use std::collections::BTreeMap;

use super::{plan_request, timings_json, warnings_json};
use crate::api::problem::Problem;
use crate::api::wire::{BandPart, PlaceJson, PlanRequestJson, ReachabilityAnswer};
use crate::plan::{Place, PlanRequest, Reachability};

/// The cell of a plan's request: how many views it asks for, and its photos, do not matter.
///
/// # Errors
/// 422 naming the member.
pub fn reachability_request(json: &PlanRequestJson) -> Result<PlanRequest, Problem> {
    plan_request(&PlanRequestJson {
        images: None,
        image_poses: None,
        view_count: Some(1),
        views: None,
        ..json.clone()
    })
}

/// The answer's JSON.
pub fn reachability_answer(found: &Reachability) -> ReachabilityAnswer {
    let code = |code: &Option<&'static str>| code.unwrap_or("ok").to_owned();
    let parts = |angles_rad: &[f64], fractions: &[f64]| {
        let part = |(angle_rad, fraction): (&f64, &f64)| BandPart {
            angle_deg: angle_rad.to_degrees(),
            reachable_fraction: *fraction,
        };
        angles_rad.iter().zip(fractions).map(part).collect()
    };
    let mut counts: BTreeMap<String, u32> =
        found.counts.iter().map(|(code, count)| ((*code).to_owned(), *count as u32)).collect();
    let ok = found.grid.iter().flatten().filter(|code| code.is_none()).count();
    counts.insert("ok".to_owned(), ok as u32);
    ReachabilityAnswer {
        reachable_fraction: found.fraction,
        by_elevation: parts(&found.elevations_rad, &found.by_elevation),
        by_azimuth: parts(&found.azimuths_rad, &found.by_azimuth),
        grid: found.grid.iter().map(|row| row.iter().map(code).collect()).collect(),
        counts,
        given: place(&found.given),
        suggestions: found.suggestions.iter().map(place).collect(),
        warnings: warnings_json(&found.warnings),
        timings_ms: timings_json(&found.timings),
    }
}

fn place(place: &Place) -> PlaceJson {
    PlaceJson { center: place.center_in_base.into(), reachable_fraction: place.fraction }
}

//! From plans and requests to what is drawn of them.

use std::f64::consts::FRAC_PI_2;

use super::convert;
use super::problem::Problem;
use super::wire::{PlanAnswer, PlanRequestJson, ViewStatusJson};
use crate::draw::{Panel, ReachMap, common_point};
use crate::geometry::{Direction, Point, Vector};
use crate::plan;

/// The part of the band that the arm of `request` reaches, by rows and columns as in
/// `POST /v1/reachability`.
///
/// # Errors
/// Those of [`super::reachability_of`].
pub fn reach_map(
    request: &PlanRequestJson,
    elevations: Option<usize>,
    azimuths: Option<usize>,
) -> Result<ReachMap, Problem> {
    let request = convert::reachability_request(request)?;
    let found = plan::reachability(&request, elevations, azimuths)?;
    let band = request.view_space().band;
    Ok(ReachMap {
        min_elevation_rad: band.min_elevation_rad,
        max_elevation_rad: band.max_elevation_rad.min(FRAC_PI_2),
        reached: found.grid.iter().map(|row| row.iter().map(Option::is_none).collect()).collect(),
    })
}

/// A plan as a panel, with its figures as captions.
///
/// # Errors
/// 422 for poses that are none, and an order that is not one of the planned views.
pub fn plan_panel(title: &str, plan: &PlanAnswer, reach: Option<ReachMap>) -> Result<Panel, Problem> {
    let mut axes: Vec<(Point, Direction)> = Vec::with_capacity(plan.views.len());
    for (index, view) in plan.views.iter().enumerate() {
        let pose = convert::pose(&format!("views[{index}].pose"), &view.pose)?;
        axes.push((Point::from(pose.translation.vector), pose.rotation * Vector::z_axis()));
    }
    // Every view looks at the object's centre.
    let directions: Vec<Direction> = axes.iter().map(|(_, axis)| -*axis).collect();
    let views = || plan.views.iter().zip(&directions);
    let mut planned = Vec::with_capacity(plan.order.len());
    let mut left: Vec<_> = views().filter(|(view, _)| view.status == ViewStatusJson::Planned).collect();
    for (index, id) in plan.order.iter().enumerate() {
        let Some(found) = left.iter().position(|(view, _)| view.id == *id) else {
            let bound = "the id of a planned view that is not in the order yet";
            return Err(Problem::field("wrong_order", format!("order[{index}]"), *id, bound));
        };
        planned.push(*left.swap_remove(found).1);
    }
    if let Some((view, _)) = left.first() {
        return Err(Problem::field(
            "wrong_order",
            "order",
            plan.order.clone(),
            format!("with view {}", view.id),
        ));
    }
    let skipped =
        views().filter(|(view, _)| view.status == ViewStatusJson::Skipped).map(|(view, direction)| {
            (*direction, view.reason.as_ref().map_or_else(String::new, |reason| reason.code.clone()))
        });
    // A plan without motion knows no robot.
    let center = plan.trajectory.as_ref().and_then(|_| common_point(&axes));
    let away = |center: &Point| center.x.hypot(center.y) > 1e-3;
    Ok(Panel {
        title: title.to_owned(),
        planned,
        skipped: skipped.collect(),
        reach,
        base_azimuth_rad: center.filter(away).map(|center| (-center.y).atan2(-center.x)),
        captions: captions(plan),
    })
}

fn captions(plan: &PlanAnswer) -> Vec<(String, String)> {
    let count = plan.order.len();
    let mut lines = vec![("Views", format!("{count} of {} asked for", plan.view_count.used))];
    if let Some(coverage) = &plan.coverage {
        lines.push(("Separation", format!("{:.1}\u{b0}", coverage.after.separation_deg)));
        lines.push(("Largest hole", format!("{:.1}\u{b0}", coverage.after.largest_hole_deg)));
    }
    lines.push(("Camera path", format!("{:.2} m", plan.path_length_m)));
    if let Some(time) = &plan.motion_time {
        let each = time.duration_s / count.max(1) as f64;
        lines.push(("Execution", format!("{:.1} s, {each:.2} s a view", time.duration_s)));
        if let Some(other) = &time.by_distance {
            lines.push(("Shortest path", format!("{:.1} s, {:.2} m", other.duration_s, other.path_length_m)));
        }
    }
    lines.into_iter().map(|(name, value)| (name.to_owned(), value)).collect()
}

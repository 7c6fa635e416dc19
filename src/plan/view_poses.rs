//! The poses of a plan's views.

use super::{PlanError, PlanRequest};
use crate::geometry::{Direction, Pose};
use crate::views::{initial_views, initial_views_five, tammes};

/// Poses with a level horizon, each with its name if it is an initial view; the first is the top view.
pub(super) struct ViewPoses {
    pub(super) poses: Vec<Pose>,
    pub(super) names: Vec<Option<&'static str>>,
    /// Where the views of a Tammes set stand, seen from the object; initial views stay where they are.
    pub(super) directions: Option<Vec<Direction>>,
}

/// The initial views.
pub(super) fn initial(request: &PlanRequest, five: bool) -> ViewPoses {
    let views = if five { initial_views_five().to_vec() } else { initial_views().to_vec() };
    let space = request.view_space();
    ViewPoses {
        poses: views.iter().map(|view| space.pose(&view.direction, 0.0)).collect(),
        names: views.iter().map(|view| Some(view.name)).collect(),
        directions: None,
    }
}

/// The Tammes set of `count` views on the request's band.
pub(super) fn set(request: &PlanRequest, count: usize) -> Result<ViewPoses, PlanError> {
    let space = request.view_space();
    let set = tammes(count, space.band)?;
    let poses: Vec<Pose> = set.directions.iter().map(|direction| space.pose(direction, 0.0)).collect();
    Ok(ViewPoses { names: vec![None; poses.len()], poses, directions: Some(set.directions) })
}

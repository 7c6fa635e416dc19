//! The camera's path around the object, without an arm.

use std::time::Duration;

use super::{CameraPath, PlanError, PlanRequest, Reason, ViewStatus};
use crate::geometry::{Point, Pose};
use crate::order::{CostMatrix, Obstacle, order_points};

/// Time after which the order found so far is taken with its proven gap.
pub(super) const ORDER_BUDGET: Duration = Duration::from_secs(5);

/// Keeps the views above the table and orders them from the first that is kept; `end_at_top` turns
/// the path round (lengths are the same both ways).
pub(super) fn free_path(
    request: &PlanRequest,
    poses: &[Pose],
    end_at_top: bool,
) -> Result<(Vec<ViewStatus>, CameraPath), PlanError> {
    let table_z_m = request.object().table_z_m;
    let statuses: Vec<ViewStatus> = poses.iter().map(|pose| status(pose, table_z_m)).collect();
    let kept: Vec<usize> =
        statuses.iter().enumerate().filter(|(_, s)| **s == ViewStatus::Planned).map(|(i, _)| i).collect();
    let mut path = free_order(request, poses, &kept)?;
    if end_at_top {
        path.order.reverse();
    }
    Ok((statuses, path))
}

/// The shortest order of the views `kept`, from the first of them.
fn free_order(request: &PlanRequest, poses: &[Pose], kept: &[usize]) -> Result<CameraPath, PlanError> {
    if kept.is_empty() {
        return Ok(CameraPath { order: Vec::new(), length_m: 0.0, lower_bound_m: 0.0, optimal: true });
    }
    let path = order_points(&points(poses, kept), 0, &obstacle(request), ORDER_BUDGET)?;
    Ok(CameraPath {
        order: path.order.iter().filter_map(|i| kept.get(*i).copied()).collect(),
        length_m: path.length,
        lower_bound_m: path.lower_bound,
        optimal: path.optimal,
    })
}

/// Length of the camera's path through the views in this order, metres.
pub(super) fn path_length(request: &PlanRequest, poses: &[Pose], order: &[usize]) -> Result<f64, PlanError> {
    let matrix = CostMatrix::from_points(&points(poses, order), &obstacle(request))?;
    Ok(matrix.path_length(&(0..matrix.len()).collect::<Vec<_>>()))
}

/// Where the cameras of these views stand.
pub(super) fn points(poses: &[Pose], views: &[usize]) -> Vec<Point> {
    views.iter().filter_map(|i| poses.get(*i)).map(|pose| Point::from(pose.translation.vector)).collect()
}

/// What the camera's path goes around.
pub(super) fn obstacle(request: &PlanRequest) -> Obstacle {
    let object = request.object();
    Obstacle { center: object.center_in_base, radius_m: object.radius_m, table_z_m: object.table_z_m }
}

fn status(pose: &Pose, table_z_m: Option<f64>) -> ViewStatus {
    let height_m = pose.translation.vector.z;
    match table_z_m {
        Some(table_z_m) if height_m < table_z_m => ViewStatus::Skipped(Reason {
            code: "table_collision",
            message: format!("the camera would be {:.4} m below the table", table_z_m - height_m),
            numbers: vec![("depth_m", table_z_m - height_m)],
            parts: vec!["camera".to_owned(), "table".to_owned()],
        }),
        _ => ViewStatus::Planned,
    }
}

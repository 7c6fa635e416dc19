//! Parts of the arm that never move but stand in a keep-out region.

use super::cell::Cell;
use super::distance::shape_shape;
use crate::geometry::Pose;

/// Names of the base's part and of the region for every overlap of the two, at most one a region.
///
/// Motion cannot change them, so the planner does not look at them; the one who wrote the region
/// may want to know.
pub fn fixed_overlaps(cell: &Cell) -> Vec<(String, String)> {
    let identity = Pose::identity();
    let Some(base) = cell.robot.links.first() else { return Vec::new() };
    let overlaps = |region: &&super::cell::KeepOut| {
        let apart = |shape| shape_shape(&identity, shape, &identity, &region.shape_in_base);
        base.shapes.iter().any(|shape| apart(shape) <= 0.0)
    };
    cell.keep_out.iter().filter(overlaps).map(|region| (base.name.clone(), region.name.clone())).collect()
}

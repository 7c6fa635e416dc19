//! The object.

use crate::api::wire::ObjectJson;
use crate::geometry::Point;
use crate::plan::ObjectSphere;

/// The object; its numbers are checked with the plan's request.
pub fn object(json: &ObjectJson) -> ObjectSphere {
    ObjectSphere { center_in_base: Point::from(json.center), radius_m: json.radius, table_z_m: json.table_z }
}

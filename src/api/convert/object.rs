//! The object.

use crate::api::wire::{ObjectJson, ObjectShapeJson};
use crate::geometry::{Point, Vector};
use crate::motion::ObjectShape;
use crate::plan::ObjectSphere;

/// The object; its numbers are checked with the plan's request.
pub fn object(json: &ObjectJson) -> ObjectSphere {
    let shape = match json.shape {
        ObjectShapeJson::Sphere => ObjectShape::Sphere,
        ObjectShapeJson::Cylinder { radius, height } => {
            ObjectShape::Cylinder { radius_m: radius, height_m: height }
        }
        ObjectShapeJson::Box { size, yaw } => {
            ObjectShape::Cuboid { size_m: Vector::from(size), yaw_rad: yaw }
        }
    };
    ObjectSphere {
        center_in_base: Point::from(json.center),
        radius_m: json.radius,
        table_z_m: json.table_z,
        shape,
    }
}

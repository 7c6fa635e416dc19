//! The object to reconstruct, as far as it is known beforehand.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// The sphere that encloses the object, and the table it stands on.
#[derive(Clone, Copy, Debug, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
#[schema(as = Object, example = json!({"center": [0.45, 0.0, 0.1], "radius": 0.1, "table_z": 0.0}))]
pub struct ObjectJson {
    /// Centre of the enclosing sphere in the robot's `base` frame, metres, each within +-5 m.
    pub center: [f64; 3],
    /// Radius of the enclosing sphere in metres, 0.005 to 1.
    pub radius: f64,
    /// Height of the table's surface in `base`, metres; no table when left out. The object's
    /// centre lies above it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub table_z: Option<f64>,
    /// What of the sphere the object fills, for the arm's collisions: the whole sphere when left
    /// out. View distance, the camera's path and rendering go by the sphere.
    #[serde(default, skip_serializing_if = "ObjectShapeJson::is_sphere")]
    pub shape: ObjectShapeJson,
}

/// A shape upright about the object's centre, within its sphere.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
#[schema(as = ObjectShape, example = json!({"cylinder": {"radius": 0.05, "height": 0.15}}))]
pub enum ObjectShapeJson {
    /// The enclosing sphere.
    #[default]
    Sphere,
    /// A cylinder about the vertical.
    #[serde(rename_all = "snake_case")]
    Cylinder {
        /// Metres.
        radius: f64,
        /// Metres.
        height: f64,
    },
    /// A box.
    #[serde(rename_all = "snake_case")]
    Box {
        /// Edge lengths along its x, y and z axes, metres.
        size: [f64; 3],
        /// Turn about the vertical against the base's x axis, radians; 0 when left out.
        #[serde(default)]
        yaw: f64,
    },
}

impl ObjectShapeJson {
    fn is_sphere(&self) -> bool {
        *self == Self::Sphere
    }
}

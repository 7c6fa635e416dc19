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
}

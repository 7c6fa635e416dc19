//! Poses.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// A rigid transform: where the second frame stands in the first.
#[derive(Clone, Copy, Debug, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
#[schema(as = Pose, example = json!({"position": [0.4, 0.0, 0.35], "orientation": [1.0, 0.0, 0.0, 0.0]}))]
pub struct PoseJson {
    /// Position x, y, z in metres.
    pub position: [f64; 3],
    /// Unit quaternion x, y, z, w.
    pub orientation: [f64; 4],
}

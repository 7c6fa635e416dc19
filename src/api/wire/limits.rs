//! Joint limits that replace a robot's own for one request.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// Limits by joint name.
pub type LimitsJson = BTreeMap<String, JointLimitsJson>;

/// What replaces a joint's limits; what is left out stays as the robot has it.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
#[schema(as = JointLimits, example = json!({"min": -1.6, "max": 1.6, "max_speed": 1.0}))]
pub struct JointLimitsJson {
    /// Smallest angle in radians, not below -4 pi (two turns back). Taken with a warning where it lies
    /// below the robot's own.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub min: Option<f64>,
    /// Largest angle in radians, above `min`, not above 4 pi (two turns on). Taken with a warning where it
    /// lies above the robot's own.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub max: Option<f64>,
    /// Speed limit in rad/s, 0.001 to 1000.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub max_speed: Option<f64>,
    /// Acceleration limit in rad/s2, 0.001 to 1000.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub max_acceleration: Option<f64>,
    /// Jerk limit in rad/s3, 0.001 to 1000000. It binds plans with `timing.jerk_limited` alone; the robot's own
    /// when left out, and where it has none the one that `timing.jerk_limited` tells.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub max_jerk: Option<f64>,
}

//! Joint limits that replace a robot's own for one request.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// Limits by joint name.
pub type LimitsJson = BTreeMap<String, JointLimitsJson>;

/// What replaces a joint's limits; what is left out stays.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
#[schema(as = JointLimits, example = json!({"min": -1.6, "max": 1.6, "max_speed": 1.0}))]
pub struct JointLimitsJson {
    /// Smallest angle in radians, at least two turns back. Below the robot's own a warning says so.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub min: Option<f64>,
    /// Largest angle in radians, above `min`, at most two turns on.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub max: Option<f64>,
    /// Speed limit in rad/s.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub max_speed: Option<f64>,
    /// Acceleration limit in rad/s2.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub max_acceleration: Option<f64>,
    /// Jerk limit in rad/s3; none when left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub max_jerk: Option<f64>,
}

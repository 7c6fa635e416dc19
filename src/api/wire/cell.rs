//! What stands around the arm, what hangs on its flange, how its motion is timed.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// A solid: exactly one of `box`, `sphere`, `capsule` and `cylinder`. Metres, in the frame that the
/// list of solids says.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
#[schema(as = Solid, example = json!({"box": {"center": [0.0, 0.0, -0.02], "size": [0.1, 0.05, 0.04]}}))]
pub struct SolidJson {
    /// A box.
    #[serde(default, rename = "box", skip_serializing_if = "Option::is_none")]
    pub cuboid: Option<BoxJson>,
    /// A ball.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sphere: Option<SphereJson>,
    /// All points within a radius of a segment.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub capsule: Option<CapsuleJson>,
    /// A cylinder.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cylinder: Option<CylinderJson>,
}

/// A region nothing that moves may enter: a name and exactly one of `box`, `sphere`, `capsule` and
/// `cylinder`, in the base frame. The arm's base may stand in it.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
#[schema(as = KeepOut, example = json!({"name": "monitor", "box": {"center": [0.2, -0.6, 0.3], "size": [0.6, 0.1, 0.4]}}))]
pub struct KeepOutJson {
    /// Named in the reasons of skipped views; 1 to 100 characters. Several solids may share a name: reasons
    /// tell them apart by their place, as in `case (keep_out[1])`.
    pub name: String,
    /// A box.
    #[serde(default, rename = "box", skip_serializing_if = "Option::is_none")]
    pub cuboid: Option<BoxJson>,
    /// A ball.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sphere: Option<SphereJson>,
    /// All points within a radius of a segment.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub capsule: Option<CapsuleJson>,
    /// A cylinder.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cylinder: Option<CylinderJson>,
}

/// A box.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
#[schema(as = Box)]
pub struct BoxJson {
    /// Centre.
    pub center: [f64; 3],
    /// Edge lengths along its x, y and z axes.
    pub size: [f64; 3],
    /// Unit quaternion x, y, z, w; not turned when left out.
    #[serde(default = "upright")]
    pub orientation: [f64; 4],
}

/// A ball.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
#[schema(as = Sphere)]
pub struct SphereJson {
    /// Centre.
    pub center: [f64; 3],
    /// Radius.
    pub radius: f64,
}

/// All points within `radius` of the segment between `from` and `to`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
#[schema(as = Capsule)]
pub struct CapsuleJson {
    /// One end of the segment.
    pub from: [f64; 3],
    /// The other end.
    pub to: [f64; 3],
    /// Radius.
    pub radius: f64,
}

/// A cylinder about its z axis.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
#[schema(as = Cylinder)]
pub struct CylinderJson {
    /// Centre.
    pub center: [f64; 3],
    /// Radius.
    pub radius: f64,
    /// Height along its z axis.
    pub height: f64,
    /// Unit quaternion x, y, z, w; upright when left out.
    #[serde(default = "upright")]
    pub orientation: [f64; 4],
}

fn upright() -> [f64; 4] {
    [0.0, 0.0, 0.0, 1.0]
}

/// How the motion is timed: how fast, how long it rests, how densely it is sampled, how smooth it is.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields, default)]
#[schema(as = Timing, example = json!({"speed_scale": 0.5, "settle": 0.3}))]
pub struct TimingJson {
    /// Share of the joints' speed limits that is used, 0.01 to 1. Accelerations are scaled by its square
    /// and jerks by its cube, so that the motion is the same, slower. 1 when left out.
    pub speed_scale: f64,
    /// How long the arm stands still at each view, seconds, 0 to 60; 0.3 when left out.
    pub settle: f64,
    /// Longest time between two points of the trajectory while the arm moves, seconds, 0.001 to 1;
    /// 0.04 when left out. A plan has at most 50,000 points: the error of a period too short for that
    /// says which would do.
    pub sample_period: f64,
    /// Whether the joints' jerk is bounded too. Every leg is then an S-curve from rest to rest, and
    /// detours stop at their corners. Where the robot has no jerk limit, one that reaches the
    /// acceleration limit in 0.05 s is assumed, with a warning. false when left out.
    pub jerk_limited: bool,
}

impl Default for TimingJson {
    fn default() -> Self {
        Self { speed_scale: 1.0, settle: 0.3, sample_period: 0.04, jerk_limited: false }
    }
}

//! Robots in requests and in the catalogue.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// The arm: exactly one of `model`, `dh` and `urdf`.
#[derive(Clone, Debug, Default, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
#[schema(as = Robot, example = json!({"model": "ur5e"}))]
pub struct RobotJson {
    /// A robot of `GET /v1/robots`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub model: Option<String>,
    /// Denavit-Hartenberg rows of six or seven revolute joints, base to flange.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub dh: Option<Vec<DhRowJson>>,
    /// Which convention `dh` follows; `standard` when left out. `modified` with `dh` alone.
    #[serde(default, skip_serializing_if = "DhConventionJson::is_standard")]
    pub convention: DhConventionJson,
    /// A URDF document with one serial chain of six or seven revolute joints.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub urdf: Option<String>,
    /// The URDF's link in whose frame everything is given; its root when left out. With `urdf` alone.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub base_link: Option<String>,
    /// The URDF's link that carries the camera; found by its customary name when left out. With `urdf`
    /// alone.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tip_link: Option<String>,
    /// Files of the URDF's collision meshes by the name it gives them, STL or OBJ in base64: a box
    /// or capsule that holds each takes its place. A mesh without file is left out with a warning, as is a file that no mesh
    /// names. With `urdf` alone.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub meshes: Option<BTreeMap<String, String>>,
}

/// The two conventions of Denavit-Hartenberg tables.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case")]
#[schema(as = DhConvention)]
pub enum DhConventionJson {
    /// `Rz(q + theta) Tz(d) Tx(a) Rx(alpha)`, as Universal Robots publishes.
    #[default]
    Standard,
    /// Craig's `Rx(alpha) Tx(a) Rz(q + theta) Tz(d)`, as Franka publishes.
    Modified,
}

impl DhConventionJson {
    fn is_standard(&self) -> bool {
        *self == Self::Standard
    }
}

/// One joint by Denavit-Hartenberg parameters.
#[derive(Clone, Debug, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
#[schema(as = DhRow)]
pub struct DhRowJson {
    /// The joint's name, no other joint's; numbered when left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// Link offset d in metres.
    pub d: f64,
    /// Link length a in metres.
    pub a: f64,
    /// Link twist in radians.
    pub alpha: f64,
    /// Offset added to the joint angle in radians; 0 when left out.
    #[serde(default)]
    pub theta: f64,
    /// Smallest joint angle in radians; -2 pi when left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub min: Option<f64>,
    /// Largest joint angle in radians; 2 pi when left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub max: Option<f64>,
    /// Speed limit in rad/s; 1 when left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub max_speed: Option<f64>,
    /// Acceleration limit in rad/s2; 5 when left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub max_acceleration: Option<f64>,
}

/// A robot of the catalogue.
#[derive(Clone, Debug, Serialize, ToSchema)]
pub struct RobotSummary {
    /// The name to give as `robot.model`.
    pub model: String,
    /// Number of joints.
    pub joints: u32,
}

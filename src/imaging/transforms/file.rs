//! The file's fields, one for one.

use serde::{Deserialize, Serialize};

/// Intrinsics, for all frames or for one.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(super) struct Intrinsics {
    #[serde(skip_serializing_if = "Option::is_none")]
    pub camera_model: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub camera_angle_x: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub camera_angle_y: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fl_x: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fl_y: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cx: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cy: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub w: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub h: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub k1: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub k2: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub k3: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub p1: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub p2: Option<f64>,
}

/// One image.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Frame {
    pub file_path: String,
    #[serde(flatten)]
    pub intrinsics: Intrinsics,
    pub transform_matrix: Vec<Vec<f64>>,
}

/// The whole file.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Transforms {
    #[serde(flatten)]
    pub intrinsics: Intrinsics,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub aabb_scale: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub scale: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub offset: Option<[f64; 3]>,
    pub frames: Vec<Frame>,
}

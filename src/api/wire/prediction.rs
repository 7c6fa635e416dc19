//! `POST /v1/predictions`.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use super::{CameraJson, ObjectJson, PoseJson, ViewSpaceJson, WarningJson};

/// Photos of an object, to predict the number of views its reconstruction needs.
#[derive(Clone, Debug, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
#[schema(example = json!({
    "images": ["iVBORw0KGgoAAAANSUhEUgAA (the rest of a PNG or JPEG file in base64)"],
    "object": {"center": [0.45, 0.0, 0.1], "radius": 0.1},
    "camera": {"width": 1280, "height": 720, "fx": 915.607, "fy": 913.327, "cx": 647.145, "cy": 372.515},
    "view_space": {"radius": 0.3}
}))]
pub struct PredictionRequest {
    /// 1 to 5 photos, PNG or JPEG in base64.
    pub images: Vec<String>,
    /// Where they were taken, `base_from_camera`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub image_poses: Option<Vec<PoseJson>>,
    /// Intrinsics; a RealSense D435's with a warning when left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub camera: Option<CameraJson>,
    /// The object's enclosing sphere: its size in the image is part of what the network sees.
    pub object: ObjectJson,
    /// The shell from which the photos were taken.
    #[serde(default)]
    pub view_space: ViewSpaceJson,
}

/// The predicted number of views.
#[derive(Clone, Debug, Serialize, ToSchema)]
#[schema(as = Prediction)]
pub struct PredictionAnswer {
    /// Rounded: the number of views from which one more improves a NeRF by less than 0.05 dB
    /// (models/MODEL_CARD.md tells how that is measured).
    pub predicted: u32,
    /// The network's number.
    pub raw: f64,
    /// Least and largest number of views between which 80 % of objects' labels lie.
    pub interval: [u32; 2],
    /// How unlike those of the objects trained on, or how empty, the photos are: one in a hundred of theirs exceeds 1.
    /// Beyond it the warning `unlike_training_objects` comes with the answer.
    pub novelty: f64,
    /// SHA-256 of the model.
    pub model: String,
    /// Poses from which the photos are expected.
    pub expected_image_poses: Vec<ExpectedPose>,
    /// What the caller should know.
    pub warnings: Vec<WarningJson>,
    /// Milliseconds by step.
    pub timings_ms: BTreeMap<String, f64>,
}

/// A pose from which a photo is expected.
#[derive(Clone, Debug, Serialize, Deserialize, ToSchema)]
pub struct ExpectedPose {
    /// `top`, `left`, `right`, `front` or `back`.
    pub name: String,
    /// `base_from_camera` with a level horizon; the roll does not matter.
    pub pose: PoseJson,
}

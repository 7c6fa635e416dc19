//! The shell of views around the object.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use super::PoseJson;

/// The views' sphere about the object's centre, and the band of elevations used on it.
#[derive(Clone, Copy, Debug, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
#[schema(as = ViewSpace, example = json!({"radius": 0.3, "min_elevation_deg": 5.0, "max_elevation_deg": 90.0}))]
pub struct ViewSpaceJson {
    /// Distance from the object's centre to every camera in metres; at least 1.05 times the
    /// object's radius, at most 3 m. 0.3 when left out.
    #[serde(default = "default_radius")]
    pub radius: f64,
    /// Lowest elevation of a view above the horizontal plane through the object's centre,
    /// degrees; 5 when left out.
    #[serde(default = "default_min_elevation")]
    pub min_elevation_deg: f64,
    /// Highest elevation in degrees; 90 when left out.
    #[serde(default = "default_max_elevation")]
    pub max_elevation_deg: f64,
}

fn default_radius() -> f64 {
    0.3
}

fn default_min_elevation() -> f64 {
    5.0
}

fn default_max_elevation() -> f64 {
    90.0
}

impl Default for ViewSpaceJson {
    fn default() -> Self {
        Self {
            radius: default_radius(),
            min_elevation_deg: default_min_elevation(),
            max_elevation_deg: default_max_elevation(),
        }
    }
}

/// A set of views for an object at the origin.
#[derive(Clone, Debug, Serialize, ToSchema)]
pub struct ViewSpaceAnswer {
    /// Number of views.
    pub n: u32,
    /// The shell and band the set was made for.
    pub view_space: ViewSpaceJson,
    /// Smallest angle between two view directions in degrees; 180 for a single view.
    pub separation_deg: f64,
    /// The best separation known from a long search, degrees; null for bands and numbers that were
    /// not searched (most of 3 to 100 views on 0 to 90, 5 to 90 and 10 to 80 degrees were).
    pub best_known_deg: Option<f64>,
    /// The views; view 0 is the top view.
    pub views: Vec<ViewSpaceView>,
}

/// One view of a set.
#[derive(Clone, Debug, Serialize, ToSchema)]
pub struct ViewSpaceView {
    /// Index in the set.
    pub id: u32,
    /// Unit vector from the object's centre to the camera.
    pub direction: [f64; 3],
    /// From +x towards +y, degrees.
    pub azimuth_deg: f64,
    /// From the horizontal plane towards +z, degrees.
    pub elevation_deg: f64,
    /// `object_from_camera`: the object's centre is the origin, OpenCV camera axes.
    pub pose: PoseJson,
}

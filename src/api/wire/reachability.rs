//! `POST /v1/reachability`.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use super::WarningJson;

/// Which part of the band the arm can reach, and where the object would be served better.
#[derive(Clone, Debug, Serialize, Deserialize, ToSchema)]
#[schema(as = Reachability)]
pub struct ReachabilityAnswer {
    /// Reachable part of the band's area, 0 to 1.
    pub reachable_fraction: f64,
    /// One entry for each row of `grid`, lowest elevation first.
    pub by_elevation: Vec<BandPart>,
    /// One entry for each column of `grid`, from azimuth 0 (the base's x axis, seen from the object) on.
    pub by_azimuth: Vec<BandPart>,
    /// Rows by elevation, columns by azimuth, asked at the middle of each cell: `ok`, or the code of
    /// the reason as in a plan's views.
    pub grid: Vec<Vec<String>>,
    /// Number of cells by code.
    pub counts: BTreeMap<String, u32>,
    /// The object's place in the request, judged as `suggestions` are.
    pub given: PlaceJson,
    /// Up to three places of the object at the same height whose band can be reached better by at
    /// least a hundredth, best first, at least 0.05 m from each other.
    pub suggestions: Vec<PlaceJson>,
    /// What the caller should know.
    pub warnings: Vec<WarningJson>,
    /// Milliseconds by step.
    pub timings_ms: BTreeMap<String, f64>,
}

/// A row or a column of the band.
#[derive(Clone, Copy, Debug, Serialize, Deserialize, ToSchema)]
pub struct BandPart {
    /// Elevation or azimuth of its middle, degrees.
    pub angle_deg: f64,
    /// Reachable part of its area, 0 to 1.
    pub reachable_fraction: f64,
}

/// A place of the object.
#[derive(Clone, Copy, Debug, Serialize, Deserialize, ToSchema)]
#[schema(as = Place)]
pub struct PlaceJson {
    /// Centre of the object in the robot's `base` frame, metres.
    pub center: [f64; 3],
    /// Reachable part of the band about it, 0 to 1, from about 200 directions.
    pub reachable_fraction: f64,
}

//! Reconstructs one held-out object with the view count of each method.

use std::collections::BTreeMap;
use std::time::Duration;

use super::candidate::Candidate;
use super::counts::Method;
use crate::geometry::Point;
use crate::imaging::Camera;
use crate::label::photograph::{Photographer, pose};
use crate::label::protocol::{VIEW_RADIUS_M, nerf_bounds, seed_of, test_directions, training_directions};
use crate::label::record::LabelRecord;
use crate::nerf::{Bounds, NerfError, NerfSettings, train};
use crate::objects::ObjectEntry;
use crate::order::{Obstacle, OrderError, order_points};
use crate::predict::{PhotoInput, PredictError};
use crate::render::{MeshError, RenderSettings, Renderer};
use crate::views::{ViewsError, initial_views};

/// NeRFs of each view count, each with its own turn of the view set and seed.
pub const NERFS: usize = 2;
/// More than the exact order of 200 views needs.
const ORDER_BUDGET: Duration = Duration::from_secs(60);

/// What one method's view count leads to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outcome {
    /// The method.
    pub method: Method,
    /// Views.
    pub views: u32,
    /// Mean PSNR over the test views and NeRFs, dB.
    pub psnr_db: f64,
    /// Mean structural similarity over the same.
    pub ssim: f64,
    /// Length of the camera's shortest path through the views, metres.
    pub movement_m: f64,
}

/// An object reconstructed with the view count of every method.
#[derive(Clone, Debug, PartialEq)]
pub struct Trial {
    /// The object's key.
    pub object: String,
    /// Which of its sizes.
    pub draw: u64,
    /// One outcome a method, in the order of [`Method::ALL`].
    pub outcomes: Vec<Outcome>,
}

/// Why an object could not be reconstructed.
#[derive(Debug, thiserror::Error)]
pub enum TrialError {
    /// Its label is open ("no plateau").
    #[error("has no label")]
    NoLabel,
    /// Its model could not be loaded.
    #[error("model: {0}")]
    Mesh(#[from] MeshError),
    /// A view set could not be made.
    #[error("views: {0}")]
    Views(#[from] ViewsError),
    /// A NeRF could not be trained.
    #[error("NeRF: {0}")]
    Nerf(#[from] NerfError),
    /// The photos could not be used.
    #[error("prediction: {0}")]
    Predict(#[from] PredictError),
    /// The views could not be ordered.
    #[error("order: {0}")]
    Order(#[from] OrderError),
}

/// Reconstructs `entry` at the size of its label `record`. Methods that agree on a number share its NeRFs.
///
/// # Errors
/// [`TrialError`] says which part failed.
pub fn reconstruct(
    entry: &ObjectEntry,
    record: &LabelRecord,
    candidate: &Candidate,
    nerf: &NerfSettings,
) -> Result<Trial, TrialError> {
    let label = record.reading.v_gain.ok_or(TrialError::NoLabel)?;
    let mesh = entry.load()?;
    let renderer = Renderer::new(&mesh.fitted(Point::origin(), record.radius_m));
    let predicted = candidate.predictor.predict(&initial_photos(&renderer))?.rounded;
    let studio = Studio::new(renderer, record)?;
    let mut by_count = BTreeMap::new();
    let mut outcomes = Vec::new();
    for method in Method::ALL {
        let views = candidate.statistics.count(method, label, predicted);
        let (psnr_db, ssim, movement_m) = match by_count.get(&views) {
            Some(known) => *known,
            None => {
                let measured = studio.reconstruct(views as usize, nerf)?;
                by_count.insert(views, measured);
                measured
            }
        };
        outcomes.push(Outcome { method, views, psnr_db, ssim, movement_m });
    }
    Ok(Trial { object: record.object.clone(), draw: record.draw, outcomes })
}

/// Top, left and front, as the service's own initial plan takes them.
fn initial_photos(renderer: &Renderer) -> Vec<PhotoInput> {
    let camera = Camera::REALSENSE_D435;
    initial_views()
        .iter()
        .map(|view| {
            let photo = renderer.render(&camera, &pose(&view.direction), &RenderSettings::default());
            PhotoInput::looking_at_center(photo, camera, VIEW_RADIUS_M)
        })
        .collect()
}

/// An object with its novel views. They are not those of its label, which would favour it.
struct Studio {
    photographer: Photographer,
    tests: Vec<crate::imaging::PosedImage>,
    bounds: Bounds,
    obstacle: Obstacle,
    seed: u64,
}

impl Studio {
    fn new(renderer: Renderer, record: &LabelRecord) -> Result<Studio, ViewsError> {
        let photographer = Photographer::new(renderer);
        let seed = seed_of(&record.object, record.draw ^ 0x7ab1_e001);
        let tests = photographer.take(&test_directions(seed)?);
        let bounds = nerf_bounds(record.radius_m);
        let table_z_m = Some(-record.radius_m);
        let obstacle = Obstacle { center: Point::origin(), radius_m: record.radius_m, table_z_m };
        Ok(Studio { photographer, tests, bounds, obstacle, seed })
    }

    /// PSNR (dB), SSIM and path length (m) with this many views.
    fn reconstruct(&self, views: usize, settings: &NerfSettings) -> Result<(f64, f64, f64), TrialError> {
        let (mut psnr_db, mut ssim, mut movement_m) = (0.0, 0.0, 0.0);
        for k in 0..NERFS {
            let seed = self.seed.wrapping_add((views + 1000 * k) as u64);
            let directions = training_directions(views, seed)?;
            let places: Vec<Point> =
                directions.iter().map(|d| Point::origin() + d.into_inner() * VIEW_RADIUS_M).collect();
            movement_m += order_points(&places, 0, &self.obstacle, ORDER_BUDGET)?.length;
            let photos = self.photographer.take(&directions);
            let nerf = train(&photos, &self.bounds, &NerfSettings { seed, ..*settings }, &mut |_| {})?;
            let quality = nerf.evaluate(&self.tests);
            psnr_db += quality.mean_psnr_db();
            ssim += quality.mean_ssim();
        }
        let nerfs = NERFS as f64;
        Ok((psnr_db / nerfs, ssim / nerfs, movement_m / nerfs))
    }
}

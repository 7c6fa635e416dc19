//! Reconstructs one held-out object with the view count of each method.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::{Mutex, PoisonError};
use std::time::Duration;

use super::candidate::Candidate;
use super::counts::Method;
use super::store::{Reconstruction, ReconstructionStore, StoreError};
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
    /// What that many views lead to.
    pub reconstruction: Reconstruction,
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
    /// A reconstruction could not be kept.
    #[error("{0}")]
    Store(#[from] StoreError),
}

/// Reconstructs `entry` at the size of its label `record` with the number of every method. What `store` has is taken
/// from it, what it lacks is made and added.
///
/// # Errors
/// [`TrialError`] says which part failed.
pub fn reconstruct(
    entry: &ObjectEntry,
    record: &LabelRecord,
    candidate: &Candidate,
    nerf: &NerfSettings,
    store: &Mutex<ReconstructionStore>,
) -> Result<Trial, TrialError> {
    let label = record.reading.v_gain.ok_or(TrialError::NoLabel)?;
    let mesh = entry.load()?;
    let renderer = Renderer::new(&mesh.fitted(Point::origin(), record.radius_m));
    let predicted = candidate.predictor.predict(&initial_photos(&renderer))?.rounded;
    let counts = Method::ALL.map(|method| (method, candidate.statistics.count(method, label, predicted)));
    let store = || store.lock().unwrap_or_else(PoisonError::into_inner);
    let mut by_count: BTreeMap<u32, Reconstruction> =
        counts.iter().filter_map(|&(_, views)| Some((views, store().get(record, views)?))).collect();
    let missing: BTreeSet<u32> =
        counts.iter().map(|&(_, views)| views).filter(|views| !by_count.contains_key(views)).collect();
    if !missing.is_empty() {
        let studio = Studio::new(renderer, record)?;
        for views in missing {
            let made = studio.reconstruct(views as usize, nerf)?;
            by_count.insert(views, store().append(record, views, made)?);
        }
    }
    let outcome = |(method, views)| {
        by_count.get(&views).map(|&reconstruction| Outcome { method, views, reconstruction })
    };
    let outcomes = counts.into_iter().filter_map(outcome).collect();
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

    fn reconstruct(&self, views: usize, settings: &NerfSettings) -> Result<Reconstruction, TrialError> {
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
        Ok(Reconstruction { psnr_db: psnr_db / nerfs, ssim: ssim / nerfs, movement_m: movement_m / nerfs })
    }
}

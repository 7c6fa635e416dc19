//! Reconstructs one held-out object with the view count of each method.

use std::cell::OnceCell;
use std::sync::{Mutex, PoisonError};
use std::time::Duration;

use super::candidate::Candidate;
use super::counts::Method;
use super::store::{NERFS, Reconstruction, ReconstructionStore, ReconstructionStoreError};
use crate::geometry::Point;
use crate::imaging::{Camera, PosedImage};
use crate::label::measure::best_db;
use crate::label::photograph::{Photographer, pose};
use crate::label::protocol::{
    IMAGE_SIZE_PX, VIEW_RADIUS_M, nerf_bounds, seed_of, test_directions, training_directions,
};
use crate::label::record::LabelRecord;
use crate::nerf::{Bounds, NerfError, NerfSettings, train};
use crate::objects::ObjectEntry;
use crate::order::{Obstacle, OrderError, order_points};
use crate::predict::{PhotoInput, PredictError};
use crate::render::{MeshError, RenderSettings, Renderer};
use crate::views::{ViewsError, initial_views};

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
    Store(#[from] ReconstructionStoreError),
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
    let studio = Studio::new(renderer, record);
    let outcomes = outcomes(counts, record, nerf, store, |views| studio.reconstruct(views as usize, nerf))?;
    Ok(Trial { object: record.object.clone(), draw: record.draw, outcomes })
}

/// What each count leads to: out of the store, or made and added to it.
fn outcomes(
    counts: [(Method, u32); 5],
    record: &LabelRecord,
    nerf: &NerfSettings,
    store: &Mutex<ReconstructionStore>,
    make: impl Fn(u32) -> Result<Reconstruction, TrialError>,
) -> Result<Vec<Outcome>, TrialError> {
    let locked = || store.lock().unwrap_or_else(PoisonError::into_inner);
    let mut outcomes = Vec::new();
    for (method, views) in counts {
        let known = locked().get(record, nerf, views);
        let reconstruction = match known {
            Some(known) => known,
            None => {
                let made = make(views)?;
                locked().append(record, nerf, views, made)?
            }
        };
        outcomes.push(Outcome { method, views, reconstruction });
    }
    Ok(outcomes)
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
    /// Taken when the first NeRF is to be judged: an object whose reconstructions are all known needs none.
    tests: OnceCell<Vec<PosedImage>>,
    bounds: Bounds,
    obstacle: Obstacle,
    seed: u64,
}

impl Studio {
    fn new(renderer: Renderer, record: &LabelRecord) -> Studio {
        let table_z_m = Some(-record.radius_m);
        Studio {
            photographer: Photographer::new(renderer),
            tests: OnceCell::new(),
            bounds: nerf_bounds(record.radius_m),
            obstacle: Obstacle { center: Point::origin(), radius_m: record.radius_m, table_z_m },
            seed: seed_of(&record.object, record.draw ^ 0x7ab1_e001),
        }
    }

    /// Mean PSNR (dB), SSIM and path length (m) of [`NERFS`] NeRFs with this many views.
    fn reconstruct(&self, views: usize, settings: &NerfSettings) -> Result<Reconstruction, TrialError> {
        let tests = match self.tests.get() {
            Some(tests) => tests,
            None => {
                let taken = self.photographer.take(&test_directions(self.seed)?);
                self.tests.get_or_init(|| taken)
            }
        };
        let (mut psnr_db, mut ssim, mut movement_m) = (0.0, 0.0, 0.0);
        for k in 0..NERFS {
            let seed = self.seed.wrapping_add((views + 1000 * k) as u64);
            let directions = training_directions(views, seed)?;
            let places: Vec<Point> =
                directions.iter().map(|d| Point::origin() + d.into_inner() * VIEW_RADIUS_M).collect();
            movement_m += order_points(&places, 0, &self.obstacle, ORDER_BUDGET)?.length;
            let photos = self.photographer.take(&directions);
            let nerf = train(&photos, &self.bounds, &NerfSettings { seed, ..*settings }, &mut |_| {})?;
            let quality = nerf.evaluate(tests);
            let best = best_db(IMAGE_SIZE_PX * IMAGE_SIZE_PX);
            psnr_db += quality.psnr_db.iter().map(|psnr| psnr.min(best)).sum::<f64>() / tests.len() as f64;
            ssim += quality.mean_ssim();
        }
        let nerfs = NERFS as f64;
        Ok(Reconstruction { psnr_db: psnr_db / nerfs, ssim: ssim / nerfs, movement_m: movement_m / nerfs })
    }
}

#[cfg(test)]
mod tests {
    use std::cell::RefCell;

    use super::*;
    use crate::label::store::read_labels;

    #[test]
    fn a_count_is_reconstructed_once_whoever_asks_for_it() {
        let dir = tempfile::tempdir().unwrap();
        let store =
            || Mutex::new(ReconstructionStore::open(&dir.path().join("reconstructions.csv")).unwrap());
        let record = read_labels("models/labels.csv".as_ref()).unwrap().swap_remove(0);
        let asked = |store: &Mutex<ReconstructionStore>, views: [u32; 5]| {
            let made = RefCell::new(Vec::new());
            let counts = std::array::from_fn(|k| (Method::ALL[k], views[k]));
            let outcomes = outcomes(counts, &record, &NerfSettings::label(), store, |views| {
                made.borrow_mut().push(views);
                let v = f64::from(views);
                Ok(Reconstruction { psnr_db: 30.0 + v / 7.0, ssim: 0.9, movement_m: v })
            });
            (outcomes.unwrap(), made.into_inner())
        };
        let (first, made) = asked(&store(), [20, 24, 24, 24, 23]);
        assert_eq!(made, [20, 24, 23]);
        assert_eq!(first.iter().map(|o| o.views).collect::<Vec<_>>(), [20, 24, 24, 24, 23]);
        assert_eq!(first[1].reconstruction, first[3].reconstruction);
        let (again, made) = asked(&store(), [20, 24, 24, 25, 22]);
        assert_eq!(made, [25, 22]);
        assert_eq!(again[..3], first[..3]);
    }
}

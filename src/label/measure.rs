//! Measures one object: renders its view sets, trains a NeRF on each, fits the curve.

use std::time::Duration;

use super::fit::FitError;
use super::photograph::{Photographer, lattice, pose};
use super::protocol::{
    BLACK, MIN_COVERAGE, WHITE, curve_design, nerf_bounds, radius_draws, seed_of, test_directions,
    training_directions,
};
use super::reading::{Thresholds, read_label};
use super::record::{CurveSample, LabelRecord, as_written};
use crate::geometry::{Direction, Point};
use crate::imaging::{Camera, PosedImage};
use crate::nerf::{NerfError, NerfSettings, train};
use crate::objects::ObjectEntry;
use crate::render::{Mesh, MeshError, RenderSettings, Renderer};
use crate::views::{ViewsError, initial_views_five};

/// Why an object got no label.
#[derive(Debug, thiserror::Error)]
pub enum LabelError {
    /// Its model could not be loaded.
    #[error("model: {0}")]
    Mesh(#[from] MeshError),
    /// A view set could not be made.
    #[error("views: {0}")]
    Views(#[from] ViewsError),
    /// A NeRF could not be trained.
    #[error("NeRF: {0}")]
    Nerf(#[from] NerfError),
    /// The curve could not be fitted.
    #[error("curve: {0}")]
    Fit(#[from] FitError),
}

/// How labels are measured.
#[derive(Clone, Debug)]
pub struct LabelSettings {
    /// Training of every NeRF; one budget for all view sets and objects, since labels move with it.
    pub nerf: NerfSettings,
    /// Which of the object's sizes: with its key it fixes the radius.
    pub draw: u64,
    /// Which measurement of the object at this size: another one has other test views, turns of
    /// the view sets and NeRF seeds.
    pub repeat: u64,
}

impl Default for LabelSettings {
    fn default() -> Self {
        Self { nerf: NerfSettings::label(), draw: 0, repeat: 0 }
    }
}

/// Labels one object. `progress` is called after each NeRF with (done, all).
/// Deterministic in the object, its key and the settings, CPU seconds aside.
///
/// # Errors
/// [`LabelError`] says which part failed.
pub fn measure(
    entry: &ObjectEntry,
    settings: &LabelSettings,
    progress: &mut dyn FnMut(usize, usize),
) -> Result<LabelRecord, LabelError> {
    let started = thread_cpu_time();
    let seed = seed_of(&entry.key, settings.draw);
    let chance = seed_of(&entry.key, settings.draw ^ settings.repeat.wrapping_add(1).rotate_left(32));
    let mesh = entry.load()?;
    let (radius_m, renderer) = sized(&mesh, seed);
    let photographer = Photographer::new(renderer);
    let tests: Vec<PosedImage> = photographer
        .take(&test_directions(chance)?)
        .iter()
        .enumerate()
        .map(|(k, view)| lattice(view, k))
        .collect();

    let design = curve_design();
    let nerfs = design.iter().map(|(_, nerfs)| nerfs).sum();
    let bounds = nerf_bounds(radius_m);
    let best = best_db(tests.first().map_or(1, |view| view.image.width() * view.image.height()));
    let mut samples: Vec<CurveSample> = Vec::new();
    let mut done = 0;
    for (views, repeats) in design {
        let (mut psnr_db, mut both_db) = (Vec::new(), Vec::new());
        for k in 0..repeats {
            let chance = chance.wrapping_add((views + 1000 * k) as u64);
            let photos = photographer.take(&training_directions(views, chance)?);
            let nerf_settings = NerfSettings { seed: chance, ..settings.nerf };
            let nerf = train(&photos, &bounds, &nerf_settings, &mut |_| {})?;
            let each = nerf.psnr_db_over([BLACK, WHITE], &tests);
            let each: Vec<[f64; 2]> = each.into_iter().map(|over| over.map(|psnr| psnr.min(best))).collect();
            let mean = |values: &mut dyn Iterator<Item = f64>| values.sum::<f64>() / each.len() as f64;
            psnr_db.push(as_written(mean(&mut each.iter().map(|&[black, _]| black))));
            both_db.push(as_written(mean(&mut each.iter().map(|&[black, white]| together_db(black, white)))));
            done += 1;
            progress(done, nerfs);
        }
        samples.push(CurveSample { views, psnr_db, both_db });
    }
    Ok(LabelRecord {
        object: entry.key.clone(),
        name: entry.name.clone(),
        category: entry.category.clone(),
        licence: entry.licence.clone(),
        draw: settings.draw,
        repeat: settings.repeat,
        radius_m,
        seed,
        reading: read_label(&samples, Thresholds::default(), seed)?,
        samples,
        cpu_s: (thread_cpu_time() - started).as_secs_f64(),
    })
}

/// PSNR of the mean of two squared errors, dB.
fn together_db(a_db: f64, b_db: f64) -> f64 {
    let error = |psnr_db: f64| 10f64.powf(-psnr_db / 10.0);
    -10.0 * (0.5 * (error(a_db) + error(b_db))).log10()
}

/// PSNR of one step in one channel of one of the pixels, dB: a view without any error counts as this, not as
/// infinitely good, or a single one would leave its object without a mean.
pub(crate) fn best_db(pixels: u32) -> f64 {
    10.0 * (255.0 * 255.0 * 3.0 * f64::from(pixels)).log10()
}

/// The mesh about the origin at the first drawn radius at which it covers enough of the
/// camera's frame; the last draw when none does.
fn sized(mesh: &Mesh, seed: u64) -> (f64, Renderer) {
    let draws = radius_draws(seed);
    let mut sized = None;
    for radius_m in draws {
        let renderer = Renderer::new(&mesh.fitted(Point::origin(), radius_m));
        let enough = coverage(&renderer) > MIN_COVERAGE;
        sized = Some((radius_m, renderer));
        if enough {
            break;
        }
    }
    sized.unwrap_or_else(|| (draws[0], Renderer::new(&mesh.fitted(Point::origin(), draws[0]))))
}

/// Mean share of covered pixels over the five initial views of a D435, at an eighth of its resolution.
fn coverage(renderer: &Renderer) -> f64 {
    let full = Camera::REALSENSE_D435;
    let camera = Camera {
        width: full.width / 8,
        height: full.height / 8,
        fx: full.fx / 8.0,
        fy: full.fy / 8.0,
        cx: full.cx / 8.0,
        cy: full.cy / 8.0,
        ..full
    };
    let directions: Vec<Direction> = initial_views_five().iter().map(|v| v.direction).collect();
    let shares = directions.iter().map(|direction| {
        let image = renderer.render(&camera, &pose(direction), &RenderSettings::default());
        image.pixels().map(|p| f64::from(p[3]) / 255.0).sum::<f64>() / f64::from(camera.width * camera.height)
    });
    shares.sum::<f64>() / directions.len() as f64
}

/// CPU time of this thread: what a label costs, however busy the machine is. On systems
/// without a thread clock it is wall time.
fn thread_cpu_time() -> Duration {
    #[cfg(target_os = "linux")]
    {
        let time = rustix::time::clock_gettime(rustix::time::ClockId::ThreadCPUTime);
        Duration::new(time.tv_sec.unsigned_abs(), u32::try_from(time.tv_nsec).unwrap_or(0))
    }
    #[cfg(not(target_os = "linux"))]
    {
        static START: std::sync::OnceLock<std::time::Instant> = std::sync::OnceLock::new();
        START.get_or_init(std::time::Instant::now).elapsed()
    }
}

#[cfg(test)]
mod tests {
    use image::{Rgb, RgbImage};

    use super::{best_db, together_db};
    use crate::imaging::psnr;

    #[test]
    fn the_larger_of_two_errors_counts_most() {
        assert!((together_db(30.0, 30.0) - 30.0).abs() < 1e-12);
        // Half of a hundredth and half of nothing is a two-hundredth.
        assert!((together_db(20.0, f64::INFINITY) - 23.0103).abs() < 1e-4);
    }

    #[test]
    fn no_view_with_an_error_is_better_than_one_without() {
        let whole = RgbImage::from_pixel(64, 64, Rgb([7; 3]));
        let mut off = whole.clone();
        off.put_pixel(3, 5, Rgb([7, 8, 7]));
        assert!((psnr(&whole, &off) - best_db(64 * 64)).abs() < 1e-9);
        assert!(psnr(&whole, &whole).min(best_db(64 * 64)).is_finite());
    }
}

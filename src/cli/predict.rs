//! `prv predict`: photos on disk to a view count.

use std::path::{Path, PathBuf};

use image::RgbaImage;
use prv::imaging::{Camera, DEFAULT_MAX_PIXELS, decode_image};
use prv::plan::{Warning, blank_images, unlike_training};
use prv::predict::{MAX_IMAGES, PhotoInput, PredictError, Predictor, model_bytes};

use serde_json::json;

use super::camera_flag::CameraFlag;
use super::{CliResult, workers};

/// Predict how many views an object needs, from one to five photos of it.
///
/// The object's centre must lie on every photo's optical axis. Transparent pixels of a PNG are background.
#[derive(clap::Args)]
pub struct Args {
    /// Photos, PNG or JPEG; best are one from the top and two from the sides.
    #[arg(required = true, num_args = 1..=MAX_IMAGES)]
    images: Vec<PathBuf>,
    /// The camera's intrinsics: d435, or fx,fy,cx,cy[,k1,k2,p1,p2,k3] in pixels for the photos' own size. A
    /// D435 with a warning when left out, as in a request to the service.
    #[arg(long, env = "PRV_CAMERA", allow_hyphen_values = true)]
    camera: Option<CameraFlag>,
    /// Distance from the camera to the object's centre, metres.
    #[arg(long, env = "PRV_DISTANCE", default_value_t = 0.3, allow_hyphen_values = true)]
    distance: f64,
    /// The images are crops of `prv inputs` for this model: camera and distance are not needed.
    #[arg(long, env = "PRV_CROPS")]
    crops: bool,
    /// Another model than the one in the executable.
    #[arg(long, env = "PRV_MODEL")]
    model: Option<PathBuf>,
    /// Threads for the prediction; 0 for one a core. The answer does not depend on it.
    #[arg(long, env = "PRV_THREADS", default_value_t = 0)]
    threads: usize,
    /// Print JSON.
    #[arg(long, env = "PRV_JSON")]
    json: bool,
}

/// Runs the prediction.
pub fn run(args: &Args) -> CliResult {
    let threads = workers::threads(args.threads);
    let predictor = Predictor::load(&model_bytes(args.model.as_deref())?, threads, 1)?;
    let images = args.images.iter().map(|path| decode(path)).collect::<Result<Vec<_>, _>>()?;
    let named = |error| name_photo(error, &args.images);
    let crops = if args.crops {
        images
    } else {
        of_one_size(&images, &args.images)?;
        let photos: Vec<_> = images.into_iter().map(|image| photo(image, args)).collect();
        predictor.crops(&photos).map_err(named)?
    };
    let prediction = predictor.predict_crops(&crops).map_err(named)?;
    let info = predictor.info();
    let assumed = "no camera given: a RealSense D435's colour camera (1280x720, fx 915.607) is assumed";
    let mut warnings = Vec::new();
    if args.camera.is_none() && !args.crops {
        warnings.push(Warning::new("default_camera", assumed));
    }
    warnings.extend(unlike_training(prediction.novelty));
    warnings.extend(blank_images(&crops));
    warnings.iter().for_each(|warning| eprintln!("warning: {}", warning.message));
    if args.json {
        let mut answer = json!({
            "raw": prediction.raw,
            "predicted": prediction.rounded,
            "view_count": prediction.rounded,
            "interval": prediction.interval,
            "novelty": prediction.novelty,
            "label_range": [prediction.label_min, prediction.label_max],
            "model": {
                "sha256": info.sha256, "encoder": info.encoder, "trained_on": info.trained_on,
                "held_out_l1": info.held_out_l1, "best_constant_l1": info.best_constant_l1,
            },
        });
        answer["warnings"] = warnings.iter().map(|w| json!({"code": w.code, "message": w.message})).collect();
        println!("{answer:#}");
    } else {
        let [low, high] = prediction.interval;
        println!(
            "{} views ({:.2}); 80 % of objects lie within {low} to {high}",
            prediction.rounded, prediction.raw
        );
        eprintln!(
            "{} trained on {} labels; on other objects it was off by {:.1} views on average, the best constant by {:.1}",
            info.encoder, info.trained_on, info.held_out_l1, info.best_constant_l1
        );
    }
    Ok(())
}

fn decode(path: &Path) -> Result<RgbaImage, String> {
    let bytes = std::fs::read(path).map_err(|error| format!("{}: {error}", path.display()))?;
    decode_image(&bytes, DEFAULT_MAX_PIXELS).map_err(|error| format!("{}: {error}", path.display()))
}

/// Intrinsics are in pixels of the photos they belong to: one camera's are no other size's.
fn of_one_size(images: &[RgbaImage], paths: &[PathBuf]) -> Result<(), String> {
    let mut named = images.iter().zip(paths);
    let Some((first, first_path)) = named.next() else { return Ok(()) };
    match named.find(|(image, _)| image.dimensions() != first.dimensions()) {
        Some((other, path)) => Err(format!(
            "{}: {}x{} pixels, but {} has {}x{}; one camera takes photos of one size",
            path.display(),
            other.width(),
            other.height(),
            first_path.display(),
            first.width(),
            first.height()
        )),
        None => Ok(()),
    }
}

fn photo(image: RgbaImage, args: &Args) -> PhotoInput {
    let camera = match args.camera {
        Some(camera) => camera.for_size(image.width(), image.height()),
        None => Camera::REALSENSE_D435,
    };
    PhotoInput::looking_at_center(image, camera, args.distance)
}

/// On the command line a photo is known by its file, not by its number.
fn name_photo(error: PredictError, images: &[PathBuf]) -> String {
    let index = match &error {
        PredictError::ImageSize { index, .. }
        | PredictError::Camera { index, .. }
        | PredictError::Center { index, .. } => Some(*index),
        _ => None,
    };
    match index.and_then(|index| images.get(index)) {
        Some(path) => format!("{}: {error}", path.display()),
        None => error.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn photos_of_two_sizes_are_not_of_one_camera() {
        let of =
            |sizes: &[(u32, u32)]| -> Vec<_> { sizes.iter().map(|&(w, h)| RgbaImage::new(w, h)).collect() };
        let paths = ["top.png", "left.png", "front.png"].map(PathBuf::from);
        assert_eq!(of_one_size(&of(&[(64, 48), (64, 48), (64, 48)]), &paths), Ok(()));
        let told = of_one_size(&of(&[(64, 48), (64, 48), (48, 64)]), &paths).unwrap_err();
        assert!(told.starts_with("front.png: 48x64 pixels, but top.png has 64x48"), "{told}");
    }
}

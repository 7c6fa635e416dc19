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
            "{} trained on {} objects; on others it was off by {:.1} views on average, the best constant by {:.1}",
            info.encoder, info.trained_on, info.held_out_l1, info.best_constant_l1
        );
    }
    Ok(())
}

fn decode(path: &Path) -> Result<RgbaImage, String> {
    let bytes = std::fs::read(path).map_err(|error| format!("{}: {error}", path.display()))?;
    decode_image(&bytes, DEFAULT_MAX_PIXELS).map_err(|error| format!("{}: {error}", path.display()))
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

//! From photos to a view count.

use image::RgbaImage;
use ort::value::TensorRef;

use super::PredictError;
use super::crop::crop;
use super::model_info::{INPUT, ModelInfo, NOVELTY, VIEW_COUNT};
use super::session_pool::SessionPool;
use crate::geometry::Point;
use crate::imaging::Camera;

/// The most photos a prediction takes.
pub const MAX_IMAGES: usize = 5;

/// Bounds of the camera's distance to the object's centre, metres.
const DISTANCE_M: std::ops::RangeInclusive<f64> = 0.15..=5.0;
/// Bound of how far off the optical axis the object's centre may lie, as a tangent.
const MAX_OFF_AXIS: f64 = 2.0;

/// A photo of the object.
#[derive(Clone, Debug)]
pub struct PhotoInput {
    /// sRGB with straight alpha: transparent pixels are background. Opaque everywhere without a mask.
    pub image: RgbaImage,
    /// The camera's intrinsics, for the image's own size.
    pub camera: Camera,
    /// The object's centre in the camera's frame, metres.
    pub center_in_camera: Point,
}

impl PhotoInput {
    /// A photo whose optical axis passes through the object's centre at `distance_m`, as every pose of a plan does.
    pub fn looking_at_center(image: RgbaImage, camera: Camera, distance_m: f64) -> Self {
        Self { image, camera, center_in_camera: Point::new(0.0, 0.0, distance_m) }
    }

    fn check(&self, index: usize) -> Result<(), PredictError> {
        self.camera.check().map_err(|source| PredictError::Camera { index, source })?;
        let (width, height) = self.image.dimensions();
        if (width, height) != (self.camera.width, self.camera.height) {
            let (camera_width, camera_height) = (self.camera.width, self.camera.height);
            return Err(PredictError::ImageSize { index, width, height, camera_width, camera_height });
        }
        let wrong = |field, value, bound| Err(PredictError::Center { index, field, value, bound });
        let center = &self.center_in_camera;
        let distance_m = center.coords.norm();
        if !DISTANCE_M.contains(&distance_m) {
            return wrong("distance", distance_m, "0.15 to 5 m");
        }
        if center.z <= 0.0 {
            return wrong("z", center.z, "greater than 0");
        }
        let off_axis = center.x.hypot(center.y) / center.z;
        if off_axis > MAX_OFF_AXIS {
            return wrong("x/z", off_axis, "at most 2");
        }
        Ok(())
    }
}

/// How many views the object needs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prediction {
    /// The network's answer, between `label_min` and `label_max`.
    pub raw: f64,
    /// The answer as a number of views.
    pub rounded: u32,
    /// Least and largest number of views of the interval that holds 80 % of labels; `rounded` lies inside.
    pub interval: [u32; 2],
    /// How unlike the objects trained on the photos are: 1 is what one in a hundred of their own photos exceeds.
    pub novelty: f64,
    /// The smallest answer this model can give.
    pub label_min: u32,
    /// The largest answer this model can give.
    pub label_max: u32,
}

/// PRVNet, loaded and ready. Share it between threads by reference.
pub struct Predictor {
    info: ModelInfo,
    sessions: SessionPool,
}

impl Predictor {
    /// Loads a model in `models/training`'s format and runs it once on blank images.
    ///
    /// `threads` is how many threads one prediction uses, `pool` how many predictions run at a time (both at least 1).
    /// Each of the pool's sessions keeps its own copy of the weights.
    ///
    /// # Errors
    /// [`PredictError::NoModel`] for no bytes, [`PredictError::Runtime`] without ONNX Runtime,
    /// [`PredictError::Session`] for bytes that are no model, [`PredictError::Model`] for a model of another kind.
    pub fn load(model: &[u8], threads: usize, pool: usize) -> Result<Self, PredictError> {
        if model.is_empty() {
            return Err(PredictError::NoModel);
        }
        let sessions = SessionPool::load(model, threads, pool)?;
        let info = sessions.with(|session| ModelInfo::read(session, model))?;
        let predictor = Self { info, sessions };
        let side = predictor.info.input_size;
        predictor.predict_crops(&[RgbaImage::new(side, side)])?;
        Ok(predictor)
    }

    /// What the model says about itself.
    pub fn info(&self) -> &ModelInfo {
        &self.info
    }

    /// The view count for the object on one to five photos. Their order does not matter.
    ///
    /// # Errors
    /// [`PredictError::ImageCount`], or the first photo whose size, camera or distance is wrong.
    pub fn predict(&self, photos: &[PhotoInput]) -> Result<Prediction, PredictError> {
        self.predict_crops(&self.crops(photos)?)
    }

    /// One to five photos as the network sees them.
    ///
    /// # Errors
    /// As [`Self::predict`].
    pub fn crops(&self, photos: &[PhotoInput]) -> Result<Vec<RgbaImage>, PredictError> {
        check_count(photos.len())?;
        for (index, photo) in photos.iter().enumerate() {
            photo.check(index)?;
        }
        let size = self.info.input_size;
        let cut = |photo: &PhotoInput| crop(&photo.image, &photo.camera, &photo.center_in_camera, size);
        Ok(photos.iter().map(cut).collect())
    }

    /// As [`Self::predict`], for photos already cut by [`crop`] to the model's input size.
    ///
    /// # Errors
    /// [`PredictError::ImageCount`], or [`PredictError::ImageSize`] for a crop of another size.
    pub fn predict_crops(&self, crops: &[RgbaImage]) -> Result<Prediction, PredictError> {
        check_count(crops.len())?;
        let side = self.info.input_size;
        for (index, image) in crops.iter().enumerate() {
            let (width, height) = image.dimensions();
            if (width, height) != (side, side) {
                let (camera_width, camera_height) = (side, side);
                return Err(PredictError::ImageSize { index, width, height, camera_width, camera_height });
            }
        }
        // The variance over one image is undefined: a single one is fed twice, as in the authors' system.
        let twice = if let [single] = crops { Some(single) } else { None };
        let images: Vec<&RgbaImage> = crops.iter().chain(twice).collect();
        let data: Vec<f32> = images.iter().flat_map(|image| channels_on_white(image)).collect();
        let shape = [images.len(), 3, side as usize, side as usize];
        let (raw, novelty) = self.run(shape, &data)?;
        let (low, high) = (self.info.label_min, self.info.label_max);
        let clamped = raw.clamp(f64::from(low), f64::from(high));
        if raw.is_nan() || (raw - clamped).abs() > 1e-3 {
            return Err(unusable("answer", raw, format!("within the label range {low} to {high}")));
        }
        if !(novelty.is_finite() && novelty >= 0.0) {
            return Err(unusable("novelty", novelty, "a finite number of at least 0".to_owned()));
        }
        Ok(Prediction {
            raw: clamped,
            rounded: clamped.round() as u32,
            interval: self.info.interval.around(clamped),
            novelty,
            label_min: low,
            label_max: high,
        })
    }

    /// The model's answer and its score of unlikeness.
    fn run(&self, shape: [usize; 4], data: &[f32]) -> Result<(f64, f64), PredictError> {
        let run = |session: &mut ort::session::Session| -> ort::Result<Option<(f64, f64)>> {
            let outputs = session.run(ort::inputs![INPUT => TensorRef::from_array_view((shape, data))?])?;
            let number = |name: &str| -> ort::Result<Option<f64>> {
                let Some(output) = outputs.get(name) else { return Ok(None) };
                let (_, values) = output.try_extract_tensor::<f32>()?;
                Ok(values.first().copied().map(f64::from))
            };
            Ok(number(VIEW_COUNT)?.zip(number(NOVELTY)?))
        };
        self.sessions
            .with(run)
            .map_err(|error| PredictError::Session { action: "run", reason: error.to_string() })?
            .ok_or_else(|| PredictError::Session { action: "run", reason: "it gave no answer".to_owned() })
    }
}

fn unusable(field: &str, value: f64, bound: String) -> PredictError {
    PredictError::Model { field: field.to_owned(), value: value.to_string(), bound }
}

fn check_count(count: usize) -> Result<(), PredictError> {
    if (1..=MAX_IMAGES).contains(&count) {
        return Ok(());
    }
    Err(PredictError::ImageCount { count, max: MAX_IMAGES })
}

/// The image on white as red, green and blue planes, 0 to 1. Mean and deviation are the model's own business.
fn channels_on_white(image: &RgbaImage) -> impl Iterator<Item = f32> + '_ {
    (0..3).flat_map(move |channel| {
        image.pixels().map(move |pixel| {
            let (value, alpha) = (f32::from(pixel.0[channel]), f32::from(pixel.0[3]));
            (value * alpha + 255.0 * (255.0 - alpha)) / (255.0 * 255.0)
        })
    })
}

//! The number of views from photos.

use image::RgbaImage;

use super::{PlanError, PlanRequest, ViewSource};
use crate::geometry::Point;
use crate::predict::{PhotoInput, Predictor};

/// A predicted number of views.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CountPrediction {
    /// The network's number.
    pub raw: f64,
    /// Rounded.
    pub rounded: u32,
}

/// Predicts the number of views for the photos of a checked request.
///
/// A photo whose pose is known is cropped about the object's centre as seen from there; one
/// without is taken to look at the centre from the shell's radius.
///
/// # Errors
/// [`PlanError::Predict`]; [`PlanError::Invalid`] for a request without photos.
pub fn predict_count(request: &PlanRequest, predictor: &Predictor) -> Result<CountPrediction, PlanError> {
    let ViewSource::Photos(images) = &request.source else {
        return Err(PlanError::missing("images", "1 to 5 images"));
    };
    let center_in_camera = |index: usize| -> Point {
        let pose = request.photo_poses.as_ref().and_then(|poses| poses.get(index));
        match pose {
            Some(base_from_camera) => {
                base_from_camera.inverse_transform_point(&request.object().center_in_base)
            }
            None => Point::new(0.0, 0.0, request.shell.radius_m),
        }
    };
    let photo = |(index, image): (usize, &RgbaImage)| PhotoInput {
        image: image.clone(),
        camera: request.camera(),
        center_in_camera: center_in_camera(index),
    };
    let photos: Vec<PhotoInput> = images.iter().enumerate().map(photo).collect();
    let prediction = predictor.predict(&photos)?;
    Ok(CountPrediction { raw: prediction.raw, rounded: prediction.rounded })
}

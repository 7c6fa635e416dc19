//! The number of views from photos.

use image::RgbaImage;

use super::{PlanError, PlanRequest, ViewSource, Warning, photo_content};
use crate::geometry::Point;
use crate::predict::{PhotoInput, Prediction, Predictor};

/// Predicts the number of views for the photos of a checked request, and says what makes the number doubtful.
///
/// A photo whose pose is known is cropped about the object's centre as seen from there; one
/// without is taken to look at the centre from the shell's radius.
///
/// # Errors
/// [`PlanError::Predict`]; [`PlanError::Invalid`] for a request without photos.
pub fn predict_count(
    request: &PlanRequest,
    predictor: &Predictor,
) -> Result<(Prediction, Vec<Warning>), PlanError> {
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
    let crops = predictor.crops(&photos)?;
    let prediction = predictor.predict_crops(&crops)?;
    let mut warnings: Vec<Warning> = photo_content::unlike_training(prediction.novelty).into_iter().collect();
    warnings.extend(photo_content::blank_images(&crops));
    let radius_m = request.object().radius_m;
    warnings.extend(photo_content::cut_off(&photos, radius_m));
    warnings.extend(photo_content::unusual_size(radius_m, predictor.info().radius_m));
    Ok((prediction, warnings))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::imaging::Camera;
    use crate::plan::{ObjectSphere, ViewShell};
    use crate::predict::{SHIPPED_MODEL, model_bytes};
    use crate::render::{RenderSettings, Renderer, sample_object};
    use crate::views::{Band, initial_views_five};

    fn small_camera() -> Camera {
        Camera::square(320, 0.45)
    }

    fn request(images: Vec<RgbaImage>) -> PlanRequest {
        PlanRequest {
            source: ViewSource::Photos(images),
            photo_poses: None,
            camera: Some(small_camera()),
            object: Some(ObjectSphere::ASSUMED),
            shell: ViewShell { radius_m: 0.3, band: Band::DEFAULT },
            arm: None,
        }
    }

    /// The three initial photos of a sample object of the assumed size.
    fn photos_of(name: &str) -> Vec<RgbaImage> {
        let mesh = sample_object(name).unwrap().fitted(Point::origin(), ObjectSphere::ASSUMED.radius_m);
        let renderer = Renderer::new(&mesh);
        let space = request(Vec::new()).view_space();
        let views = initial_views_five();
        let photo = |pose| renderer.render(&small_camera(), &pose, &RenderSettings::default());
        views.iter().take(3).map(|view| photo(space.pose(&view.direction, 0.0))).collect()
    }

    fn noise(seed: u64) -> RgbaImage {
        use rand::{Rng, SeedableRng};
        let mut rng = rand_chacha::ChaCha8Rng::seed_from_u64(seed);
        let mut image = RgbaImage::new(320, 320);
        for pixel in image.pixels_mut() {
            *pixel = image::Rgba([rng.random(), rng.random(), rng.random(), 255]);
        }
        image
    }

    /// A wall and, from row 90 on, a table of planks with grain, with `photo` before them.
    fn on_a_table(photo: &RgbaImage) -> RgbaImage {
        let scene = |x: u32, y: u32| {
            let (x, y) = (f64::from(x), f64::from(y));
            if y < 90.0 {
                return [205.0 - 0.1 * x, 203.0 - 0.1 * x, 196.0 - 0.1 * x];
            }
            let along = y + 6.0 * (0.02 * x + (y / 40.0).floor()).sin();
            let grain =
                ((0.31 * along).sin() + (0.73 * along + 1.0).sin() + (1.37 * along + 2.0).sin()) / 3.0;
            let shade = 1.0 + 0.06 * grain + 0.05 * (y / 40.0).floor().sin() - 0.0004 * x;
            [166.0, 122.0, 82.0].map(|channel| channel * shade)
        };
        RgbaImage::from_fn(photo.width(), photo.height(), |x, y| {
            let [r, g, b, a] = photo.get_pixel(x, y).0.map(f64::from);
            let [s, t, u] = scene(x, y);
            let over = |front: f64, behind: f64| ((front * a + behind * (255.0 - a)) / 255.0).round() as u8;
            image::Rgba([over(r, s), over(g, t), over(b, u), 255])
        })
    }

    fn codes(warnings: &[Warning]) -> Vec<&str> {
        warnings.iter().map(|warning| warning.code).collect()
    }

    #[test]
    fn objects_on_a_table_are_familiar_to_the_shipped_model_and_the_table_without_them_is_not() {
        let predictor = Predictor::load(&model_bytes(None).unwrap(), 1, 1).unwrap();
        for name in ["mug", "plant", "robot"] {
            let photos = photos_of(name).iter().map(on_a_table).collect();
            let (answer, warnings) = predict_count(&request(photos), &predictor).unwrap();
            assert_eq!(codes(&warnings), Vec::<&str>::new(), "{name}: {answer:?}");
        }
        let nothing = RgbaImage::new(small_camera().width, small_camera().height);
        for count in [1, 3] {
            let (answer, warnings) =
                predict_count(&request(vec![on_a_table(&nothing); count]), &predictor).unwrap();
            assert_eq!(codes(&warnings), ["unlike_training_objects"], "{count}: {answer:?}");
        }
    }

    #[test]
    fn sample_objects_are_familiar_to_the_shipped_model_and_noise_is_not() {
        assert!(!SHIPPED_MODEL.is_empty());
        let predictor = Predictor::load(&model_bytes(None).unwrap(), 1, 1).unwrap();
        for name in ["mug", "plant", "robot"] {
            let (answer, warnings) = predict_count(&request(photos_of(name)), &predictor).unwrap();
            let [low, high] = answer.interval;
            assert!(low < answer.rounded && answer.rounded < high, "{name}: {answer:?}");
            assert!(answer.novelty < 1.0, "{name}: {answer:?}");
            assert_eq!(codes(&warnings), Vec::<&str>::new(), "{name}");
        }
        for count in [1, 3] {
            let (answer, warnings) =
                predict_count(&request((0..count).map(noise).collect()), &predictor).unwrap();
            assert_eq!(codes(&warnings), ["unlike_training_objects"], "{count}: {answer:?}");
            assert!(warnings[0].message.contains(&format!("{:.2}", answer.novelty)));
        }
        let black = RgbaImage::from_pixel(320, 320, image::Rgba([0, 0, 0, 255]));
        let (_, warnings) = predict_count(&request(vec![black; 3]), &predictor).unwrap();
        assert_eq!(codes(&warnings).iter().filter(|code| **code == "blank_image").count(), 3);
    }
}

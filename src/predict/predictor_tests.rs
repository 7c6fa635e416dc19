//! The predictor on small stand-in models (`tests/data/predict/make_models.py`).

use image::{Rgba, RgbaImage};

use super::{PhotoInput, PredictError, Predictor};
use crate::imaging::{Camera, Distortion};

macro_rules! model {
    ($name:literal) => {
        include_bytes!(concat!("../../tests/data/predict/", $name, ".onnx")).as_slice()
    };
}

fn tiny() -> Predictor {
    Predictor::load(model!("tiny"), 1, 1).unwrap()
}

fn filled(color: [u8; 4]) -> RgbaImage {
    RgbaImage::from_pixel(32, 32, Rgba(color))
}

/// What the stand-in computes, from each image's mean red, green and blue in 0 to 1.
fn expected(colors: &[[f64; 3]]) -> f64 {
    let n = colors.len() as f64;
    let (mut sum, mut variance) = (0.0, 0.0);
    for c in 0..3 {
        let mean = colors.iter().map(|color| color[c]).sum::<f64>() / n;
        sum += mean;
        variance += colors.iter().map(|color| (color[c] - mean).powi(2)).sum::<f64>() / (n - 1.0);
    }
    10.0 + 40.0 / (1.0 + (-(4.0 * (sum - 1.5) + 8.0 * variance)).exp())
}

#[test]
fn the_answer_is_the_models_for_two_to_five_images() {
    let predictor = tiny();
    let colors: Vec<[u8; 4]> = (0..5u8).map(|i| [40 * i, 90 + 20 * i, 100 - 15 * i, 255]).collect();
    for count in 2..=5 {
        let crops: Vec<_> = colors[..count].iter().map(|color| filled(*color)).collect();
        let means: Vec<_> =
            colors[..count].iter().map(|c| [0, 1, 2].map(|i| f64::from(c[i]) / 255.0)).collect();
        let answer = predictor.predict_crops(&crops).unwrap();
        assert!((answer.raw - expected(&means)).abs() < 1e-3, "{count}: {answer:?}");
        assert_eq!(answer.rounded, answer.raw.round() as u32);
        assert_eq!((answer.label_min, answer.label_max), (10, 50));
    }
}

#[test]
fn a_single_image_is_fed_twice() {
    let answer = tiny().predict_crops(&[filled([128, 128, 128, 255])]).unwrap();
    let gray = [128.0 / 255.0; 3];
    assert!((answer.raw - expected(&[gray, gray])).abs() < 1e-3);
}

#[test]
fn transparent_pixels_are_white() {
    let predictor = tiny();
    let answer = |color| predictor.predict_crops(&[filled(color)]).unwrap().raw;
    assert_eq!(answer([0, 0, 0, 0]), answer([255, 255, 255, 255]));
    let half = f64::from(255 - 100) / 255.0;
    assert!((answer([0, 0, 0, 100]) - expected(&[[half; 3], [half; 3]])).abs() < 1e-3);
}

#[test]
fn the_order_of_photos_does_not_matter_much_and_repeats_not_at_all() {
    let predictor = Predictor::load(model!("tiny"), 2, 2).unwrap();
    let (a, b) = (filled([250, 120, 3, 255]), filled([10, 40, 90, 255]));
    let first = predictor.predict_crops(&[a.clone(), b.clone()]).unwrap();
    assert!((predictor.predict_crops(&[b.clone(), a.clone()]).unwrap().raw - first.raw).abs() < 1e-4);
    std::thread::scope(|scope| {
        for _ in 0..6 {
            scope.spawn(|| assert_eq!(predictor.predict_crops(&[a.clone(), b.clone()]).unwrap(), first));
        }
    });
}

#[test]
fn a_photo_of_any_size_becomes_a_prediction() {
    let camera = Camera {
        distortion: Distortion { k1: 0.1, k2: -0.2, ..Distortion::default() },
        ..Camera::square(201, 0.5)
    };
    let photo = PhotoInput::looking_at_center(RgbaImage::from_pixel(201, 201, Rgba([9; 4])), camera, 0.3);
    assert!(tiny().predict(&[photo.clone(), photo]).unwrap().raw.is_finite());
}

#[test]
fn too_few_and_too_many_photos_are_refused() {
    let photo = PhotoInput::looking_at_center(filled([1; 4]), Camera::square(32, 0.5), 0.3);
    for count in [0, 6] {
        let error = tiny().predict(&vec![photo.clone(); count]).unwrap_err();
        assert!(matches!(error, PredictError::ImageCount { count: c, max: 5 } if c == count));
    }
}

#[test]
fn a_photo_of_another_size_than_its_cameras_is_refused() {
    let photo = PhotoInput::looking_at_center(filled([1; 4]), Camera::square(33, 0.5), 0.3);
    let error = tiny().predict(&[photo]).unwrap_err();
    assert!(matches!(error, PredictError::ImageSize { index: 0, width: 32, camera_width: 33, .. }));
}

#[test]
fn a_center_the_camera_cannot_see_is_refused_with_its_number() {
    for (distance_m, wanted) in [(f64::NAN, "distance"), (300.0, "distance"), (-0.3, "z"), (0.0, "distance")]
    {
        let photo = PhotoInput::looking_at_center(filled([1; 4]), Camera::square(32, 0.5), distance_m);
        let error = tiny().predict(&[photo]).unwrap_err();
        assert!(matches!(error, PredictError::Center { field, .. } if field == wanted), "{error}");
    }
}

#[test]
fn no_model_says_how_to_give_one() {
    let error = Predictor::load(&[], 1, 1).err().unwrap();
    assert!(error.to_string().contains("--model"));
}

#[test]
fn bytes_that_are_no_model_are_refused() {
    let error = Predictor::load(b"not a model", 1, 1).err().unwrap();
    assert!(matches!(error, PredictError::Session { action: "load", .. }));
}

#[test]
fn a_model_of_another_kind_is_refused_at_load_with_what_is_wrong() {
    for (model, wanted) in [
        (model!("no_metadata"), "metadata prv.input_size"),
        (model!("label_range_reversed"), "metadata prv.label_max"),
        (model!("another_size"), "input"),
        (model!("another_input"), "input"),
        (model!("old_format"), "metadata prv.format"),
        (model!("without_novelty"), "output"),
        (model!("interval_beside_the_answer"), "metadata prv.interval_low"),
        (model!("another_window"), "metadata prv.crop_half_size_m"),
        (model!("answers_out_of_range"), "answer"),
    ] {
        let error = Predictor::load(model, 1, 1).err().unwrap();
        assert!(matches!(&error, PredictError::Model { field, .. } if field == wanted), "{error}");
    }
}

#[test]
fn a_model_of_the_format_before_is_refused_with_what_to_do() {
    let error = Predictor::load(model!("old_format"), 1, 1).err().unwrap();
    assert!(error.to_string().contains("export the model again"), "{error}");
}

#[test]
fn the_interval_is_the_models_and_the_novelty_its_second_output() {
    let predictor = tiny();
    let answer = predictor.predict_crops(&[filled([128, 128, 128, 255])]).unwrap();
    let ends = [(answer.raw - 6.5).ceil(), (answer.raw + 9.25).floor()].map(|end| end as u32);
    assert_eq!(answer.interval, ends);
    assert!((answer.novelty - (2.0 - 2.0 * 128.0 / 255.0)).abs() < 1e-5, "{}", answer.novelty);
    assert_eq!(predictor.info().radius_m, (0.07, 0.12));
}

#[test]
fn a_model_tells_what_it_was_trained_on() {
    let predictor = tiny();
    let info = predictor.info();
    assert_eq!((info.encoder.as_str(), info.trained_on, info.input_size), ("mean colour", 1, 32));
    assert_eq!((info.held_out_l1, info.best_constant_l1), (9.5, 10.25));
    assert_eq!(info.sha256.len(), 64);
}

#[test]
fn the_shipped_model_can_be_loaded_if_there_is_one() {
    match Predictor::load(super::SHIPPED_MODEL, 1, 1) {
        Ok(predictor) => assert!(predictor.info().held_out_l1 > 0.0),
        Err(error) => assert!(matches!(error, PredictError::NoModel), "{error}"),
    }
}

//! What makes the number of views predicted from photos doubtful. None of it is an error: the number may serve.

use std::f64::consts::TAU;

use image::RgbaImage;

use super::Warning;
use crate::geometry::{Point, Vector};
use crate::predict::PhotoInput;

/// A crop of which at least this share is nearly black, or nearly white, shows no object. The smallest objects
/// trained on cover 3.5 % of their photos on average (paper, section on the dataset), thin ones from the top less.
const BLANK_SHARE: f64 = 0.995;
/// Bytes up to which a channel is nearly black, and from which nearly white.
const NEARLY_BLACK: u8 = 12;
const NEARLY_WHITE: u8 = 246;
/// Photos trained on cut off at most a twentieth of the object's disc (0.12 m at 0.3 m in a D435's photo).
const CUT_OFF_SHARE: f64 = 0.1;
/// The object's radius may leave the range trained on by this share.
const SIZE_TOLERANCE: f64 = 0.1;

/// A warning if `novelty` is beyond what the training objects' own photos reach.
pub fn unlike_training(novelty: f64) -> Option<Warning> {
    (novelty > 1.0).then(|| {
        let text = format!(
            "the photos are unlike those of the objects trained on: novelty {novelty:.2}, where one in a hundred of \
             theirs exceeds 1; the predicted number and its interval may be far off"
        );
        Warning::new("unlike_training_objects", text)
    })
}

/// A warning for each crop that is black or white all over.
pub fn blank_images(crops: &[RgbaImage]) -> Vec<Warning> {
    let warn = |(index, crop): (usize, &RgbaImage)| {
        let pixels = f64::from(crop.width()) * f64::from(crop.height());
        let share = |kind: fn(&[u8; 4]) -> bool| {
            crop.pixels().filter(|pixel| kind(&pixel.0)).count() as f64 / pixels.max(1.0)
        };
        // Transparent pixels are white to the network.
        let white = |[r, g, b, a]: &[u8; 4]| *a == 0 || *r.min(g).min(b) >= NEARLY_WHITE;
        let black = |[r, g, b, a]: &[u8; 4]| *a > 0 && *r.max(g).max(b) <= NEARLY_BLACK;
        let (share, color) = match (share(white), share(black)) {
            (share, _) if share >= BLANK_SHARE => (share, "white or transparent"),
            (_, share) if share >= BLANK_SHARE => (share, "black"),
            _ => return None,
        };
        let text = format!(
            "images[{index}]: {:.1} % of what is around the object's centre is nearly {color}; no object can be seen",
            100.0 * share
        );
        Some(Warning::new("blank_image", text))
    };
    crops.iter().enumerate().filter_map(warn).collect()
}

/// A warning for each photo that cuts off much of the object's sphere.
pub fn cut_off(photos: &[PhotoInput], radius_m: f64) -> Vec<Warning> {
    let warn = |(index, photo): (usize, &PhotoInput)| {
        let share = share_outside(photo, radius_m)?;
        let text = || {
            format!(
                "images[{index}] cuts off {:.0} % of the object's sphere (radius {radius_m} m)",
                100.0 * share
            )
        };
        (share > CUT_OFF_SHARE).then(|| Warning::new("object_cut_off", text()))
    };
    photos.iter().enumerate().filter_map(warn).collect()
}

/// A warning for an object larger or smaller than those trained on.
pub fn unusual_size(radius_m: f64, (least_m, largest_m): (f64, f64)) -> Option<Warning> {
    let usual = least_m * (1.0 - SIZE_TOLERANCE)..=largest_m * (1.0 + SIZE_TOLERANCE);
    (!usual.contains(&radius_m)).then(|| {
        let text = format!(
            "the prediction was trained on objects of {least_m:.3} to {largest_m:.3} m radius, this one has \
             {radius_m} m"
        );
        Warning::new("unusual_object_size", text)
    })
}

/// Share of the disc through the object's centre, facing the camera, that lies outside the photo.
fn share_outside(photo: &PhotoInput, radius_m: f64) -> Option<f64> {
    const RINGS: u32 = 8;
    const SPOKES: u32 = 32;
    let center = &photo.center_in_camera;
    let toward = center.coords.try_normalize(1e-9)?;
    let across = toward.cross(&Vector::y()).try_normalize(1e-9)?;
    let along = toward.cross(&across);
    let (width, height) = (f64::from(photo.camera.width), f64::from(photo.camera.height));
    let outside = |point: Point| {
        let pixel = photo.camera.project(&point);
        !pixel.is_some_and(|p| (0.0..=width).contains(&p.x) && (0.0..=height).contains(&p.y))
    };
    let count = (0..RINGS * SPOKES).filter(|i| {
        // Rings of equal area.
        let distance_m = radius_m * ((f64::from(i / SPOKES) + 0.5) / f64::from(RINGS)).sqrt();
        let (sin, cos) = (TAU * f64::from(i % SPOKES) / f64::from(SPOKES)).sin_cos();
        outside(center + distance_m * (cos * across + sin * along))
    });
    Some(count.count() as f64 / f64::from(RINGS * SPOKES))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::imaging::Camera;

    fn photo(camera: Camera, distance_m: f64) -> PhotoInput {
        let image = RgbaImage::new(camera.width, camera.height);
        PhotoInput::looking_at_center(image, camera, distance_m)
    }

    #[test]
    fn photos_like_those_trained_on_cut_little_off() {
        let usual = photo(Camera::REALSENSE_D435, 0.3);
        assert!(cut_off(std::slice::from_ref(&usual), 0.12).is_empty());
        assert_eq!(share_outside(&usual, 0.05), Some(0.0));
    }

    #[test]
    fn an_object_beside_the_photo_is_said_to_be_cut_off_by_half() {
        let mut aside = photo(Camera::square(200, 0.5), 1.0);
        aside.camera.cx = 0.0;
        let share = share_outside(&aside, 0.1).unwrap();
        assert!((share - 0.5).abs() < 0.05, "{share}");
        let warnings = cut_off(&[aside], 0.1);
        assert_eq!(warnings[0].code, "object_cut_off");
        assert!(warnings[0].message.starts_with("images[0]"));
    }

    #[test]
    fn blank_photos_are_named_and_a_thin_object_is_not_blank() {
        let filled = |color| RgbaImage::from_pixel(100, 100, image::Rgba(color));
        let mut thin = filled([255; 4]);
        for y in 0..100 {
            thin.put_pixel(50, y, image::Rgba([90, 60, 30, 255]));
        }
        let crops = [thin, filled([3, 4, 5, 255]), filled([0; 4]), filled([250, 251, 252, 255])];
        let warnings = blank_images(&crops);
        let named: Vec<&str> = warnings.iter().map(|w| &w.message[..9]).collect();
        assert_eq!(named, ["images[1]", "images[2]", "images[3]"]);
    }

    #[test]
    fn only_sizes_well_outside_of_the_trained_ones_are_unusual() {
        let trained = (0.07, 0.12);
        assert!(unusual_size(0.065, trained).is_none() && unusual_size(0.13, trained).is_none());
        let warning = unusual_size(0.03, trained).unwrap();
        assert!(warning.message.contains("0.070 to 0.120 m") && warning.message.contains("0.03 m"));
    }

    #[test]
    fn novelty_beyond_one_is_told_with_its_number() {
        assert!(unlike_training(1.0).is_none());
        assert!(unlike_training(1.37).unwrap().message.contains("1.37"));
    }
}

//! What makes the number of views predicted from photos doubtful. None of it is an error: the number may serve.

use std::f64::consts::TAU;

use image::RgbaImage;

use super::Warning;
use crate::geometry::{Point, Vector};
use crate::imaging::Camera;
use crate::predict::PhotoInput;

/// A crop of which at least this share is nearly white, or of nearly one colour, shows no object. The smallest objects
/// trained on cover 3.5 % of their photos on average (paper, section on the dataset), thin ones from the top less.
const BLANK_SHARE: f64 = 0.995;
/// Byte from which a channel is nearly white.
const NEARLY_WHITE: u8 = 246;
/// How far a channel of nearly the same colour may be off, bytes: more than a dark sensor's noise.
const NEARLY_SAME: u8 = 12;
/// A crop may reach beyond its photo, whose outside is transparent. With less than this share inside, one colour may be
/// an object cut out by its mask, whose sphere covers at most 0.62 of a crop.
const PHOTO_SHARE: f64 = 0.7;
/// Photos trained on cut off at most a twentieth of the object's disc (0.12 m at 0.3 m in a D435's photo).
const CUT_OFF_SHARE: f64 = 0.1;
/// The object's radius may leave the range trained on by this share.
const SIZE_TOLERANCE: f64 = 0.1;

/// A warning if `novelty` is beyond what the training objects' own photos reach, as that of an empty table is.
pub fn unlike_training(novelty: f64) -> Option<Warning> {
    (novelty > 1.0).then(|| {
        let text = format!(
            "the photos are unlike those of the objects trained on, or show no object: novelty {novelty:.2}, where one \
             in a hundred of theirs exceeds 1; the predicted number and its interval may be far off"
        );
        Warning::new("unlike_training_objects", text)
    })
}

/// A warning for each crop that is white or transparent all over, or of one colour wherever it lies in its photo.
pub fn blank_images(crops: &[RgbaImage]) -> Vec<Warning> {
    let warn = |(index, crop): (usize, &RgbaImage)| {
        let pixels = f64::from(crop.width()) * f64::from(crop.height());
        // Transparent pixels are white to the network.
        let white = |[r, g, b, a]: [u8; 4]| a == 0 || r.min(g).min(b) >= NEARLY_WHITE;
        let white = crop.pixels().filter(|pixel| white(pixel.0)).count() as f64 / pixels.max(1.0);
        let (share, color) = if white >= BLANK_SHARE {
            (white, "white or transparent".to_owned())
        } else {
            let (share, [r, g, b]) = one_color(crop)?;
            (share, format!("of one colour ({r}, {g}, {b})"))
        };
        let text = format!(
            "images[{index}]: {:.1} % of what is around the object's centre is nearly {color}; no object can be seen",
            100.0 * share
        );
        Some(Warning::new("blank_image", text))
    };
    crops.iter().enumerate().filter_map(warn).collect()
}

/// The colour that at least [`BLANK_SHARE`] of the pixels inside the photo have, nearly, and their share; `None` where
/// they differ, or too little of the crop lies in the photo.
fn one_color(crop: &RgbaImage) -> Option<(f64, [u8; 3])> {
    let inside: Vec<[u8; 3]> =
        crop.pixels().filter(|pixel| pixel[3] > 0).map(|&image::Rgba([r, g, b, _])| [r, g, b]).collect();
    let all = f64::from(crop.width()) * f64::from(crop.height());
    if inside.is_empty() || (inside.len() as f64) < PHOTO_SHARE * all {
        return None;
    }
    let median = std::array::from_fn(|channel| {
        let mut bytes: Vec<u8> = inside.iter().map(|pixel| pixel[channel]).collect();
        let middle = bytes.len() / 2;
        *bytes.select_nth_unstable(middle).1
    });
    let same = |pixel: &&[u8; 3]| (0..3).all(|k| pixel[k].abs_diff(median[k]) <= NEARLY_SAME);
    let share = inside.iter().filter(same).count() as f64 / inside.len() as f64;
    (share >= BLANK_SHARE).then_some((share, median))
}

/// A warning for each photo that cuts off much of the object's sphere.
pub fn cut_off(photos: &[PhotoInput], radius_m: f64) -> Vec<Warning> {
    let warn = |(index, photo): (usize, &PhotoInput)| {
        let share = share_outside(&photo.camera, &photo.center_in_camera, radius_m)?;
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

/// A warning if views that look at the object's centre from `distance_m` cut off much of its sphere.
pub fn views_cut_off(camera: &Camera, distance_m: f64, radius_m: f64) -> Option<Warning> {
    let share = share_outside(camera, &Point::new(0.0, 0.0, distance_m), radius_m)?;
    (share > CUT_OFF_SHARE).then(|| {
        let text = format!(
            "every view, {distance_m} m from the object's centre, cuts off {:.0} % of its sphere (radius {radius_m} m)",
            100.0 * share
        );
        Warning::new("object_cut_off", text)
    })
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
fn share_outside(camera: &Camera, center_in_camera: &Point, radius_m: f64) -> Option<f64> {
    const RINGS: u32 = 8;
    const SPOKES: u32 = 32;
    let center = center_in_camera;
    let toward = center.coords.try_normalize(1e-9)?;
    let across = toward.cross(&Vector::y()).try_normalize(1e-9)?;
    let along = toward.cross(&across);
    let (width, height) = (f64::from(camera.width), f64::from(camera.height));
    let outside = |point: Point| {
        let pixel = camera.project(&point);
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

    fn photo(camera: Camera, distance_m: f64) -> PhotoInput {
        let image = RgbaImage::new(camera.width, camera.height);
        PhotoInput::looking_at_center(image, camera, distance_m)
    }

    #[test]
    fn photos_like_those_trained_on_cut_little_off() {
        let usual = photo(Camera::REALSENSE_D435, 0.3);
        assert!(cut_off(std::slice::from_ref(&usual), 0.12).is_empty());
        assert_eq!(share_outside(&usual.camera, &usual.center_in_camera, 0.05), Some(0.0));
        assert!(views_cut_off(&Camera::REALSENSE_D435, 0.3, 0.12).is_none());
    }

    #[test]
    fn an_object_beside_the_photo_is_said_to_be_cut_off_by_half() {
        let mut aside = photo(Camera::square(200, 0.5), 1.0);
        aside.camera.cx = 0.0;
        let share = share_outside(&aside.camera, &aside.center_in_camera, 0.1).unwrap();
        assert!((share - 0.5).abs() < 0.05, "{share}");
        let warnings = cut_off(&[aside], 0.1);
        assert_eq!(warnings[0].code, "object_cut_off");
        assert!(warnings[0].message.starts_with("images[0]"));
    }

    #[test]
    fn views_through_a_lens_ten_times_too_long_are_said_to_cut_the_object_off() {
        let long = Camera { fx: 9156.0, fy: 9156.0, ..Camera::REALSENSE_D435 };
        let warning = views_cut_off(&long, 0.3, 0.1).unwrap();
        assert_eq!(warning.code, "object_cut_off");
        assert!(warning.message.contains("0.3 m"), "{}", warning.message);
    }

    #[test]
    fn a_photo_of_one_colour_is_blank_also_where_the_crop_reaches_beyond_it() {
        let mut beyond = RgbaImage::from_pixel(100, 100, image::Rgba([4, 3, 9, 255]));
        for y in (0..6).chain(94..100) {
            (0..100).for_each(|x| beyond.put_pixel(x, y, image::Rgba([0; 4])));
        }
        let orange = RgbaImage::from_pixel(100, 100, image::Rgba([200, 100, 50, 255]));
        // A black ball, cut out by its mask.
        let ball = RgbaImage::from_fn(100, 100, |x, y| {
            let inside = (f64::from(x) - 50.0).hypot(f64::from(y) - 50.0) < 44.0;
            image::Rgba([0, 0, 0, if inside { 255 } else { 0 }])
        });
        let warnings = blank_images(&[beyond, orange, ball]);
        let named: Vec<&str> = warnings.iter().map(|w| &w.message[..9]).collect();
        assert_eq!(named, ["images[0]", "images[1]"]);
        assert!(warnings[1].message.contains("(200, 100, 50)"));
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

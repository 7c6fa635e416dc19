//! What the crop keeps and what it drops.

use image::{Rgba, RgbaImage};
use proptest::prelude::*;

use super::{CROP_HALF_SIZE_M, crop};
use crate::geometry::{Point, Vector};
use crate::imaging::{Camera, Distortion};

const CENTER: Point = Point::new(0.0, 0.0, 0.3);

/// A red ball on transparent ground, as `camera` sees it.
fn ball(camera: &Camera, center_in_camera: &Point, radius_m: f64) -> RgbaImage {
    RgbaImage::from_fn(camera.width, camera.height, |x, y| {
        let ray = camera.ray_in_camera(nalgebra::Vector2::new(f64::from(x) + 0.5, f64::from(y) + 0.5));
        let off = ray.normalize().cross(&center_in_camera.coords).norm();
        if off < radius_m { Rgba([200, 20, 30, 255]) } else { Rgba([0; 4]) }
    })
}

/// Radius in metres at the centre's distance of the disc with the crop's covered area, and its centre's
/// distance from the crop's middle in pixels.
fn covered(crop: &RgbaImage) -> (f64, f64) {
    let (mut area, mut first) = (0.0, Vector::zeros());
    for (x, y, pixel) in crop.enumerate_pixels() {
        let weight = f64::from(pixel.0[3]) / 255.0;
        area += weight;
        first += Vector::new(f64::from(x) + 0.5, f64::from(y) + 0.5, 0.0) * weight;
    }
    let middle = f64::from(crop.width()) / 2.0;
    let pixel_m = 2.0 * CROP_HALF_SIZE_M / f64::from(crop.width());
    ((area / std::f64::consts::PI).sqrt() * pixel_m, (first / area - Vector::new(middle, middle, 0.0)).norm())
}

/// Radius of a ball's outline in the plane of its centre.
fn outline(radius_m: f64, distance_m: f64) -> f64 {
    radius_m * distance_m / (distance_m * distance_m - radius_m * radius_m).sqrt()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]
    #[test]
    fn a_ball_is_as_large_as_it_is_whatever_the_camera(
        radius_m in 0.05..0.1f64, f in 80.0..1500.0f64, z in 0.25..0.6f64,
        cx in 150.0..250.0f64, k1 in -0.1..0.1f64,
    ) {
        // A window that leaves the photo would cut the ball.
        prop_assume!(f * outline(radius_m, z) / z < 140.0);
        let camera = Camera {
            width: 400, height: 300, fx: f, fy: f * 1.02, cx, cy: 150.0,
            distortion: Distortion { k1, k2: 0.02, p1: 0.001, p2: -0.001, k3: 0.0 },
        };
        let center = Point::new(0.0, 0.0, z);
        let (radius, off) = covered(&crop(&ball(&camera, &center, radius_m), &camera, &center, 96));
        prop_assert!((radius - outline(radius_m, z)).abs() < 0.002, "{radius} of {}", outline(radius_m, z));
        prop_assert!(off < 0.7, "{off}");
    }
}

#[test]
fn an_object_off_the_optical_axis_is_centred() {
    let camera = Camera::REALSENSE_D435;
    let center = Point::new(0.05, -0.03, 0.35);
    let (radius, off) = covered(&crop(&ball(&camera, &center, 0.05), &camera, &center, 128));
    assert!((radius - outline(0.05, center.coords.norm())).abs() < 0.001 && off < 0.5, "{radius} {off}");
}

#[test]
fn up_stays_up() {
    let camera = Camera::square(200, 0.5);
    let image = RgbaImage::from_fn(200, 200, |x, y| Rgba([x as u8, y as u8, 0, 255]));
    let crop = crop(&image, &camera, &CENTER, 64);
    let (first, last) = (crop.get_pixel(0, 0).0, crop.get_pixel(63, 63).0);
    assert!(first[0] < 20 && first[1] < 20 && last[0] > 180 && last[1] > 180, "{first:?} {last:?}");
}

#[test]
fn texture_finer_than_a_pixel_becomes_its_mean() {
    let camera = Camera::square(1600, 0.5);
    let checks = RgbaImage::from_fn(1600, 1600, |x, y| {
        Rgba(if (x + y) % 2 == 0 { [255, 255, 255, 255] } else { [0, 0, 0, 255] })
    });
    let crop = crop(&checks, &camera, &CENTER, 64);
    assert!(crop.pixels().all(|pixel| (i32::from(pixel.0[0]) - 128).abs() <= 3 && pixel.0[3] == 255));
}

#[test]
fn outside_the_photo_is_transparent() {
    let camera = Camera::REALSENSE_D435;
    let crop = crop(&RgbaImage::from_pixel(1280, 720, Rgba([9, 9, 9, 255])), &camera, &CENTER, 224);
    // The window is 824 pixels high, the photo 720.
    assert_eq!(crop.get_pixel(112, 0).0[3], 0);
    assert_eq!(crop.get_pixel(112, 223).0[3], 0);
    assert_eq!(crop.get_pixel(112, 112).0, [9, 9, 9, 255]);
    assert_eq!(crop.get_pixel(1, 112).0, [9, 9, 9, 255]);
}

#[test]
fn colour_under_transparent_pixels_does_not_bleed() {
    let camera = Camera::square(300, 0.5);
    let image =
        RgbaImage::from_fn(300, 300, |x, _| Rgba(if x % 2 == 0 { [255, 0, 0, 255] } else { [0, 255, 0, 0] }));
    let crop = crop(&image, &camera, &CENTER, 64);
    assert!(crop.pixels().all(|pixel| pixel.0[1] == 0 && pixel.0[0] == 255));
}

#[test]
fn a_photo_of_one_pixel_or_a_point_behind_the_camera_gives_no_panic() {
    let camera = Camera::square(1, 0.5);
    let image = RgbaImage::from_pixel(1, 1, Rgba([5; 4]));
    assert_eq!(crop(&image, &camera, &CENTER, 8).dimensions(), (8, 8));
    for center in [Point::new(0.0, 0.0, -0.3), Point::new(f64::NAN, 0.0, 0.3), Point::origin()] {
        assert!(crop(&image, &camera, &center, 8).pixels().all(|pixel| pixel.0[3] == 0));
    }
}

#[test]
fn distortion_that_folds_back_shows_nothing_twice() {
    // This lens folds at a normalised radius of about 0.33; the window reaches to 0.64.
    let camera =
        Camera { distortion: Distortion { k1: -3.0, ..Distortion::default() }, ..Camera::square(200, 0.5) };
    let crop = crop(&RgbaImage::from_pixel(200, 200, Rgba([7, 7, 7, 255])), &camera, &CENTER, 64);
    assert_eq!(crop.get_pixel(0, 0).0[3], 0);
    assert_eq!(crop.get_pixel(32, 32).0[3], 255);
}

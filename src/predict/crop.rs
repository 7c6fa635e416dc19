//! A photo cut down to the object: the network's view of the world.
//!
//! The window is a square of fixed metric size around the object's centre, at the centre's distance
//! and facing the camera. Camera, resolution and distance thus drop out, while the object's size stays visible:
//! it is part of how many views an object needs. Training inputs (`prv inputs`) are cut by the same code.

use image::{Rgba, RgbaImage};
use nalgebra::{Rotation3, Vector2, Vector3};

use super::pixels::Premultiplied;
use crate::geometry::{Point, Vector};
use crate::imaging::{Camera, Distortion};

/// Half the side of the window, metres. A sphere of 0.12 m, the largest object trained on, fits with its
/// silhouette at 0.3 m (0.131 m in the window's plane).
pub const CROP_HALF_SIZE_M: f64 = 0.135;

/// The largest reduction left to the sampling itself; beyond it the photo is halved first.
const SAMPLES_PER_SIDE: usize = 2;

/// Cuts the window around `center_in_camera` out of `image` and resamples it to `size` x `size` pixels.
///
/// Each pixel is the mean over its own area, so that fine texture becomes grey instead of noise. Distortion is
/// removed. What lies outside the photo is transparent. Straight alpha in, straight alpha out; the image's
/// "up" stays up.
///
/// `camera` must have passed [`Camera::check`] and be of the image's size; `center_in_camera` must lie in front of
/// the camera (z > 0, metres). The result is all transparent otherwise.
pub fn crop(image: &RgbaImage, camera: &Camera, center_in_camera: &Point, size: u32) -> RgbaImage {
    let mut result = RgbaImage::new(size, size);
    let distance_m = center_in_camera.coords.norm();
    if size == 0 || !(distance_m.is_finite() && center_in_camera.z > 0.0) {
        return result;
    }
    let window = Window::new(camera, center_in_camera, distance_m);
    let corners = window.corners(size);
    let Some((low, high)) = bounds(&corners) else { return result };
    let reduction = camera.fx.max(camera.fy) * 2.0 * window.tan_half / f64::from(size);
    let halvings = (reduction / SAMPLES_PER_SIDE as f64).log2().ceil().clamp(0.0, 16.0) as u32;
    let pixels = Premultiplied::from_region(image, low, high, halvings);
    let stride = size as usize + 1;
    for (x, y, pixel) in result.enumerate_pixels_mut() {
        let index = y as usize * stride + x as usize;
        let at = |i: usize| corners.get(i).copied().flatten();
        if let (Some(a), Some(b), Some(c), Some(d)) =
            (at(index), at(index + 1), at(index + stride), at(index + stride + 1))
        {
            *pixel = mean_over(&pixels, a, b, c, d);
        }
    }
    result
}

/// The mean of a quadrilateral of the photo with corners `a b / c d`, by a grid of bilinear samples.
fn mean_over(
    pixels: &Premultiplied,
    a: Vector2<f64>,
    b: Vector2<f64>,
    c: Vector2<f64>,
    d: Vector2<f64>,
) -> Rgba<u8> {
    let mut sum = [0.0_f32; 4];
    for j in 0..SAMPLES_PER_SIDE {
        let v = (j as f64 + 0.5) / SAMPLES_PER_SIDE as f64;
        let (left, right) = (a.lerp(&c, v), b.lerp(&d, v));
        for i in 0..SAMPLES_PER_SIDE {
            let u = (i as f64 + 0.5) / SAMPLES_PER_SIDE as f64;
            let sample = pixels.sample(left.lerp(&right, u));
            for (total, channel) in sum.iter_mut().zip(sample) {
                *total += channel;
            }
        }
    }
    let alpha = sum[3] / (SAMPLES_PER_SIDE * SAMPLES_PER_SIDE) as f32;
    if alpha < 0.5 {
        return Rgba([0; 4]);
    }
    // `as` saturates, so rounding cannot leave the byte.
    let straight = |channel: f32| (channel / sum[3] * 255.0).round() as u8;
    Rgba([straight(sum[0]), straight(sum[1]), straight(sum[2]), alpha.round() as u8])
}

/// The metric window, seen by `camera`.
struct Window<'a> {
    camera: &'a Camera,
    camera_from_window: Rotation3<f64>,
    tan_half: f64,
    /// Square of the normalised radius beyond which the distortion polynomial folds back.
    fold_radius2: f64,
}

impl Window<'_> {
    fn new<'a>(camera: &'a Camera, center_in_camera: &Point, distance_m: f64) -> Window<'a> {
        Window {
            camera,
            // The smallest turn keeps the image's "up".
            camera_from_window: Rotation3::rotation_between(&Vector::z(), &center_in_camera.coords)
                .unwrap_or_else(Rotation3::identity),
            tan_half: CROP_HALF_SIZE_M / distance_m,
            fold_radius2: fold_radius(&camera.distortion).powi(2),
        }
    }

    /// The photo's pixel coordinates of the corners of a `size` x `size` grid, row by row.
    fn corners(&self, size: u32) -> Vec<Option<Vector2<f64>>> {
        let step = 2.0 * self.tan_half / f64::from(size);
        let line = || (0..=size).map(|i| f64::from(i) * step - self.tan_half);
        line().flat_map(|y| line().map(move |x| self.pixel(x, y))).collect()
    }

    fn pixel(&self, x: f64, y: f64) -> Option<Vector2<f64>> {
        let ray = self.camera_from_window * Vector3::new(x, y, 1.0);
        let folded = ray.xy().norm_squared() > self.fold_radius2 * ray.z * ray.z;
        let seen = if folded { None } else { self.camera.project(&Point::from(ray)) };
        seen.filter(|pixel| pixel.x.is_finite() && pixel.y.is_finite())
    }
}

/// The radius of normalised image coordinates up to which radial distortion grows; at most 10.
fn fold_radius(distortion: &Distortion) -> f64 {
    if distortion.is_none() {
        return f64::INFINITY;
    }
    let grows = |r2: f64| {
        1.0 + r2 * (3.0 * distortion.k1 + r2 * (5.0 * distortion.k2 + r2 * 7.0 * distortion.k3)) > 0.0
    };
    (1..=1000).map(|i| f64::from(i) * 0.01).take_while(|r| grows(r * r)).last().unwrap_or(0.0)
}

/// The smallest box around the corners that are seen.
fn bounds(corners: &[Option<Vector2<f64>>]) -> Option<(Vector2<f64>, Vector2<f64>)> {
    corners.iter().flatten().fold(None, |bounds, corner| {
        let (low, high) = bounds.unwrap_or((*corner, *corner));
        Some((low.inf(corner), high.sup(corner)))
    })
}

//! A small ray-traced scene: a checkered sphere on a striped box, lit from one side.

use image::{Rgba, RgbaImage};
use nalgebra::Vector2;

use crate::geometry::{Point, Pose, Vector, direction_from_azimuth_elevation, look_at};
use crate::imaging::{Camera, PosedImage};
use crate::nerf::Bounds;

pub const BOUNDS: Bounds = Bounds { center: Point::new(0.3, -0.2, 0.1), half_extent_m: 0.13 };

/// Poses on a hemisphere of 0.4 m around the scene, in a golden spiral.
pub fn pose(index: usize, count: usize, turn: f64) -> Pose {
    let elevation = (0.05 + 0.93 * (index as f64 + 0.5) / count as f64).asin();
    let azimuth = index as f64 * 2.399_963 + turn;
    let eye = BOUNDS.center + direction_from_azimuth_elevation(azimuth, elevation).into_inner() * 0.4;
    look_at(&eye, &BOUNDS.center, 0.0)
}

pub fn views(camera: &Camera, count: usize, turn: f64) -> Vec<PosedImage> {
    (0..count)
        .map(|i| {
            let world_from_camera = pose(i, count, turn);
            PosedImage { image: photograph(camera, &world_from_camera), camera: *camera, world_from_camera }
        })
        .collect()
}

/// Four rays a pixel, straight alpha.
pub fn photograph(camera: &Camera, world_from_camera: &Pose) -> RgbaImage {
    RgbaImage::from_fn(camera.width, camera.height, |x, y| {
        let mut sum = [0.0; 4];
        for (dx, dy) in [(0.25, 0.25), (0.75, 0.25), (0.25, 0.75), (0.75, 0.75)] {
            let ray = camera.ray_in_camera(Vector2::new(f64::from(x) + dx, f64::from(y) + dy));
            let direction = (world_from_camera.rotation * ray).normalize();
            let origin = Point::from(world_from_camera.translation.vector);
            if let Some(colour) = colour_along(&origin, &direction) {
                for c in 0..3 {
                    sum[c] += colour[c] / 4.0;
                }
                sum[3] += 0.25;
            }
        }
        let alpha: f64 = sum[3];
        let byte = |c: f64| (c / alpha.max(1e-9) * 255.0).round() as u8;
        Rgba([byte(sum[0]), byte(sum[1]), byte(sum[2]), (alpha * 255.0).round() as u8])
    })
}

fn colour_along(origin: &Point, direction: &Vector) -> Option<[f64; 3]> {
    let (mut nearest, mut colour) = (f64::INFINITY, None);
    let center = BOUNDS.center + Vector::new(0.0, 0.0, 0.03);
    let to = origin - center;
    let b = to.dot(direction);
    let root = b * b - to.norm_squared() + 0.06 * 0.06;
    if root > 0.0 {
        nearest = -b - root.sqrt();
        let normal = (to + direction * nearest) / 0.06;
        let checker = ((normal.z * 4.0).floor() + (normal.y.atan2(normal.x) * 2.5).floor()) as i64;
        let base = if checker.rem_euclid(2) == 0 { [0.9, 0.3, 0.2] } else { [0.15, 0.25, 0.7] };
        colour = Some(shade(base, &normal));
    }
    let half = Vector::new(0.09, 0.06, 0.03);
    let from = origin - (BOUNDS.center + Vector::new(0.0, 0.0, -0.05));
    let (mut enter, mut leave, mut face) = (f64::NEG_INFINITY, f64::INFINITY, 0);
    for a in 0..3 {
        let (t0, t1) = ((-half[a] - from[a]) / direction[a], (half[a] - from[a]) / direction[a]);
        if t0.min(t1) > enter {
            (enter, face) = (t0.min(t1), a);
        }
        leave = leave.min(t0.max(t1));
    }
    if enter < leave && enter < nearest {
        let mut normal = Vector::zeros();
        normal[face] = -direction[face].signum();
        let p = from + direction * enter;
        let stripe = ((p.x + p.y * 0.5 + p.z) / 0.018).floor() as i64;
        let base = if stripe.rem_euclid(2) == 0 { [0.85, 0.8, 0.3] } else { [0.2, 0.55, 0.35] };
        colour = Some(shade(base, &normal));
    }
    colour
}

fn shade(base: [f64; 3], normal: &Vector) -> [f64; 3] {
    let light = Vector::new(0.4, -0.5, 0.77).normalize();
    base.map(|c| c * (0.45 + 0.55 * normal.dot(&light).max(0.0)))
}

//! Rendering and image figures, on one core.

mod common;

use image::RgbImage;

use std::hint::black_box;

use common::{median_processor_time, row};
use prv::geometry::{Point, direction_from_azimuth_elevation, look_at};
use prv::imaging::{Camera, Distortion, composite, psnr, ssim};
use prv::render::{Material, Mesh, RenderSettings, Renderer, sample_names, sample_object};

const RADIUS_M: f64 = 0.1;
const DISTANCE_M: f64 = 0.3;

/// A bumpy, textured ball of about that many triangles.
fn ball(triangles: u32) -> Mesh {
    let n = (f64::from(triangles) / 4.0).sqrt() as u32;
    let mut mesh = Mesh::default();
    for j in 0..=n {
        for i in 0..=2 * n {
            let (s, t) = (f64::from(i) / f64::from(2 * n), f64::from(j) / f64::from(n));
            let (azimuth, polar) = (s * std::f64::consts::TAU, t * std::f64::consts::PI);
            let r = 1.0 + 0.1 * (azimuth * 9.0).sin() * (polar * 7.0).sin();
            let p = [polar.sin() * azimuth.cos(), polar.sin() * azimuth.sin(), polar.cos()];
            mesh.positions.push(p.map(|v| (v * r) as f32));
            mesh.uvs.push([s as f32 * 3.0, t as f32 * 2.0]);
        }
    }
    for j in 0..n {
        for i in 0..2 * n {
            let a = j * (2 * n + 1) + i;
            mesh.triangles.extend([[a, a + 2 * n + 1, a + 1], [a + 1, a + 2 * n + 1, a + 2 * n + 2]]);
        }
    }
    let texture = sample_object("parcel").and_then(|m| m.materials.first().and_then(|m| m.texture.clone()));
    mesh.materials.push(Material { color: [1.0; 3], texture, ..Material::default() });
    mesh.triangle_materials = vec![0; mesh.triangles.len()];
    mesh.fitted(Point::origin(), RADIUS_M)
}

/// Milliseconds of an image, over views around the object.
fn per_image(mesh: &Mesh, camera: &Camera, samples_per_pixel: u32) -> f64 {
    let renderer = Renderer::new(mesh);
    let settings = RenderSettings { samples_per_pixel, ..RenderSettings::default() };
    let (views, mut view) = (if camera.width > 500 { 5 } else { 40 }, 0);
    milliseconds(views, || {
        view = (view + 1) % views;
        let share = view as f64 / views as f64;
        let direction = direction_from_azimuth_elevation(share * 96.0, 0.1 + 1.2 * share);
        let eye = Point::origin() + direction.into_inner() * DISTANCE_M;
        black_box(renderer.render(camera, &look_at(&eye, &Point::origin(), 0.0), &settings));
    })
}

/// Median processor milliseconds of one of `repeats` calls.
fn milliseconds(repeats: usize, call: impl FnMut()) -> f64 {
    1e3 * median_processor_time(5, repeats, call)
}

fn main() {
    let d435 = Camera::REALSENSE_D435;
    let lens = Distortion { k1: 0.12, k2: -0.25, p1: 0.001, p2: -0.0007, k3: 0.08 };
    let bent = Camera { distortion: lens, ..d435 };
    let label = Camera::square(128, 0.37);
    let fine = ball(50_000);
    let coarse = ball(8_000);

    for samples in [1, 4, 8, 16] {
        let name = format!("1280x720, 50,000 triangles, {samples} samples a pixel");
        row(&name, per_image(&fine, &d435, samples), "ms", Some(100.0));
    }
    row(
        "1280x720, 50,000 triangles, 8 samples, distorting lens",
        per_image(&fine, &bent, 8),
        "ms",
        Some(100.0),
    );
    for samples in [1, 4, 8, 16] {
        let name = format!("128x128, 50,000 triangles, {samples} samples a pixel");
        row(&name, per_image(&fine, &label, samples), "ms", Some(5.0));
        let name = format!("128x128, 8,000 triangles, {samples} samples a pixel");
        row(&name, per_image(&coarse, &label, samples), "ms", Some(5.0));
    }
    for name in sample_names() {
        let Some(mesh) = sample_object(name) else { continue };
        let mesh = mesh.fitted(Point::origin(), RADIUS_M);
        let label = format!("128x128, sample {name} ({} triangles), 8 samples", mesh.triangles.len());
        row(&label, per_image(&mesh, &Camera::square(128, 0.37), 8), "ms", Some(5.0));
    }
    row("preparing 50,000 triangles", milliseconds(1, || drop(Renderer::new(&fine))), "ms", None);

    let renderer = Renderer::new(&coarse);
    let shot = |x: f64| {
        let pose = look_at(&Point::new(x, -0.3, 0.1), &Point::origin(), 0.0);
        composite(&renderer.render(&label, &pose, &RenderSettings::default()), [0, 0, 0])
    };
    let (a, b) = (shot(0.0), shot(0.01));
    let figure = |measure: fn(&RgbImage, &RgbImage) -> f64| {
        milliseconds(200, || {
            black_box(measure(&a, &b));
        })
    };
    row("psnr of 128x128", figure(psnr), "ms", None);
    row("ssim of 128x128", figure(ssim), "ms", None);
}

//! Scenarios of the whole renderer, against what geometry says a pixel must show.

use std::sync::Arc;

use image::{Rgba, RgbaImage};
use nalgebra::Vector2;
use proptest::prelude::*;

use super::{DirectionalLight, Light, Material, Mesh, RenderSettings, Renderer, sample_object};
use crate::geometry::{Point, Pose, direction_from_azimuth_elevation, look_at};
use crate::imaging::{Camera, Distortion};

/// Light that shows colours as they are.
fn flat(samples_per_pixel: u32) -> RenderSettings {
    let dark = DirectionalLight { towards_light_in_world: [0.0, 0.0, 1.0], intensity: 0.0 };
    let light = Light { sky: 1.0, ground: 1.0, key: dark, fill: dark };
    RenderSettings { samples_per_pixel, light, ..RenderSettings::default() }
}

/// A rectangle at height z, as two triangles, with the texture's top left corner at (x0, y1).
fn rectangle([x0, y0, x1, y1]: [f32; 4], z: f32, texture: RgbaImage) -> Mesh {
    let material = Material { color: [1.0; 3], texture: Some(Arc::new(texture)), ..Material::default() };
    Mesh {
        positions: vec![[x0, y0, z], [x1, y0, z], [x1, y1, z], [x0, y1, z]],
        uvs: vec![[0.0, 1.0], [1.0, 1.0], [1.0, 0.0], [0.0, 0.0]],
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        triangle_materials: vec![0, 0],
        materials: vec![material],
        ..Mesh::default()
    }
}

fn plain(color: [u8; 4]) -> RgbaImage {
    RgbaImage::from_pixel(1, 1, Rgba(color))
}

fn joined(a: &Mesh, b: &Mesh) -> Mesh {
    let mut mesh = a.clone();
    let (first, material) = (a.positions.len() as u32, a.materials.len() as u32);
    mesh.positions.extend(&b.positions);
    mesh.uvs.extend(&b.uvs);
    mesh.triangles.extend(b.triangles.iter().map(|t| t.map(|i| i + first)));
    mesh.triangle_materials.extend(b.triangle_materials.iter().map(|m| m + material));
    mesh.materials.extend(b.materials.clone());
    mesh
}

/// One metre above the origin, looking straight down.
fn from_above() -> Pose {
    look_at(&Point::new(0.0, 0.0, 1.0), &Point::origin(), 0.0)
}

/// Where the ray of a pixel meets the plane at height z, metres.
fn on_plane(camera: &Camera, pose: &Pose, pixel: Vector2<f64>, z: f64) -> Point {
    let ray = pose.rotation * camera.ray_in_camera(pixel);
    let eye = pose.translation.vector;
    Point::from(eye + ray * ((z - eye.z) / ray.z))
}

#[test]
fn a_square_seen_from_above_covers_exactly_its_pixels() {
    // 20 pixels are 0.2 m at 1 m: the square takes pixels 40 to 59.
    let camera = Camera::square(100, 0.5);
    let mesh = rectangle([-0.1, -0.1, 0.1, 0.1], 0.0, plain([200, 100, 50, 255]));
    for samples in [1, 4, 8, 16] {
        let image = Renderer::new(&mesh).render(&camera, &from_above(), &flat(samples));
        for (x, y, pixel) in image.enumerate_pixels() {
            let inside = (40..60).contains(&x) && (40..60).contains(&y);
            let expected = if inside { [200, 100, 50, 255] } else { [0; 4] };
            // The 16-sample pattern has samples on pixel borders.
            if samples < 16 || (41..59).contains(&x) == (40..60).contains(&x) {
                assert!(samples == 16 || pixel.0 == expected, "{samples}: {x},{y} {pixel:?}");
            }
        }
    }
}

#[test]
fn half_covered_pixels_are_half_clear_and_keep_their_colour() {
    let camera = Camera::square(100, 0.5);
    let mesh = rectangle([-0.105, -0.1, 0.1, 0.1], 0.0, plain([200, 100, 50, 255]));
    for samples in [4, 8] {
        let image = Renderer::new(&mesh).render(&camera, &from_above(), &flat(samples));
        let borders = [(39, 50), (60, 50), (50, 39), (50, 60)].map(|(x, y)| image.get_pixel(x, y).0);
        assert_eq!(borders.iter().filter(|b| **b == [200, 100, 50, 128]).count(), 1, "{borders:?}");
        assert_eq!(borders.iter().filter(|b| **b == [0; 4]).count(), 3, "{borders:?}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn a_surface_cut_into_many_triangles_has_no_gaps_however_it_is_seen(
        azimuth in -3.0..3.0f64, elevation in 0.3..1.5f64, roll in -3.0..3.0f64,
        cells in 1u32..40, k1 in prop_oneof![Just(0.0), -0.2..0.2f64], seed in 0u64..1000,
    ) {
        let mut mesh = rectangle([-0.1, -0.1, 0.1, 0.1], 0.0, plain([255; 4]));
        let at = |i: u32| -0.1 + 0.2 * i as f32 / cells as f32;
        let jitter = |i: u32, j: u32| ((u64::from(i * 71 + j * 37) * 2654435761 + seed) % 97) as f32 * 4e-5 / cells as f32;
        mesh.positions = (0..=cells).flat_map(|j| (0..=cells).map(move |i| (i, j))).map(|(i, j)| {
            let inner = i > 0 && j > 0 && i < cells && j < cells;
            let shift = if inner { jitter(i, j) } else { 0.0 };
            [at(i) + shift, at(j) - shift, 0.0]
        }).collect();
        mesh.uvs.clear();
        mesh.triangles = (0..cells * cells).flat_map(|c| {
            let a = c / cells * (cells + 1) + c % cells;
            [[a, a + 1, a + cells + 2], [a, a + cells + 2, a + cells + 1]]
        }).collect();
        mesh.triangle_materials = vec![0; mesh.triangles.len()];
        let mut camera = Camera::square(160, 0.4);
        camera.distortion = Distortion { k1, p1: k1 * 0.02, ..Distortion::default() };
        let eye = Point::origin() + direction_from_azimuth_elevation(azimuth, elevation).into_inner() * 0.4;
        let pose = look_at(&eye, &Point::origin(), roll);
        let image = Renderer::new(&mesh).render(&camera, &pose, &flat(4));
        for (x, y, pixel) in image.enumerate_pixels() {
            let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]].map(|[a, b]| {
                let hit = on_plane(&camera, &pose, Vector2::new(f64::from(x) + a, f64::from(y) + b), 0.0);
                [hit.x, -hit.x, hit.y, -hit.y]
            });
            if corners.iter().flatten().all(|c| *c < 0.0995) {
                prop_assert_eq!(pixel.0[3], 255, "gap at {},{}", x, y);
            } else if (0..4).any(|side| corners.iter().all(|c| c[side] > 0.1005)) {
                prop_assert_eq!(pixel.0[3], 0, "spill at {},{}", x, y);
            }
        }
    }

    #[test]
    fn a_slanted_texture_is_where_perspective_and_the_lens_put_it(
        azimuth in -3.0..3.0f64, elevation in 0.5..1.4f64, k1 in prop_oneof![Just(0.0), -0.25..0.25f64],
    ) {
        // Red grows to the right and green downwards: colours tell where on the texture a pixel looks.
        let ramp = RgbaImage::from_fn(256, 256, |x, y| Rgba([x as u8, y as u8, 0, 255]));
        let mesh = rectangle([-0.1, -0.1, 0.1, 0.1], 0.0, ramp);
        let mut camera = Camera::square(200, 0.3);
        camera.distortion = Distortion { k1, k2: 0.1 * k1, p2: 0.01 * k1, ..Distortion::default() };
        let eye = Point::origin() + direction_from_azimuth_elevation(azimuth, elevation).into_inner() * 0.4;
        let pose = look_at(&eye, &Point::origin(), 0.3);
        let image = Renderer::new(&mesh).render(&camera, &pose, &flat(1));
        let mut seen = 0;
        for (x, y, pixel) in image.enumerate_pixels() {
            let hit = on_plane(&camera, &pose, Vector2::new(f64::from(x) + 0.5, f64::from(y) + 0.5), 0.0);
            if hit.x.abs().max(hit.y.abs()) < 0.095 {
                let (u, v) = ((hit.x + 0.1) / 0.2, (0.1 - hit.y) / 0.2);
                let expected = [u * 256.0 - 0.5, v * 256.0 - 0.5];
                for (k, e) in expected.iter().enumerate() {
                    prop_assert!((f64::from(pixel.0[k]) - e).abs() < 2.5, "{:?} instead of {:?}", pixel, expected);
                }
                seen += 1;
            }
        }
        prop_assert!(seen > 1000);
    }
}

#[test]
fn the_nearer_surface_hides_the_farther_whatever_the_order() {
    let near = rectangle([-0.1, -0.1, 0.1, 0.1], 0.1, plain([255, 0, 0, 255]));
    let far = rectangle([-0.2, -0.2, 0.2, 0.2], 0.0, plain([0, 0, 255, 255]));
    for mesh in [joined(&near, &far), joined(&far, &near)] {
        let image = Renderer::new(&mesh).render(&Camera::square(64, 0.5), &from_above(), &flat(4));
        assert_eq!(image.get_pixel(32, 32).0, [255, 0, 0, 255]);
        assert_eq!(image.get_pixel(32, 21).0, [0, 0, 255, 255]);
    }
}

#[test]
fn holes_in_a_texture_show_what_is_behind() {
    let mut holed = plain([255, 0, 0, 255]);
    holed = RgbaImage::from_fn(2, 1, |x, _| if x == 0 { *holed.get_pixel(0, 0) } else { Rgba([0; 4]) });
    let front = rectangle([-0.2, -0.2, 0.2, 0.2], 0.1, holed);
    let back = rectangle([-0.3, -0.3, 0.3, 0.3], 0.0, plain([0, 0, 255, 255]));
    let camera = Camera::square(64, 0.3);
    let image = Renderer::new(&joined(&front, &back)).render(&camera, &from_above(), &flat(4));
    for (x, y, pixel) in image.enumerate_pixels() {
        let hit = on_plane(&camera, &from_above(), Vector2::new(f64::from(x) + 0.5, f64::from(y) + 0.5), 0.1);
        // At the middle and, as textures repeat, at the rim the two texels blend.
        if hit.x.abs() > 0.01 && hit.x.abs().max(hit.y.abs()) < 0.19 {
            let expected = if hit.x < 0.0 { [255, 0, 0, 255] } else { [0, 0, 255, 255] };
            assert_eq!(pixel.0, expected, "{x},{y}");
        }
    }
}

#[test]
fn both_sides_of_a_sheet_are_drawn_each_in_its_own_light() {
    let mesh = rectangle([-0.1, -0.1, 0.1, 0.1], 0.0, plain([255; 4]));
    let mut settings = flat(1);
    settings.light = Light { sky: 0.8, ground: 0.1, ..settings.light };
    let renderer = Renderer::new(&mesh);
    let brightness = |z: f64| {
        let pose = look_at(&Point::new(0.0, 0.0, z), &Point::origin(), 0.0);
        renderer.render(&Camera::square(32, 0.5), &pose, &settings).get_pixel(16, 16).0[0]
    };
    assert_eq!((brightness(1.0), brightness(-1.0)), (231, 89), "sRGB of 0.8 and 0.1");
}

#[test]
fn a_camera_inside_a_box_sees_its_walls_everywhere() {
    let corner = |i: u32| [0, 1, 2].map(|k| if i >> k & 1 == 1 { 0.5f32 } else { -0.5 });
    let quads = [[0, 1, 3, 2], [4, 5, 7, 6], [0, 1, 5, 4], [2, 3, 7, 6], [0, 2, 6, 4], [1, 3, 7, 5]];
    let mut mesh = Mesh {
        positions: (0..8).map(corner).collect(),
        triangles: quads.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).collect(),
        ..Mesh::default()
    };
    mesh.repair();
    for distortion in [Distortion::default(), Distortion { k1: -0.2, k2: 0.05, ..Distortion::default() }] {
        let camera = Camera { distortion, ..Camera::square(96, 0.9) };
        let pose = look_at(&Point::new(0.1, 0.2, -0.1), &Point::new(-0.3, 0.1, 0.4), 0.7);
        let image = Renderer::new(&mesh).render(&camera, &pose, &flat(4));
        assert!(image.pixels().all(|p| p.0[3] == 255));
    }
}

#[test]
fn the_same_arguments_give_the_same_bytes_on_any_thread_and_after_other_images() {
    let renderer = Renderer::new(&sample_object("house").unwrap());
    let pose = |z: f64| look_at(&Point::new(0.3, -0.2, z), &Point::new(0.0, 0.0, 0.06), 0.0);
    let shot =
        |z: f64| renderer.render(&Camera::square(96, 0.35), &pose(z), &RenderSettings::default()).into_raw();
    let first = shot(0.2);
    let others: Vec<_> = std::thread::scope(|scope| {
        let threads: Vec<_> =
            (0..3).map(|i| scope.spawn(move || (shot(0.1 * f64::from(i)), shot(0.2)).1)).collect();
        threads.into_iter().map(|t| t.join().unwrap()).collect()
    });
    assert!(others.iter().all(|o| *o == first));
}

#[test]
fn numbers_that_are_none_give_an_empty_image_and_no_panic() {
    let renderer = Renderer::new(&sample_object("parcel").unwrap());
    let nan = f64::NAN;
    let pose = Pose::translation(nan, 0.0, 0.0);
    let camera = Camera { fx: nan, ..Camera::square(16, 0.5) };
    for (camera, pose) in [(Camera::square(16, 0.5), pose), (camera, from_above())] {
        assert!(renderer.render(&camera, &pose, &flat(4)).pixels().all(|p| p.0[3] == 0));
    }
    let nothing = Renderer::new(&Mesh::default()).render(&Camera::square(16, 0.5), &from_above(), &flat(4));
    assert_eq!(nothing.dimensions(), (16, 16));
}

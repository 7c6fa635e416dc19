//! `prv nerf` on a folder that the crate's own writer made.

use std::process::Command;

use prv::geometry::{Point, direction_from_azimuth_elevation, look_at};
use prv::imaging::transforms::{SceneCube, write_image_set};
use prv::imaging::{Camera, PosedImage};
use prv::render::{RenderSettings, Renderer, sample_object};

#[test]
fn a_written_folder_trains_and_its_held_out_frames_are_measured_and_rendered() {
    let dir = tempfile::tempdir().unwrap();
    let cube = SceneCube { center: Point::new(0.4, 0.1, 0.05), half_extent_m: 0.1 };
    let renderer = Renderer::new(&sample_object("parcel").unwrap().fitted(cube.center, 0.1));
    let camera = Camera::square(64, 0.36);
    let images: Vec<PosedImage> = (0..24)
        .map(|i| {
            let toward = direction_from_azimuth_elevation(f64::from(i) * 2.4, 0.2 + 0.04 * f64::from(i));
            let world_from_camera = look_at(&(cube.center + toward.into_inner() * 0.3), &cube.center, 0.0);
            let image = renderer.render(&camera, &world_from_camera, &RenderSettings::default());
            PosedImage { image, camera, world_from_camera }
        })
        .collect();
    write_image_set(dir.path(), &images, &cube).unwrap();

    let out = dir.path().join("renders");
    let run = Command::new(env!("CARGO_BIN_EXE_prv"))
        .arg("nerf")
        .arg(dir.path())
        .args(["--steps", "250", "--samples", "2048", "--json", "--out"])
        .arg(&out)
        .output()
        .unwrap();
    assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
    let answer: serde_json::Value = serde_json::from_slice(&run.stdout).unwrap();
    assert_eq!(answer["train_frames"], 21);
    assert_eq!(answer["test_frames"].as_array().unwrap().len(), 3);
    assert!(answer["psnr_db"].as_f64().unwrap() > 24.0, "{answer}");
    assert!(answer["ssim"].as_f64().unwrap() > 0.8, "{answer}");
    let render = image::open(out.join("0002.png")).unwrap();
    assert_eq!((render.width(), render.height()), (64, 64));
}

#[test]
fn a_folder_without_transforms_fails_and_says_what_is_missing() {
    let dir = tempfile::tempdir().unwrap();
    let run = Command::new(env!("CARGO_BIN_EXE_prv")).arg("nerf").arg(dir.path()).output().unwrap();
    assert_eq!(run.status.code(), Some(1));
    assert!(String::from_utf8_lossy(&run.stderr).contains("transforms.json"));
}

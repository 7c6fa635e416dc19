use std::fs;

use image::{Rgba, RgbaImage};
use proptest::prelude::*;
use tempfile::tempdir;

use super::axes::{matrix_of, pose_of};
use super::*;
use crate::geometry::{Vector, direction_from_azimuth_elevation, look_at};
use crate::imaging::{Camera, PosedImage};

const CUBE: SceneCube = SceneCube { center: Point::new(0.4, -0.1, 0.07), half_extent_m: 0.11 };

fn posed(azimuth: f64, camera: Camera) -> PosedImage {
    let eye = CUBE.center + direction_from_azimuth_elevation(azimuth, 0.5).into_inner() * 0.3;
    let world_from_camera = look_at(&eye, &CUBE.center, 0.2);
    let image = RgbaImage::from_fn(camera.width, camera.height, |x, y| {
        Rgba([x as u8, y as u8, (azimuth * 30.0) as u8, if x > 3 { 255 } else { 0 }])
    });
    PosedImage { image, camera, world_from_camera }
}

proptest! {
    #[test]
    fn a_pose_survives_the_change_of_axes(az in -3.0..3.0f64, el in -1.5..1.5f64, roll in -3.0..3.0f64) {
        let eye = CUBE.center + direction_from_azimuth_elevation(az, el).into_inner() * 0.3;
        let pose = look_at(&eye, &CUBE.center, roll);
        let back = pose_of(&matrix_of(&pose)).unwrap();
        prop_assert!((back.translation.vector - pose.translation.vector).norm() < 1e-12);
        prop_assert!(back.rotation.angle_to(&pose.rotation) < 1e-7);
    }
}

#[test]
fn the_matrix_has_opengl_axes() {
    let pose = look_at(&Point::new(0.0, -2.0, 0.0), &Point::origin(), 0.0);
    let m = matrix_of(&pose);
    let column = |c: usize| Vector::new(m[0][c], m[1][c], m[2][c]);
    assert!((column(0) - Vector::x()).norm() < 1e-12, "x points right");
    assert!((column(1) - Vector::z()).norm() < 1e-12, "y points up");
    assert!((column(2) + Vector::y()).norm() < 1e-12, "z points backward, away from the object");
    assert!((column(3) - Vector::new(0.0, -2.0, 0.0)).norm() < 1e-12);
}

#[test]
fn a_folder_that_was_written_reads_back_with_every_eighth_frame_held_out() {
    let dir = tempdir().unwrap();
    let mut camera = Camera::square(16, 0.4);
    camera.distortion.k1 = 0.05;
    camera.distortion.p2 = -0.001;
    let images: Vec<PosedImage> = (0..17).map(|i| posed(f64::from(i) * 0.3, camera)).collect();
    write_image_set(dir.path(), &images, &CUBE).unwrap();
    let set = read_transforms(dir.path(), DEFAULT_TEST_EVERY).unwrap();
    assert_eq!((set.train.len(), set.test.len()), (14, 3));
    assert!((set.cube.center - CUBE.center).norm() < 1e-12);
    assert!((set.cube.half_extent_m - CUBE.half_extent_m).abs() < 1e-12);
    for (read, index) in set.test.iter().zip([0, 8, 16]) {
        let written = &images[index];
        assert_eq!(read.image, written.image);
        assert_eq!(read.camera, written.camera);
        assert!(read.world_from_camera.rotation.angle_to(&written.world_from_camera.rotation) < 1e-7);
    }
}

#[test]
fn the_cube_is_instant_ngps_unit_cube() {
    let dir = tempdir().unwrap();
    write_image_set(dir.path(), &[posed(0.0, Camera::square(8, 0.4))], &CUBE).unwrap();
    let text = fs::read_to_string(dir.path().join("transforms.json")).unwrap();
    let json: serde_json::Value = serde_json::from_str(&text).unwrap();
    let scale = json["scale"].as_f64().unwrap();
    for axis in 0..3 {
        let offset = json["offset"][axis].as_f64().unwrap();
        let low = (CUBE.center[axis] - CUBE.half_extent_m) * scale + offset;
        let high = (CUBE.center[axis] + CUBE.half_extent_m) * scale + offset;
        assert!(low.abs() < 1e-12 && (high - 1.0).abs() < 1e-12, "axis {axis}: {low} to {high}");
    }
    assert_eq!(json["camera_model"], "OPENCV");
    assert_eq!(json["aabb_scale"], 1.0);
    assert_eq!(json["frames"][0]["file_path"], "images/0000.png");
}

#[test]
fn cameras_that_differ_are_written_with_their_frames() {
    let dir = tempdir().unwrap();
    let images = [posed(0.0, Camera::square(8, 0.4)), posed(1.0, Camera::square(12, 0.3))];
    write_image_set(dir.path(), &images, &CUBE).unwrap();
    let set = read_transforms(&dir.path().join("transforms.json"), 0).unwrap();
    assert_eq!(set.train.iter().map(|v| v.camera).collect::<Vec<_>>(), images.map(|v| v.camera));
}

const IDENTITY: &str = "[[1,0,0,0],[0,1,0,0],[0,0,1,4],[0,0,0,1]]";

#[test]
fn a_synthetic_nerf_folder_is_read_with_its_own_test_frames() {
    let dir = tempdir().unwrap();
    for split in ["train", "test"] {
        fs::create_dir(dir.path().join(split)).unwrap();
        posed(0.0, Camera::square(20, 0.5)).image.save(dir.path().join(split).join("r_0.png")).unwrap();
        let text = format!(
            r#"{{"camera_angle_x": 0.6911112070083618, "frames":
                [{{"file_path": "./{split}/r_0", "rotation": 0.0125, "transform_matrix": {IDENTITY}}}]}}"#
        );
        fs::write(dir.path().join(format!("transforms_{split}.json")), text).unwrap();
    }
    let set = read_transforms(dir.path(), DEFAULT_TEST_EVERY).unwrap();
    assert_eq!((set.train.len(), set.test.len()), (1, 1));
    let camera = set.train[0].camera;
    assert!((camera.fx - 10.0 / (0.6911112070083618f64 / 2.0).tan()).abs() < 1e-9);
    assert_eq!((camera.fy, camera.cx, camera.cy), (camera.fx, 10.0, 10.0));
    let seen = set.train[0].world_from_camera.inverse_transform_point(&Point::origin());
    assert!((seen - Point::new(0.0, 0.0, 4.0)).norm() < 1e-9, "the origin lies before the camera");
    assert!((set.cube.half_extent_m - 0.5 / 0.33).abs() < 1e-9);
}

#[test]
fn errors_name_the_file_and_the_field() {
    let dir = tempdir().unwrap();
    posed(0.0, Camera::square(20, 0.5)).image.save(dir.path().join("a.png")).unwrap();
    let missing = read_transforms(dir.path(), 8).unwrap_err().to_string();
    assert!(missing.contains("transforms_train.json"), "{missing}");
    let frame = |extra: &str, matrix: &str| {
        format!(
            r#"{{"fl_x": 30, {extra} "frames": [{{"file_path": "a.png", "transform_matrix": {matrix}}}]}}"#
        )
    };
    let cases = [
        (frame("", "[[1,0,0,0],[0,1,0,0],[0,0,2,4],[0,0,0,1]]"), "frames[0].transform_matrix"),
        (frame("", "[[1,0,0,0],[0,1,0,0],[0,0,-1,4],[0,0,0,1]]"), "determinant"),
        (frame("", "[[1,0,0,0]]"), "1 rows"),
        (frame("", "[]"), "0 rows"),
        (frame(r#""w": 40,"#, IDENTITY), "frames[0].w is 40, the image has 20"),
        (frame(r#""k1": 1e9,"#, IDENTITY), "k1"),
        (frame(r#""camera_model": "OPENCV_FISHEYE","#, IDENTITY), "OPENCV_FISHEYE"),
        (frame(r#""scale": 0,"#, IDENTITY), "scale is 0"),
        (frame("", IDENTITY).replace("a.png", "b"), "frames[0].file_path is b"),
        (frame("", IDENTITY).replace("fl_x", "other"), "frames[0].fl_x is missing"),
        (r#"{"frames": []}"#.to_owned(), "frames is empty"),
    ];
    for (text, expected) in cases {
        fs::write(dir.path().join("transforms.json"), &text).unwrap();
        let error = read_transforms(dir.path(), 8).unwrap_err().to_string();
        assert!(error.contains(expected) && error.contains("transforms.json"), "{text}: {error}");
    }
    fs::write(dir.path().join("transforms.json"), "{\"frames\": 3}").unwrap();
    assert!(matches!(read_transforms(dir.path(), 8), Err(TransformsError::Json { .. })));
}

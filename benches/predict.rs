//! The prediction: cutting three photos and running the network on them.

mod common;

use common::{median_time, row};
use image::{Rgba, RgbaImage};
use prv::geometry::Point;
use prv::imaging::Camera;
use prv::predict::{PhotoInput, Predictor, crop, model_bytes};

fn main() {
    let camera = Camera::REALSENSE_D435;
    let image = RgbaImage::from_fn(camera.width, camera.height, |x, y| {
        Rgba([x as u8, y as u8, (x ^ y) as u8, if (x / 64 + y / 64) % 3 == 0 { 0 } else { 255 }])
    });
    let center = Point::new(0.0, 0.0, 0.3);
    let cut = median_time(9, 1, || {
        std::hint::black_box(crop(&image, &camera, &center, 224));
    });
    row("cut one 1280x720 photo to 224x224", cut * 1e3, "ms", None);

    let path = std::env::var_os("PRV_MODEL").map(std::path::PathBuf::from);
    let bytes = match model_bytes(path.as_deref()) {
        Ok(bytes) => bytes,
        Err(error) => return println!("network not measured: {error}"),
    };
    let photos = vec![PhotoInput::looking_at_center(image, camera, 0.3); 3];
    for threads in [1, 2] {
        let predictor = match Predictor::load(&bytes, threads, 1) {
            Ok(predictor) => predictor,
            Err(error) => return println!("network not measured: {error}"),
        };
        let side = predictor.info().input_size;
        let crops: Vec<_> =
            photos.iter().map(|p| crop(&p.image, &p.camera, &p.center_in_camera, side)).collect();
        let run = median_time(9, 1, || {
            let _ = std::hint::black_box(predictor.predict_crops(&crops));
        });
        let name = format!("{}, three crops of {side}x{side}, threads {threads}", predictor.info().encoder);
        row(&name, run * 1e3, "ms", (threads == 2).then_some(40.0));
        let all = median_time(9, 1, || {
            let _ = std::hint::black_box(predictor.predict(&photos));
        });
        row("  with cutting the photos", all * 1e3, "ms", None);
    }
}

//! `prv capture`: photos without a service.

use std::process::Command;

use serde_json::Value;

use crate::harness::PRV;

fn capture(arguments: &[&str]) -> (Value, Value, tempfile::TempDir) {
    let out = tempfile::tempdir().unwrap();
    let output = Command::new(PRV)
        .args(["capture", "--object", "sample:plant", "--size", "160x90", "--json", "--out"])
        .arg(out.path())
        .args(arguments)
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let transforms = std::fs::read(out.path().join("transforms.json")).unwrap();
    let printed = serde_json::from_slice(&output.stdout).unwrap();
    (printed, serde_json::from_slice(&transforms).unwrap(), out)
}

#[test]
fn a_free_camera_takes_the_initial_photos() {
    let (printed, transforms, out) = capture(&["--views", "initial"]);
    assert_eq!(printed["images"].as_array().unwrap().len(), 3);
    assert_eq!((transforms["w"].as_f64(), transforms["h"].as_f64()), (Some(160.0), Some(90.0)));
    for frame in transforms["frames"].as_array().unwrap() {
        let image = image::open(out.path().join(frame["file_path"].as_str().unwrap())).unwrap().into_rgba8();
        assert_eq!(image.dimensions(), (160, 90));
        assert!(image.pixels().any(|pixel| pixel.0[3] == 255));
    }
}

#[test]
fn an_arm_takes_what_it_can_reach() {
    let cell = ["--robot", "ur5e", "--center", "0.45,0,0.3", "--views", "6", "--white"];
    let (printed, transforms, out) = capture(&cell);
    let (taken, left_out) = (printed["images"].as_array().unwrap(), printed["skipped"].as_array().unwrap());
    assert_eq!(taken.len() + left_out.len(), 6);
    assert_eq!(transforms["frames"].as_array().unwrap().len(), taken.len());
    let image = image::open(out.path().join(taken[0].as_str().unwrap())).unwrap();
    assert_eq!(image.into_rgba8().get_pixel(0, 0).0, [255; 4]);
}

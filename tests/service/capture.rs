//! `prv capture`: photos without a service.

use std::process::Command;

use serde_json::{Value, json};

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

/// The plan of `prv plan` for a request like the capture's.
fn planned(more: Value) -> Value {
    let mut request = json!({"view_count": 6, "robot": {"model": "ur5e"},
        "object": {"center": [0.45, 0.0, 0.1], "radius": 0.1}});
    for (name, value) in more.as_object().unwrap() {
        request[name] = value.clone();
    }
    let file = tempfile::NamedTempFile::new().unwrap();
    std::fs::write(file.path(), request.to_string()).unwrap();
    let output = Command::new(PRV).arg("plan").arg(file.path()).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).unwrap()
}

#[test]
fn a_capture_takes_the_views_of_a_plan_with_the_same_words() {
    for (flags, request) in [
        (&[][..], json!({})),
        (&["--roll", "free", "--unreachable", "skip"], json!({"roll": "free", "unreachable_views": "skip"})),
        (&["--roll", "sampled", "--roll-samples", "3"], json!({"roll": "sampled", "roll_samples": 3})),
    ] {
        let cell = ["--robot", "UR5e", "--center", "0.45,0,0.1", "--views", "6"];
        let (printed, transforms, _out) = capture(&[&cell, flags].concat());
        let plan = planned(request);
        assert_eq!(printed["robot"], "ur5e");
        assert_eq!(printed["coverage"], plan["coverage"]);
        assert!(printed["warnings"].as_array().unwrap().iter().any(|w| w["code"] == "default_hand_eye"));
        let order: Vec<String> = plan["order"]
            .as_array()
            .unwrap()
            .iter()
            .map(|id| format!("images/{:03}.png", id.as_u64().unwrap()))
            .collect();
        assert_eq!(printed["images"], json!(order), "{flags:?}");
        let frames = transforms["frames"].as_array().unwrap();
        let files: Vec<&Value> = frames.iter().map(|frame| &frame["file_path"]).collect();
        assert_eq!(json!(files), json!(order));
        // The first camera's centre, and with it all that was chosen before.
        let first = plan["order"][0].as_u64().unwrap() as usize;
        let centre = plan["views"][first]["pose"]["position"].as_array().unwrap();
        for (axis, value) in centre.iter().enumerate() {
            let taken = frames[0]["transform_matrix"][axis][3].as_f64().unwrap();
            assert!((taken - value.as_f64().unwrap()).abs() < 1e-6, "{flags:?}");
        }
    }
}

#[test]
fn words_about_the_arm_need_one() {
    for flags in [
        &["--roll", "free"][..],
        &["--unreachable", "skip"],
        &["--robot", "ur5e", "--roll", "sampled"],
        &["--robot", "ur5e", "--roll-samples", "4"],
        &["--robot", "ur5e", "--roll", "sampled", "--roll-samples", "65"],
    ] {
        let out = tempfile::tempdir().unwrap();
        let output = Command::new(PRV)
            .args(["capture", "--object", "sample:mug", "--out"])
            .arg(out.path())
            .args(flags)
            .output()
            .unwrap();
        assert!(!output.status.success(), "{flags:?}");
    }
}

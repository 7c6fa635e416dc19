//! What makes a plan or a number useless without being an error in the request is said in `warnings`.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde_json::{Value, json};

use super::harness::{PRV, Server, cell, problem, with};

fn codes(answer: &Value) -> Vec<&str> {
    answer["warnings"].as_array().unwrap().iter().map(|w| w["code"].as_str().unwrap()).collect()
}

fn photo(width: u32, height: u32, color: [u8; 3]) -> String {
    let image = image::RgbImage::from_pixel(width, height, image::Rgb(color));
    let mut bytes = std::io::Cursor::new(Vec::new());
    image.write_to(&mut bytes, image::ImageFormat::Png).unwrap();
    STANDARD.encode(bytes.get_ref())
}

#[tokio::test]
async fn a_capped_lens_and_a_bare_wall_are_said_to_show_no_object() {
    let data = tempfile::tempdir().unwrap();
    let server = Server::start(data.path());
    for color in [[0; 3], [200, 100, 50]] {
        let request = json!({"images": [photo(320, 180, color)], "camera": cell()["camera"],
            "object": cell()["object"]});
        let answer = server.post_json("/v1/predictions", &request).await;
        assert!(codes(&answer).contains(&"blank_image"), "{color:?}: {}", answer["warnings"]);
    }
}

#[tokio::test]
async fn photos_that_do_not_fit_the_assumed_camera_are_told_to_name_their_own() {
    let data = tempfile::tempdir().unwrap();
    let server = Server::start(data.path());
    let request = json!({"images": [photo(320, 180, [9; 3])], "object": cell()["object"]});
    let refused = problem(server.post("/v1/predictions", &request).await).await;
    assert_eq!((&refused["code"], &refused["field"]), (&json!("image_size"), &json!("images[0]")));
    assert!(refused["detail"].as_str().unwrap().contains("D435"), "{refused}");
}

#[tokio::test]
async fn a_lens_that_cannot_see_the_object_is_named_before_anything_moves() {
    let data = tempfile::tempdir().unwrap();
    let server = Server::start(data.path());
    let usual = server.post_json("/v1/plans", &with(cell(), json!({"views": "initial"}))).await;
    assert!(!codes(&usual).contains(&"object_cut_off"), "{}", usual["warnings"]);
    let mut long = with(cell(), json!({"views": "initial"}));
    long["camera"]["fx"] = json!(2289.0);
    long["camera"]["fy"] = json!(2283.0);
    let plan = server.post_json("/v1/plans", &long).await;
    assert!(codes(&plan).contains(&"object_cut_off"), "{}", plan["warnings"]);
}

#[tokio::test]
async fn a_band_of_the_pole_alone_has_one_view_and_says_so() {
    let data = tempfile::tempdir().unwrap();
    let server = Server::start(data.path());
    let band = json!({"radius": 0.3, "min_elevation_deg": 90, "max_elevation_deg": 90});
    let request =
        json!({"object": cell()["object"], "camera": cell()["camera"], "view_count": 5, "view_space": band});
    let plan = server.post_json("/v1/plans", &request).await;
    assert_eq!(plan["views"].as_array().unwrap().len(), 1);
    assert_eq!(plan["view_count"]["used"], 1);
    assert!(codes(&plan).contains(&"fewer_views"), "{}", plan["warnings"]);
}

#[tokio::test]
async fn a_plan_that_reaches_nothing_says_so_with_a_code_of_its_own() {
    let data = tempfile::tempdir().unwrap();
    let server = Server::start(data.path());
    let far = json!({"object": {"center": [4.0, 0.0, 0.1], "radius": 0.1}, "view_count": 5});
    let plan = server.post_json("/v1/plans", &with(cell(), far)).await;
    assert!(codes(&plan).contains(&"nothing_reachable"), "{}", plan["warnings"]);
    assert!(!codes(&plan).contains(&"views_skipped"));
}

#[tokio::test]
async fn a_second_service_on_the_same_data_is_refused_and_the_first_goes_on() {
    let data = tempfile::tempdir().unwrap();
    let server = Server::start(data.path());
    let second = std::process::Command::new(PRV)
        .args(["serve", "--listen", "127.0.0.1:0", "--data-dir"])
        .arg(data.path())
        .output()
        .unwrap();
    assert_eq!(second.status.code(), Some(1));
    let text = String::from_utf8(second.stderr).unwrap();
    assert!(text.contains("another service uses"), "{text}");
    server.get_json("/readyz").await;
    server.kill();
    // Nothing of a killed service is in the way of the next.
    Server::start(data.path()).get_json("/readyz").await;
}

#[test]
#[cfg(unix)]
fn whoever_stops_reading_ends_the_command_quietly() {
    // 2,000 lines are more than a pipe holds.
    let script = format!(
        "{PRV} views 200 --json | head -c 10; {PRV} robots | head -c 10; exec 2>&1; \
        {PRV} views 200 | true; {PRV} openapi | true"
    );
    let ended = std::process::Command::new("sh").args(["-c", &script]).output().unwrap();
    let text = String::from_utf8_lossy(&ended.stdout).into_owned() + &String::from_utf8_lossy(&ended.stderr);
    assert!(!text.contains("panicked") && !text.contains("Broken pipe"), "{text}");
}

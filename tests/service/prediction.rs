//! Predictions, with a tiny model of the right format in the trained one's place.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde_json::{Value, json};

use crate::harness::{Server, cell, problem, with};

fn photos() -> Value {
    let picture = |shade: u8| {
        let image = image::RgbaImage::from_fn(320, 180, |x, y| {
            let inside = x.abs_diff(160) + y.abs_diff(90) < 70;
            image::Rgba(if inside { [shade, (x % 256) as u8, (y % 256) as u8, 255] } else { [0; 4] })
        });
        let mut bytes = std::io::Cursor::new(Vec::new());
        image.write_to(&mut bytes, image::ImageFormat::Png).unwrap();
        STANDARD.encode(bytes.get_ref())
    };
    json!([picture(20), picture(120), picture(220)])
}

fn codes(answer: &Value) -> Vec<&str> {
    answer["warnings"].as_array().unwrap().iter().map(|w| w["code"].as_str().unwrap()).collect()
}

#[tokio::test]
async fn a_prediction_states_the_poses_it_expects_and_warns_of_others() {
    let data = tempfile::tempdir().unwrap();
    let model = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/predict/tiny.onnx");
    let server = Server::start_with(data.path(), &["--model", model]);
    let health = server.get_json("/readyz").await;
    let request = json!({"images": photos(), "camera": cell()["camera"], "object": cell()["object"]});
    let first = server.post_json("/v1/predictions", &request).await;
    assert_eq!(first["model"], health["model"]);
    assert_eq!(first["predicted"].as_f64().unwrap(), first["raw"].as_f64().unwrap().round());
    assert_eq!(codes(&first), Vec::<&str>::new());
    let expected = first["expected_image_poses"].as_array().unwrap();
    let names: Vec<&str> = expected.iter().map(|view| view["name"].as_str().unwrap()).collect();
    assert_eq!(names, ["top", "left", "front"]);

    // The order of photos does not matter.
    let mut poses: Vec<Value> = expected.iter().rev().map(|view| view["pose"].clone()).collect();
    let matching =
        server.post_json("/v1/predictions", &with(request.clone(), json!({"image_poses": poses}))).await;
    assert_eq!(codes(&matching), Vec::<&str>::new());
    // A camera raised by 6 cm and not turned: another direction, another distance, past the centre.
    poses[0]["position"][2] = json!(poses[0]["position"][2].as_f64().unwrap() + 0.06);
    let moved =
        server.post_json("/v1/predictions", &with(request.clone(), json!({"image_poses": poses}))).await;
    assert_eq!(codes(&moved), ["unexpected_image_pose", "object_cut_off"]);
    assert!(moved["warnings"][0]["message"].as_str().unwrap().contains("images[0]"));

    poses.pop();
    let refused = with(request.clone(), json!({"image_poses": poses}));
    let refused = problem(server.post("/v1/predictions", &refused).await).await;
    assert_eq!((&refused["code"], &refused["field"]), (&json!("image_pose_count"), &json!("image_poses")));

    let plan = server.post_json("/v1/plans", &request).await;
    assert_eq!(plan["view_count"]["predicted"], first["predicted"]);
    assert_eq!(plan["view_count"]["raw"], first["raw"]);
    assert_eq!(plan["view_count"]["interval"], first["interval"]);
    assert_eq!(plan["view_count"]["novelty"], first["novelty"]);
    let ends =
        [(first["raw"].as_f64().unwrap() - 6.5).ceil(), (first["raw"].as_f64().unwrap() + 9.25).floor()];
    assert_eq!(first["interval"], json!(ends.map(|end| end as u32)));
    let novelty = first["novelty"].as_f64().unwrap();
    assert!(0.0 < novelty && novelty < 1.0, "{novelty}");
    assert_eq!(plan["views"].as_array().unwrap().len() as u64, first["predicted"].as_u64().unwrap());
    assert_eq!(plan["expected_image_poses"], first["expected_image_poses"]);
}

#[tokio::test]
async fn another_model_makes_another_plan_of_the_same_request() {
    let data = tempfile::tempdir().unwrap();
    let request = json!({"view_count": 3});
    let mut ids = Vec::new();
    for model in ["tiny.onnx", "missing.onnx"] {
        let path = format!("{}/tests/data/predict/{model}", env!("CARGO_MANIFEST_DIR"));
        let server = Server::start_with(data.path(), &["--model", &path]);
        let plan = server.post_json("/v1/plans", &request).await;
        ids.push(plan["id"].as_str().unwrap().to_owned());
        if model == "missing.onnx" {
            let cause = problem(server.get("/readyz").await).await;
            assert!(cause["detail"].as_str().unwrap().contains("missing.onnx"), "{cause}");
            let refused = problem(
                server
                    .post(
                        "/v1/predictions",
                        &json!({"images": photos(),
                "camera": cell()["camera"], "object": cell()["object"]}),
                    )
                    .await,
            )
            .await;
            assert_eq!(refused["code"], "prediction_unavailable");
        }
    }
    assert_ne!(ids[0], ids[1]);
}

//! Requests that nobody should send: whatever a member holds, the answer is a plan or a problem,
//! and never a mistake of the service.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use rand::Rng;
use rand::seq::IndexedRandom;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use serde_json::{Value, json};

use crate::harness::{Server, cell, with};

/// What members are replaced with.
fn oddities() -> Vec<Value> {
    vec![
        json!(null),
        json!(true),
        json!(""),
        json!("x"),
        json!("\u{0}\u{1f916}"),
        json!(-1),
        json!(0),
        json!(-0.0),
        json!(1),
        json!(3.5),
        json!(1e6),
        json!(1e308),
        json!(-1e308),
        json!(5e-324),
        json!(4_294_967_296u64),
        json!([]),
        json!({}),
        json!([1]),
        json!([[[]]]),
        json!({"a": {"b": []}}),
        json!("y".repeat(10_000)),
        json!(vec![0; 1000]),
        json!([1e308, 1e308, 1e308]),
        json!([0.0, 0.0, 0.0, 0.0]),
        json!("<robot name='r'/>"),
    ]
}

/// JSON pointers to every member and element.
fn pointers(value: &Value, at: &str, found: &mut Vec<String>) {
    let children: Vec<(String, &Value)> = match value {
        Value::Object(members) => {
            members.iter().map(|(name, child)| (format!("{at}/{name}"), child)).collect()
        }
        Value::Array(items) => {
            items.iter().enumerate().map(|(i, child)| (format!("{at}/{i}"), child)).collect()
        }
        _ => Vec::new(),
    };
    for (pointer, child) in children {
        pointers(child, &pointer, found);
        found.push(pointer);
    }
}

#[tokio::test]
async fn whatever_a_member_holds_the_service_makes_no_mistake() {
    let data = tempfile::tempdir().unwrap();
    let server = Server::start(data.path());
    let plan = server.post_json("/v1/plans", &json!({"view_count": 2})).await;
    let mut png = std::io::Cursor::new(Vec::new());
    image::RgbaImage::new(320, 180).write_to(&mut png, image::ImageFormat::Png).unwrap();
    let photo = json!({"images": [STANDARD.encode(png.get_ref())], "image_poses": [
        {"position": [0.45, 0.0, 0.45], "orientation": [1.0, 0.0, 0.0, 0.0]}]});
    let row = json!({"d": 0.1, "a": 0.2, "alpha": 1.57, "theta": 0.0, "min": -3.0, "max": 3.0,
                     "max_speed": 1.0, "max_acceleration": 1.0});
    let start = json!({"start": [0.0, -1.57, 1.57, -1.57, -1.57, 0.0], "roll": "fixed", "view_count": 3,
                       "view_space": {"radius": 0.3, "min_elevation_deg": 5.0, "max_elevation_deg": 90.0}});
    let dh = json!({"view_count": 2, "robot": {"dh": vec![row; 6], "convention": "modified"}});
    let bases = [
        ("/v1/plans", with(cell(), start)),
        ("/v1/plans", with(cell(), dh)),
        ("/v1/plans", with(cell(), photo.clone())),
        ("/v1/predictions", with(photo, json!({"object": cell()["object"], "camera": cell()["camera"]}))),
        (
            "/v1/executions",
            json!({"plan_id": plan["id"], "object": {"sample": "mug"}, "speed_factor": 100000.0,
                                  "camera": cell()["camera"], "background": "white"}),
        ),
    ];
    let oddities = oddities();
    let mut random = ChaCha8Rng::seed_from_u64(11);
    for _ in 0..300 {
        let (path, base) = bases.choose(&mut random).unwrap();
        let mut request = base.clone();
        for _ in 0..random.random_range(1..=2) {
            let mut places = Vec::new();
            pointers(&request, "", &mut places);
            let place = places.choose(&mut random).unwrap();
            *request.pointer_mut(place).unwrap() = oddities.choose(&mut random).unwrap().clone();
        }
        let response = server.post(path, &request).await;
        let status = response.status().as_u16();
        let answer: Value = response.json().await.unwrap();
        assert!(status < 500 || status == 503, "{path} {request}: {answer}");
        if status == 422 {
            assert!(answer["field"].is_string() && answer["bound"].is_string(), "{path} {request}: {answer}");
        }
    }
    assert_eq!(server.get_json("/livez").await["status"], "ok");
}

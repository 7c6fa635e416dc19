//! What an integrator gets wrong, and whether the answer says so in words that need no knowledge of the
//! service's inside.
//!
//! The cases are lines of `tests/data/bad_requests.jsonl`: a path; a `body`, a raw `text`, or what is
//! put into a sound request (`cell` into its members, `object`, `region`, `dh_row` and `limit` into those of
//! the object, of a keep-out region, of a table's third row, of the elbow's limits, `execution` into a
//! run's); no body for GET. Then what must be said: status, code, field, value and a part of the bound.

use reqwest::Response;
use serde_json::{Value, json};

use crate::harness::{Server, cell, problem, with};

const CASES: &str = include_str!("../data/bad_requests.jsonl");

/// Words of parsers that no robotics user knows.
const JARGON: [&str; 12] = [
    "f64",
    "u32",
    "struct",
    "sequence",
    "invalid type",
    "invalid value",
    "invalid length",
    "variant",
    "deserialize",
    " map",
    "expected",
    "None",
];

fn request(more: Value) -> Value {
    with(with(cell(), json!({"view_count": 3})), more)
}

/// The body of a case; `None` for GET.
fn body(case: &Value, plan_id: &Value) -> Option<Value> {
    let (kind, more) = ["body", "cell", "object", "region", "dh_row", "limit", "execution"]
        .into_iter()
        .find_map(|kind| Some((kind, case.get(kind)?.clone())))?;
    Some(match kind {
        "cell" => request(more),
        "object" => request(json!({"object": with(cell()["object"].clone(), more)})),
        "region" => request(json!({"keep_out": [with(json!({"name": "post"}), more)]})),
        "limit" => request(json!({"limits": {"elbow_joint": more}})),
        "execution" => with(json!({"plan_id": plan_id, "object": {"sample": "mug"}}), more),
        "dh_row" => {
            let sound = json!({"d": 0.1, "a": 0.2, "alpha": 1.57, "min": -3.0, "max": 3.0, "max_speed": 1.0});
            let mut rows = vec![sound.clone(); 6];
            rows[2] = with(sound, more);
            request(json!({"robot": {"dh": rows}}))
        }
        _ => more,
    })
}

async fn answer(server: &Server, case: &Value, plan_id: &Value) -> Response {
    let path = case["path"].as_str().unwrap();
    match (case["text"].as_str(), body(case, plan_id)) {
        (Some(text), _) => server.post_text(path, text.to_owned()).await,
        (None, Some(body)) => server.post(path, &body).await,
        (None, None) => server.get(path).await,
    }
}

#[tokio::test]
async fn every_bad_request_is_refused_in_words_an_integrator_knows() {
    let data = tempfile::tempdir().unwrap();
    let server = Server::start(data.path());
    let plan = server.post_json("/v1/plans", &request(json!({}))).await;
    let cases: Vec<Value> = CASES.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    assert!(cases.len() >= 100);
    for case in cases {
        let refused = problem(answer(&server, &case, &plan["id"]).await).await;
        let seen = format!("{case}: {refused}");
        for member in ["status", "code", "field"] {
            assert_eq!(refused[member], case[member], "{seen}");
        }
        let (code, field) = (case["code"].as_str().unwrap(), case["field"].as_str().unwrap());
        let (detail, bound) = (refused["detail"].as_str().unwrap(), refused["bound"].as_str().unwrap());
        assert!(bound.contains(case["bound"].as_str().unwrap()), "{seen}");
        assert!(detail.len() < 700, "{seen}");
        let is_json = code != "malformed_json";
        assert!(is_json || detail.contains("line 1, column"), "{seen}");
        // What a URDF's parser says is not ours to word.
        if code == "urdf" {
            continue;
        }
        assert_eq!(refused["value"], case["value"], "{seen}");
        assert!(detail.contains(field), "{seen}");
        for word in JARGON.iter().filter(|_| is_json) {
            assert!(!detail.contains(word) && !bound.contains(word), "{word:?} in {seen}");
        }
    }
}

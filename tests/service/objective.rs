//! Plans for time beside plans for distance.

use serde_json::{Value, json};

use crate::harness::{Server, cell, problem, with};

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("a number, not {value}"))
}

#[tokio::test]
async fn a_plan_for_time_is_shorter_and_gives_the_figures_of_both() {
    let data = tempfile::tempdir().unwrap();
    let server = Server::start(data.path());
    let by_distance = server.post_json("/v1/plans", &with(cell(), json!({"view_count": 24}))).await;
    let by_time =
        server.post_json("/v1/plans", &with(cell(), json!({"view_count": 24, "objective": "time"}))).await;
    let end = |plan: &Value| {
        number(&plan["trajectory"]["points"].as_array().unwrap().last().unwrap()["time_from_start"])
    };
    let figures = &by_time["motion_time"];
    assert_eq!(figures["duration_s"], json!(end(&by_time)));
    assert!(end(&by_time) < end(&by_distance));
    assert_eq!(figures["by_distance"]["duration_s"], json!(end(&by_distance)));
    assert_eq!(figures["by_distance"]["path_length_m"], by_distance["path_length_m"]);
    assert!(number(&by_time["path_length_m"]) >= number(&by_distance["path_length_m"]));
    assert!(number(&figures["least_duration_s"]) <= end(&by_time));
    assert!(by_distance["motion_time"].get("by_distance").is_none());
    let verdict = server.post_json("/v1/checks", &json!({"plan_id": by_time["id"]})).await;
    assert_eq!(verdict["sound"], true, "{verdict}");
}

#[tokio::test]
async fn time_without_an_arm_is_refused() {
    let data = tempfile::tempdir().unwrap();
    let server = Server::start(data.path());
    let request = json!({"view_count": 12, "objective": "time"});
    let problem = problem(server.post("/v1/plans", &request).await).await;
    assert_eq!(
        (problem["code"].as_str(), problem["field"].as_str()),
        (Some("robot_missing"), Some("objective"))
    );
}

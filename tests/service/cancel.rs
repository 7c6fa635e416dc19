//! Stopping a run.

use serde_json::json;

use crate::harness::{Server, cell, problem, with};

#[tokio::test]
async fn a_cancelled_run_keeps_its_photos_and_a_queued_one_never_starts() {
    let data = tempfile::tempdir().unwrap();
    let server = Server::start_with(data.path(), &["--arms", "1"]);
    let plan = server.post_json("/v1/plans", &with(cell(), json!({"view_count": 6}))).await;
    // The first photo comes at 0.3 simulated seconds, the second a second later.
    let slow = json!({"plan_id": plan["id"], "object": {"sample": "mug"}, "speed_factor": 0.5});
    let running = server.start_execution(&slow).await;
    let queued = server.start_execution(&slow).await;

    let cancelled = server.post_json(&format!("/v1/executions/{queued}/cancel"), &json!({})).await;
    assert_eq!(cancelled["state"], "cancelled");
    while server.get_json(&format!("/v1/executions/{running}")).await["images"].as_array().unwrap().is_empty()
    {
        tokio::time::sleep(std::time::Duration::from_millis(20)).await;
    }
    server.post_json(&format!("/v1/executions/{running}/cancel"), &json!({})).await;
    let ended = server.wait_for(&running, &["cancelled", "done", "failed"]).await;
    assert_eq!(ended["state"], "cancelled");
    let taken = ended["images"].as_array().unwrap();
    assert!((1..6).contains(&taken.len()), "{ended}");
    let frames = server.get_json(&format!("/v1/executions/{running}/transforms.json")).await;
    assert_eq!(frames["frames"].as_array().unwrap().len(), taken.len());

    let again = problem(server.post(&format!("/v1/executions/{running}/cancel"), &json!({})).await).await;
    assert_eq!((again["status"].as_u64(), again["code"].as_str()), (Some(409), Some("execution_over")));
    assert_eq!(again["value"], "cancelled");
    let untouched = server.get_json(&format!("/v1/executions/{queued}")).await;
    assert_eq!((untouched["state"].as_str(), &untouched["images"]), (Some("cancelled"), &json!([])));
    let none = problem(server.get(&format!("/v1/executions/{queued}/transforms.json")).await).await;
    assert_eq!((none["status"].as_u64(), none["code"].as_str()), (Some(404), Some("no_transforms")));
}

//! What a restart leaves as it was.

use serde_json::json;

use crate::harness::{Server, cell, with};

#[tokio::test]
async fn plans_and_finished_runs_outlive_a_power_cut() {
    let data = tempfile::tempdir().unwrap();
    let server = Server::start(data.path());
    let request = with(cell(), json!({"view_count": 4}));
    let first = server.post("/v1/plans", &request).await;
    assert_eq!(first.status(), 201);
    let bytes = first.bytes().await.unwrap();
    let plan: serde_json::Value = serde_json::from_slice(&bytes).unwrap();
    let path = format!("/v1/plans/{}", plan["id"].as_str().unwrap());
    let execution = json!({"plan_id": plan["id"], "object": {"sample": "globe"}, "speed_factor": 100000.0});
    let run = server.post_json("/v1/executions", &execution).await["id"].as_str().unwrap().to_owned();
    let done = server.wait_for(&run, &["done"]).await;
    server.kill();

    let server = Server::start(data.path());
    assert_eq!(server.get(&path).await.bytes().await.unwrap(), bytes);
    let again = server.post("/v1/plans", &request).await;
    assert_eq!(again.status(), 200);
    assert_eq!(again.bytes().await.unwrap(), bytes, "timings included");
    assert_eq!(server.get_json("/v1/plans").await, json!({"plans": [plan["id"]]}));
    assert_eq!(server.get_json(&format!("/v1/executions/{run}")).await, done);
    assert_eq!(server.get(&format!("/v1/executions/{run}/images/0")).await.status(), 200);
    // A new run does not take the old one's place.
    let next = server.post_json("/v1/executions", &execution).await;
    assert_ne!(next["id"], run.as_str());
}

#[tokio::test]
async fn a_run_under_way_is_interrupted_by_the_end_of_the_service() {
    let data = tempfile::tempdir().unwrap();
    let slow = |plan: &serde_json::Value| json!({"plan_id": plan["id"], "object": {"sample": "globe"}, "speed_factor": 0.01});
    let server = Server::start(data.path());
    let plan = server.post_json("/v1/plans", &with(cell(), json!({"view_count": 4}))).await;
    let first = server.post_json("/v1/executions", &slow(&plan)).await["id"].as_str().unwrap().to_owned();
    server.wait_for(&first, &["running"]).await;
    server.kill();

    let server = Server::start_with(data.path(), &["--arms", "1"]);
    assert_eq!(server.get_json(&format!("/v1/executions/{first}")).await["state"], "interrupted");
    let second = server.post_json("/v1/executions", &slow(&plan)).await["id"].as_str().unwrap().to_owned();
    server.wait_for(&second, &["running"]).await;
    let third = server.post_json("/v1/executions", &slow(&plan)).await["id"].as_str().unwrap().to_owned();
    assert_eq!(server.terminate(), Some(0), "SIGTERM ends the service in order");

    let server = Server::start(data.path());
    for run in [first, second, third] {
        assert_eq!(server.get_json(&format!("/v1/executions/{run}")).await["state"], "interrupted", "{run}");
    }
}

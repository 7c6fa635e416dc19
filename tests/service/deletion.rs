//! Plans and runs that are no longer wanted.

use reqwest::Response;
use serde_json::{Value, json};

use crate::harness::{Server, cell, problem, with};

async fn delete(server: &Server, path: &str) -> Response {
    server.client.delete(format!("{}{path}", server.url)).send().await.unwrap()
}

#[tokio::test]
async fn a_run_is_deleted_with_its_files_once_it_is_over_and_its_number_is_not_used_again() {
    let data = tempfile::tempdir().unwrap();
    let server = Server::start(data.path());
    let plan = server.post_json("/v1/plans", &with(cell(), json!({"view_count": 3}))).await;
    let run = server.start_run(&plan, "mug", 0.01).await;
    let path = format!("/v1/executions/{run}");
    server.wait_for(&run, &["running"]).await;
    let refused = problem(delete(&server, &path).await).await;
    assert_eq!(
        (refused["status"].as_u64(), refused["code"].as_str()),
        (Some(409), Some("execution_running"))
    );
    assert_eq!((&refused["field"], &refused["value"]), (&json!("state"), &json!("running")));

    server.post_json(&format!("{path}/cancel"), &json!({})).await;
    server.wait_for(&run, &["cancelled"]).await;
    let deleted = delete(&server, &path).await;
    assert_eq!(
        (deleted.status(), deleted.bytes().await.unwrap().len()),
        (reqwest::StatusCode::NO_CONTENT, 0)
    );
    assert!(!data.path().join("executions").join(&run).exists());
    assert_eq!(problem(server.get(&path).await).await["code"], "unknown_execution");
    assert_eq!(problem(delete(&server, &path).await).await["code"], "unknown_execution");
    assert_eq!(server.get_json("/v1/executions").await, json!({"executions": []}));
    server.kill();

    let server = Server::start(data.path());
    assert_eq!(server.get_json("/v1/executions").await, json!({"executions": []}));
    assert_ne!(server.start_run(&plan, "mug", 100_000.0).await, run);
}

#[tokio::test]
async fn a_plan_is_deleted_unless_a_run_waits_for_it_and_its_runs_keep_what_they_have() {
    let data = tempfile::tempdir().unwrap();
    let server = Server::start_with(data.path(), &["--arms", "1"]);
    let request = with(cell(), json!({"view_count": 3}));
    let plan = server.post_json("/v1/plans", &request).await;
    let path = format!("/v1/plans/{}", plan["id"].as_str().unwrap());
    let done = server.start_run(&plan, "mug", 100_000.0).await;
    server.wait_for(&done, &["done"]).await;
    let moving = server.start_run(&plan, "mug", 0.01).await;
    server.wait_for(&moving, &["running"]).await;
    let waiting = server.start_run(&plan, "mug", 1.0).await;
    let refused = problem(delete(&server, &path).await).await;
    assert_eq!((refused["status"].as_u64(), refused["code"].as_str()), (Some(409), Some("plan_in_use")));
    let bound = refused["bound"].as_str().unwrap();
    assert!(bound.contains(&waiting) && !bound.contains(&moving) && !bound.contains(&done), "{bound}");

    server.post_json(&format!("/v1/executions/{waiting}/cancel"), &json!({})).await;
    assert_eq!(delete(&server, &path).await.status(), 204);
    for gone in [path.clone(), format!("{path}/request")] {
        assert_eq!(problem(server.get(&gone).await).await["code"], "unknown_plan");
    }
    assert_eq!(problem(delete(&server, &path).await).await["code"], "unknown_plan");
    assert_eq!(problem(delete(&server, "/v1/plans/..%2f..%2fx").await).await["code"], "unknown_plan");
    assert_eq!(std::fs::read_dir(data.path().join("plans")).unwrap().count(), 0);
    assert_eq!(server.get_json(&format!("/v1/executions/{moving}")).await["state"], "running");
    server.kill();

    let server = Server::start(data.path());
    let run = format!("/v1/executions/{done}");
    assert_eq!(server.get_json(&run).await["plan_id"], plan["id"]);
    assert_eq!(server.get_json(&format!("{run}/images")).await["images"].as_array().unwrap().len(), 3);
    let frames = server.get_json(&format!("{run}/transforms.json")).await;
    assert_eq!(frames["frames"].as_array().unwrap().len(), 3);
    let again = server.post("/v1/plans", &request).await;
    assert_eq!(again.status(), 201);
    assert_eq!(again.json::<Value>().await.unwrap()["id"], plan["id"]);
}

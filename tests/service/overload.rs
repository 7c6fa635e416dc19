//! More requests than there are places.

use serde_json::json;

use crate::harness::{Server, cell, problem, with};

#[tokio::test]
async fn a_full_service_says_when_to_come_back_and_stays_alive() {
    let data = tempfile::tempdir().unwrap();
    let server = Server::start_with(data.path(), &["--workers", "1", "--queue", "0"]);
    // Bands without a table are computed: each takes the one worker for a while.
    for minimum in 1..40 {
        let slow = format!("{}/v1/view-spaces/120?min_elevation_deg={}.5", server.url, minimum);
        let slow = tokio::spawn(server.client.get(slow).send());
        while !slow.is_finished() {
            let response = server.post("/v1/plans", &json!({"view_count": 1})).await;
            if response.status() != 503 {
                continue;
            }
            let wait: u32 = response.headers()["retry-after"].to_str().unwrap().parse().unwrap();
            assert!(wait > 0);
            assert_eq!(problem(response).await["code"], "overloaded");
            assert_eq!(server.get_json("/livez").await["status"], "ok");
            assert_eq!(slow.await.unwrap().unwrap().status(), 200, "what was admitted is answered");
            return;
        }
    }
    panic!("no request met a busy worker");
}

#[tokio::test]
async fn a_cancelled_run_makes_room_for_another() {
    let data = tempfile::tempdir().unwrap();
    let server = Server::start_with(data.path(), &["--arms", "1"]);
    let plan = server.post_json("/v1/plans", &with(cell(), json!({"view_count": 6}))).await;
    let run = |speed_factor: f64| json!({"plan_id": plan["id"], "object": {"sample": "mug"}, "speed_factor": speed_factor});
    let moving = server.start_execution(&run(0.01)).await;
    let mut waiting = Vec::new();
    let refused = loop {
        let response = server.post("/v1/executions", &run(1.0)).await;
        if response.status() == 503 {
            break response;
        }
        waiting.push(response.json::<serde_json::Value>().await.unwrap()["id"].as_str().unwrap().to_owned());
        assert!(waiting.len() <= 64, "at most 64 wait");
    };
    assert!(refused.headers().contains_key("retry-after"));
    assert_eq!(problem(refused).await["code"], "overloaded");

    server.post_json(&format!("/v1/executions/{}/cancel", waiting[30]), &json!({})).await;
    assert_eq!(server.post("/v1/executions", &run(1.0)).await.status(), 202);
    assert_eq!(server.post("/v1/executions", &run(1.0)).await.status(), 503, "it has made room for one");
    server.post_json(&format!("/v1/executions/{moving}/cancel"), &json!({})).await;
}

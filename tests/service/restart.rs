//! What a restart leaves as it was.

use serde_json::{Value, json};

use crate::harness::{Server, cell, with};

#[tokio::test]
async fn plans_and_finished_runs_outlive_a_power_cut() {
    let data = tempfile::tempdir().unwrap();
    let server = Server::start(data.path());
    let request = with(cell(), json!({"view_count": 4}));
    let first = server.post("/v1/plans", &request).await;
    assert_eq!(first.status(), 201);
    let bytes = first.bytes().await.unwrap();
    let plan: Value = serde_json::from_slice(&bytes).unwrap();
    let path = format!("/v1/plans/{}", plan["id"].as_str().unwrap());
    let execution = json!({"plan_id": plan["id"], "object": {"sample": "globe"}, "speed_factor": 100000.0});
    let run = server.start_execution(&execution).await;
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

/// Starts a run of a globe; returns its id.
async fn run(server: &Server, id: &str) -> Value {
    server.get_json(&format!("/v1/executions/{id}")).await
}

const SLOW: f64 = 0.01;
const FAST: f64 = 100_000.0;

#[tokio::test]
async fn a_moving_run_is_interrupted_by_the_end_of_the_service_and_a_waiting_one_waits_on() {
    let data = tempfile::tempdir().unwrap();
    let server = Server::start_with(data.path(), &["--arms", "1", "--shutdown-timeout-s", "60"]);
    let plan = server.post_json("/v1/plans", &with(cell(), json!({"view_count": 4}))).await;
    let moving = server.start_run(&plan, "globe", SLOW).await;
    server.wait_for(&moving, &["running"]).await;
    let waiting = server.start_run(&plan, "globe", FAST).await;
    let listener = server.get(&format!("/v1/executions/{waiting}/events")).await;
    let begin = std::time::Instant::now();
    assert_eq!(server.terminate(), Some(0), "SIGTERM ends the service in order");
    assert!(begin.elapsed().as_secs() < 30, "a listener to a waiting run does not hold the service up");
    let told = listener.text().await.unwrap();
    assert!(told.contains("queued") && !told.contains("interrupted"), "{told}");

    let server = Server::start_with(data.path(), &["--arms", "1"]);
    let stopped = run(&server, &moving).await;
    assert_eq!(stopped["state"], "interrupted");
    assert!(stopped["error"].as_str().unwrap().contains("stopped while the arm moved"), "{stopped}");
    let done = server.wait_for(&waiting, &["done", "failed", "interrupted"]).await;
    assert_eq!((&done["state"], done["images"].as_array().unwrap().len()), (&json!("done"), 4));
    let files = data.path().join("executions").join(&waiting);
    assert!(!files.join("request.json").exists(), "a run that has moved needs its request no more");
}

#[tokio::test]
async fn waiting_runs_outlive_a_power_cut_in_their_order() {
    let data = tempfile::tempdir().unwrap();
    let server = Server::start_with(data.path(), &["--arms", "1"]);
    let plan = server.post_json("/v1/plans", &with(cell(), json!({"view_count": 4}))).await;
    let moving = server.start_run(&plan, "globe", SLOW).await;
    server.wait_for(&moving, &["running"]).await;
    let mut waiting = Vec::new();
    for _ in 0..3 {
        waiting.push(server.start_run(&plan, "globe", FAST).await);
    }
    let dropped = server.start_run(&plan, "globe", FAST).await;
    server.post_json(&format!("/v1/executions/{dropped}/cancel"), &json!({})).await;
    server.kill();

    let server = Server::start_with(data.path(), &["--arms", "1"]);
    let stopped = run(&server, &moving).await;
    assert_eq!(stopped["state"], "interrupted");
    assert!(stopped["error"].as_str().unwrap().contains("ended while the arm moved"), "{stopped}");
    for id in waiting.iter().rev() {
        // From the last on: when it is done, so are all before it.
        assert_eq!(server.wait_for(id, &["done", "failed", "interrupted"]).await["state"], "done");
        let states: Vec<Value> = states_of(&server, &waiting).await;
        let place = waiting.iter().position(|other| other == id).unwrap();
        assert!(states[..=place].iter().all(|state| state == "done"), "{states:?}");
    }
    assert_eq!(run(&server, &dropped).await["state"], "cancelled");
}

async fn states_of(server: &Server, ids: &[String]) -> Vec<Value> {
    let mut states = Vec::new();
    for id in ids {
        states.push(run(server, id).await["state"].clone());
    }
    states
}

#[tokio::test]
async fn a_waiting_run_whose_request_or_plan_is_gone_says_so() {
    let data = tempfile::tempdir().unwrap();
    let server = Server::start_with(data.path(), &["--arms", "1"]);
    let plan = server.post_json("/v1/plans", &with(cell(), json!({"view_count": 4}))).await;
    let other = server.post_json("/v1/plans", &with(cell(), json!({"view_count": 3}))).await;
    let moving = server.start_run(&plan, "globe", SLOW).await;
    server.wait_for(&moving, &["running"]).await;
    let (old, planless) =
        (server.start_run(&plan, "globe", FAST).await, server.start_run(&other, "globe", FAST).await);
    server.kill();
    // As an earlier version left it: no request, and no object in the record.
    let files = data.path().join("executions").join(&old);
    std::fs::remove_file(files.join("request.json")).unwrap();
    let mut record: Value =
        serde_json::from_slice(&std::fs::read(files.join("record.json")).unwrap()).unwrap();
    assert!(record.as_object_mut().unwrap().remove("object").is_some());
    std::fs::write(files.join("record.json"), record.to_string()).unwrap();
    let plan_file = format!("{}.json", other["id"].as_str().unwrap());
    std::fs::remove_file(data.path().join("plans").join(plan_file)).unwrap();

    let server = Server::start_with(data.path(), &["--arms", "1"]);
    for (id, why) in [(old, "request was not stored"), (planless, "plan_id")] {
        let ended = server.wait_for(&id, &["interrupted", "done"]).await;
        assert_eq!(ended["state"], "interrupted");
        assert!(ended["error"].as_str().unwrap().contains(why), "{ended}");
    }
}

#[tokio::test]
async fn the_photos_of_a_killed_run_come_with_their_poses() {
    let data = tempfile::tempdir().unwrap();
    let server = Server::start(data.path());
    let plan = server.post_json("/v1/plans", &with(cell(), json!({"view_count": 6}))).await;
    let id = server.start_run(&plan, "globe", 1.0).await;
    while run(&server, &id).await["images"].as_array().unwrap().len() < 2 {
        tokio::time::sleep(std::time::Duration::from_millis(20)).await;
    }
    let whole = server.start_run(&plan, "globe", FAST).await;
    server.wait_for(&whole, &["done"]).await;
    let transforms = |id: &str| format!("/v1/executions/{id}/transforms.json");
    let written = server.get(&transforms(&whole)).await.bytes().await.unwrap();
    server.kill();

    std::fs::remove_file(data.path().join("executions").join(&whole).join("transforms.json")).unwrap();
    let server = Server::start(data.path());
    let made = server.get(&transforms(&whole)).await.bytes().await.unwrap();
    assert!(made == written, "the record gives the bytes of the file");
    let killed = run(&server, &id).await;
    assert_eq!(killed["state"], "interrupted");
    let taken = killed["images"].as_array().unwrap();
    assert!((2..6).contains(&taken.len()), "{killed}");
    let frames = server.get_json(&transforms(&id)).await["frames"].as_array().unwrap().clone();
    assert_eq!(frames.len(), taken.len());
    for (frame, view) in frames.iter().zip(taken) {
        assert_eq!(frame["file_path"], format!("images/{:03}.png", view.as_u64().unwrap()));
        let photo = server.get(&format!("/v1/executions/{id}/images/{view}")).await;
        assert_eq!(
            (photo.status().as_u16(), &photo.headers()["content-type"]),
            (200, &"image/png".parse().unwrap())
        );
    }
}

//! A run as server-sent events.

use serde_json::{Value, json};

use crate::harness::{Server, cell, problem, with};

/// One event: id, name, data.
type Event = (Option<u64>, String, Value);

fn parse(stream: &str) -> Vec<Event> {
    let event = |block: &str| {
        let member = |name: &str| {
            block.lines().find_map(|line| line.strip_prefix(name)).map(|value| value.trim().to_owned())
        };
        let data = serde_json::from_str(&member("data:")?).unwrap();
        Some((member("id:").map(|id| id.parse().unwrap()), member("event:")?, data))
    };
    stream.split("\n\n").filter_map(event).collect()
}

#[tokio::test]
async fn a_listener_sees_every_view_and_catches_up_after_a_break() {
    let data = tempfile::tempdir().unwrap();
    let server = Server::start(data.path());
    let plan = server.post_json("/v1/plans", &with(cell(), json!({"view_count": 4}))).await;
    let request = json!({"plan_id": plan["id"], "object": {"sample": "parcel"}, "speed_factor": 10.0});
    let run = server.start_execution(&request).await;

    // The stream ends with the run.
    let path = format!("/v1/executions/{run}/events");
    let response = server.get(&path).await;
    assert!(response.headers()["content-type"].to_str().unwrap().starts_with("text/event-stream"));
    let events = parse(&response.text().await.unwrap());
    let stored: Vec<&Event> = events.iter().filter(|(id, _, _)| id.is_some()).collect();
    let ids: Vec<u64> = stored.iter().filter_map(|(id, _, _)| *id).collect();
    assert_eq!(ids, (1..=ids.len() as u64).collect::<Vec<_>>());
    let states: Vec<&str> = stored
        .iter()
        .filter(|(_, name, _)| name == "state")
        .map(|(_, _, data)| data["state"].as_str().unwrap())
        .collect();
    assert_eq!(states, ["queued", "running", "done"]);
    let views: Vec<Value> = stored
        .iter()
        .filter(|(_, name, _)| name == "view")
        .map(|(_, _, data)| data["view"].clone())
        .collect();
    assert_eq!(Value::Array(views), plan["order"]);
    let moving = events.iter().filter(|(_, name, _)| name == "progress");
    let times: Vec<f64> = moving.map(|(_, _, data)| data["progress"]["time_s"].as_f64().unwrap()).collect();
    assert!(times.len() > 3 && times.is_sorted(), "{times:?}");

    let missed = server.client.get(format!("{}{path}", server.url)).header("Last-Event-ID", "3");
    let missed = parse(&missed.send().await.unwrap().text().await.unwrap());
    assert_eq!(missed, stored[3..].iter().map(|event| (*event).clone()).collect::<Vec<_>>());

    let nonsense = server.client.get(format!("{}{path}", server.url)).header("Last-Event-ID", "x");
    assert_eq!(problem(nonsense.send().await.unwrap()).await["field"], "Last-Event-ID");
}

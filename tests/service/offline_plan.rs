//! `prv plan` without a service.

use std::process::Command;

use serde_json::{Value, json};

use crate::harness::{PRV, Server, cell, with, without_timings};

#[tokio::test]
async fn the_command_prints_what_the_service_answers() {
    let data = tempfile::tempdir().unwrap();
    let server = Server::start(data.path());
    let request = with(cell(), json!({"view_count": 7}));
    let file = data.path().join("request.json");
    std::fs::write(&file, request.to_string()).unwrap();
    let output = Command::new(PRV).arg("plan").arg(&file).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let printed: Value = serde_json::from_slice(&output.stdout).unwrap();
    let answered = server.post_json("/v1/plans", &request).await;
    assert_eq!(without_timings(printed), without_timings(answered));
}

#[test]
fn a_refused_request_prints_its_problem_and_fails() {
    let data = tempfile::tempdir().unwrap();
    let file = data.path().join("request.json");
    std::fs::write(&file, r#"{"view_count": 500}"#).unwrap();
    let output = Command::new(PRV).arg("plan").arg(&file).output().unwrap();
    assert_eq!(output.status.code(), Some(1));
    let text = String::from_utf8(output.stderr).unwrap();
    let problem: Value = serde_json::from_str(text.trim().strip_prefix("prv: ").unwrap()).unwrap();
    assert_eq!((&problem["field"], &problem["value"]), (&json!("view_count"), &json!(500)));
}

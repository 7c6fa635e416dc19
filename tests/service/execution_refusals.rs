//! Bad input of an execution.

use serde_json::{Value, json};

use crate::harness::{Server, problem};

#[tokio::test]
async fn an_execution_that_cannot_be_is_refused_with_its_reason() {
    let data = tempfile::tempdir().unwrap();
    let objects = tempfile::tempdir().unwrap();
    std::fs::write(objects.path().join("empty.obj"), "# nothing\n").unwrap();
    std::fs::write(data.path().join("secret.obj"), "v 0 0 0\n").unwrap();
    std::os::unix::fs::symlink(data.path().join("secret.obj"), objects.path().join("link.obj")).unwrap();
    let flags = ["--objects-dir", objects.path().to_str().unwrap()];
    let server = Server::start_with(data.path(), &flags);
    let plan = server.post_json("/v1/plans", &json!({"view_count": 3})).await;
    let id = plan["id"].clone();
    let mug = json!({"sample": "mug"});

    let run = |plan_id: Value, object: Value, speed: f64| json!({"plan_id": plan_id, "object": object, "speed_factor": speed});
    let cases = [
        (run(json!("0000"), mug.clone(), 1.0), 404, "unknown_plan", "plan_id"),
        (run(json!("../../etc/passwd"), mug.clone(), 1.0), 404, "unknown_plan", "plan_id"),
        (run(id.clone(), mug.clone(), 0.0), 422, "out_of_range", "speed_factor"),
        (run(id.clone(), mug.clone(), -1.0), 422, "out_of_range", "speed_factor"),
        (run(id.clone(), json!({"sample": "cow"}), 1.0), 422, "unknown_object", "object.sample"),
        (run(id.clone(), json!({"made": "made:cow/1"}), 1.0), 422, "unknown_object", "object.made"),
        (run(id.clone(), json!({"made": "made:mug/0..3"}), 1.0), 422, "unknown_object", "object.made"),
        (run(id.clone(), json!({"made": "/etc/passwd"}), 1.0), 422, "unknown_object", "object.made"),
        (
            run(id.clone(), json!({"made": "/etc/passwd~texture=1"}), 1.0),
            422,
            "unknown_object",
            "object.made",
        ),
        (run(id.clone(), json!({}), 1.0), 422, "object_source", "object"),
        (run(id.clone(), json!({"sample": "mug", "glb": ""}), 1.0), 422, "object_source", "object"),
        (run(id.clone(), json!({"file": "../secret.obj"}), 1.0), 422, "object_file", "object.file"),
        (run(id.clone(), json!({"file": "/etc/passwd"}), 1.0), 422, "object_file", "object.file"),
        (run(id.clone(), json!({"file": "link.obj"}), 1.0), 404, "object_file", "object.file"),
        (run(id.clone(), json!({"file": "missing.obj"}), 1.0), 404, "object_file", "object.file"),
        (run(id.clone(), json!({"file": "empty.obj"}), 1.0), 422, "not_a_mesh", "object.file"),
        (run(id.clone(), json!({"glb": "AAAA"}), 1.0), 422, "not_a_mesh", "object.glb"),
        (run(id.clone(), json!({"glb": "Z2xURgAA"}), 1.0), 422, "not_a_mesh", "object.glb"),
    ];
    for (body, status, code, field) in cases {
        let refused = problem(server.post("/v1/executions", &body).await).await;
        assert_eq!(refused["status"], status, "{body}: {refused}");
        assert_eq!(refused["code"], code, "{body}: {refused}");
        assert_eq!(refused["field"], field, "{body}: {refused}");
        let text = refused.to_string();
        assert!(!text.contains(data.path().to_str().unwrap()), "the server's paths are its own: {text}");
    }
    assert_eq!(server.get_json("/v1/executions").await, json!({"executions": []}));
    let camera =
        json!({"width": 16000, "height": 16000, "fx": 9000.0, "fy": 9000.0, "cx": 8000.0, "cy": 8000.0});
    let body = json!({"plan_id": id, "object": mug, "camera": camera});
    let refused = problem(server.post("/v1/executions", &body).await).await;
    assert_eq!((&refused["code"], &refused["field"]), (&json!("too_many_pixels"), &json!("camera")));
    for path in [
        "/v1/executions/run-000009",
        "/v1/executions/run-000009/events",
        "/v1/executions/..%2f..%2fx/images/0",
    ] {
        assert_eq!(problem(server.get(path).await).await["code"], "unknown_execution", "{path}");
    }
}

//! The same request gives the same plan.

use serde_json::{Value, json};

use crate::harness::{Server, cell, problem, with, without_timings};

#[tokio::test]
async fn the_same_request_gives_the_same_bytes_here_and_elsewhere() {
    let (here, elsewhere) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    let server = Server::start(here.path());
    let request = with(cell(), json!({"view_count": 12}));
    // Two at a time: both are answered with what was stored first.
    let (a, b) = tokio::join!(server.post("/v1/plans", &request), server.post("/v1/plans", &request));
    let (a, b) = (a.bytes().await.unwrap(), b.bytes().await.unwrap());
    assert_eq!(a, b);
    // Spaces, the order of members and defaults that are spelt out make no other request.
    let spelt_out = format!(
        r#"{{ "roll": "fixed", "view_space": {{"radius": 0.3, "max_elevation_deg": 90}},
             "robot": {}, "object": {}, "camera": {}, "flange_from_camera": {}, "view_count": 12 }}"#,
        request["robot"], request["object"], request["camera"], request["flange_from_camera"]
    );
    let c = server.post_text("/v1/plans", spelt_out).await;
    assert_eq!(c.status(), 200);
    assert_eq!(c.bytes().await.unwrap(), a);

    let other = Server::start_with(elsewhere.path(), &["--workers", "1"]);
    let d = other.post("/v1/plans", &request).await.bytes().await.unwrap();
    let parse = |bytes: &[u8]| without_timings(serde_json::from_slice::<Value>(bytes).unwrap());
    assert_eq!(parse(&a).to_string(), parse(&d).to_string());
    let different = server.post_json("/v1/plans", &with(request, json!({"view_count": 13}))).await;
    assert_ne!(different["id"], parse(&a)["id"]);
}

#[tokio::test]
async fn requests_that_mean_the_same_have_one_id() {
    let data = tempfile::tempdir().unwrap();
    let server = Server::start(data.path());
    let robot = json!({"robot": {"model": "ur5e"}, "view_count": 2, "camera": cell()["camera"],
        "object": {"center": [0.45, 0.0, 0.3], "radius": 0.1}});
    let plan = server.post_json("/v1/plans", &robot).await;
    for more in [
        json!({"limits": {}}),
        json!({"limits": {"elbow_joint": {}}}),
        json!({"timing": {}}),
        json!({"timing": {"speed_scale": 1, "settle": 3e-1, "sample_period": 0.040, "jerk_limited": false}}),
        json!({"margin": 0.01, "keep_out": [], "tool": [], "objective": "distance", "unreachable_views": "replace"}),
        json!({"robot": {"model": "UR5e"}, "roll": "fixed", "start": null, "camera_body": null}),
        json!({"view_count": 2.0, "object": {"center": [0.45, -0.0, 3.0e-1], "radius": 0.10, "shape": "sphere"}}),
        json!({"view_space": {"radius": 0.3, "min_elevation_deg": 5, "max_elevation_deg": 90.0}}),
    ] {
        let again = server.post("/v1/plans", &with(robot.clone(), more.clone())).await;
        assert_eq!(again.status(), 200, "{more}");
        let again: Value = again.json().await.unwrap();
        assert_eq!(again, plan, "{more}");
    }
    // Limits that are the robot's own; another's are another request.
    let ur5e = server.get_json("/v1/robots/ur5e").await;
    let joints = ur5e["joint_names"].as_array().unwrap().iter().zip(ur5e["limits"].as_array().unwrap());
    let own: serde_json::Map<String, Value> = joints
        .map(|(name, limits)| {
            let known = ["min", "max", "max_speed", "max_acceleration"];
            let members = known.iter().map(|member| ((*member).to_owned(), limits[*member].clone()));
            (name.as_str().unwrap().to_owned(), Value::Object(members.collect()))
        })
        .collect();
    assert_eq!(own.len(), 6);
    assert!(own["elbow_joint"]["max_speed"].is_number(), "{own:?}");
    let same = server.post_json("/v1/plans", &with(robot.clone(), json!({"limits": own}))).await;
    assert_eq!(same, plan);
    let slower = json!({"limits": {"elbow_joint": {"max_speed": 1.0}}});
    assert_ne!(server.post_json("/v1/plans", &with(robot.clone(), slower)).await["id"], plan["id"]);
    // The two quaternions of one turn, and two words for one freedom.
    let (mount, turned) = ([0.0, 0.0, 0.6, 0.8], [-0.0, 0.0, -0.6, -0.8]);
    let mounted = |orientation: [f64; 4], roll: Value| {
        with(
            with(robot.clone(), roll),
            json!({"flange_from_camera": {"position": [0, 0, 0.05], "orientation": orientation}}),
        )
    };
    let sampled = server.post_json("/v1/plans", &mounted(mount, json!({"roll": "free"}))).await;
    let roll = json!({"roll": "sampled", "roll_samples": 12});
    assert_eq!(server.post_json("/v1/plans", &mounted(turned, roll)).await, sampled);
    assert_ne!(sampled["id"], plan["id"]);
    // A stored request is the request of its plan.
    let turned = [0.1, -0.2, 0.3, 0.9273618495495703];
    let third = server.post_json("/v1/plans", &mounted(turned, json!({}))).await;
    let stored = server.get_json(&format!("/v1/plans/{}/request", third["id"].as_str().unwrap())).await;
    assert_eq!(server.post_json("/v1/plans", &stored).await, third);
    for other in [
        json!({"limits": {"elbow_joint": {"max": 2.0}}}),
        json!({"timing": {"settle": 0.5}}),
        json!({"margin": 0.02}),
        json!({"unreachable_views": "skip"}),
        json!({"flange_from_camera": {"position": [0, 0, 0.05], "orientation": [0, 0, 0, 1]}}),
    ] {
        let different = server.post_json("/v1/plans", &with(robot.clone(), other.clone())).await;
        assert_ne!(different["id"], plan["id"], "{other}");
    }
}

#[tokio::test]
async fn words_about_an_arm_are_refused_without_one_unless_they_say_nothing() {
    let data = tempfile::tempdir().unwrap();
    let server = Server::start(data.path());
    let bare = server.post_json("/v1/plans", &json!({"view_count": 3})).await;
    let nothing = json!({"view_count": 3, "roll": "fixed", "limits": {}, "timing": {"settle": 0.3}, "margin": 0.01,
        "keep_out": [], "tool": [], "objective": "distance", "unreachable_views": "replace"});
    assert_eq!(server.post_json("/v1/plans", &nothing).await, bare);
    for (field, value) in [
        ("limits", json!({"elbow_joint": {"max": 1.0}})),
        ("flange_from_camera", json!({"position": [0, 0, 0.05], "orientation": [0, 0, 0, 1]})),
        ("start", json!([0.5, 0.5])),
        ("roll", json!("free")),
        ("objective", json!("time")),
        ("keep_out", json!([{"name": "post", "sphere": {"center": [1.5, 0.5, 0.5], "radius": 0.5}}])),
        ("camera_body", json!([])),
        ("tool", json!([{"sphere": {"center": [0.5, 0.5, 0.5], "radius": 0.5}}])),
        ("margin", json!(0.02)),
        ("timing", json!({"settle": 0.5, "speed_scale": 0.5, "sample_period": 0.04, "jerk_limited": false})),
        ("unreachable_views", json!("skip")),
    ] {
        let refused =
            problem(server.post("/v1/plans", &with(json!({"view_count": 3}), json!({field: value}))).await)
                .await;
        assert_eq!(
            (&refused["code"], &refused["field"]),
            (&json!("robot_missing"), &json!(field)),
            "{refused}"
        );
    }
}

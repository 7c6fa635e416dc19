//! What can be read without planning.

use serde_json::json;

use crate::harness::{Server, problem};

#[tokio::test]
async fn view_sets_robots_and_objects_can_be_read() {
    let data = tempfile::tempdir().unwrap();
    let server = Server::start(data.path());

    let set = server.get_json("/v1/view-spaces/5?min_elevation_deg=10&radius=0.5").await;
    let views = set["views"].as_array().unwrap();
    assert_eq!((views.len(), &views[0]["direction"]), (5, &json!([0.0, 0.0, 1.0])));
    for view in views {
        assert!(view["elevation_deg"].as_f64().unwrap() > 10.0 - 1e-6);
        let distance: f64 =
            view["pose"]["position"].as_array().unwrap().iter().map(|x| x.as_f64().unwrap().powi(2)).sum();
        assert!((distance.sqrt() - 0.5).abs() < 1e-9);
    }
    for (query, field) in [
        ("0", "n"),
        ("201", "n"),
        ("5?min_elevation_deg=-100", "min_elevation_deg"),
        ("5?radius=-1", "radius"),
        ("5?radius=abc", "radius"),
        ("5?colour=red", "colour"),
    ] {
        let refused = problem(server.get(&format!("/v1/view-spaces/{query}")).await).await;
        assert_eq!((&refused["status"], &refused["field"]), (&json!(422), &json!(field)), "{refused}");
    }

    let robots = server.get_json("/v1/robots").await;
    let names: Vec<&str> = robots.as_array().unwrap().iter().map(|r| r["model"].as_str().unwrap()).collect();
    for model in ["ur3e", "ur5", "ur5e", "ur10e", "ur16e"] {
        assert!(names.contains(&model), "{names:?}");
    }
    let ur5e = server.get_json("/v1/robots/ur5e").await;
    assert_eq!(ur5e["joint_names"][2], "elbow_joint");
    assert!((ur5e["limits"][2]["max"].as_f64().unwrap() - std::f64::consts::PI).abs() < 1e-9);
    let unknown = problem(server.get("/v1/robots/hal9000").await).await;
    assert_eq!((&unknown["status"], &unknown["value"]), (&json!(404), &json!("hal9000")));
    assert!(unknown["bound"].as_str().unwrap().contains("ur16e"));

    let objects = server.get_json("/v1/objects").await;
    assert!(objects.as_array().unwrap().contains(&json!({"sample": "mug"})));
    assert_eq!(problem(server.get("/v1/plans/0123").await).await["code"], "unknown_plan");
    let ready = server.get("/readyz").await;
    if ready.status() == 503 {
        assert!(problem(ready).await["detail"].as_str().unwrap().contains("predictions"));
    } else {
        assert_eq!(ready.status(), 200);
    }
}

//! What stands around the arm changes its plan.

use serde_json::{Value, json};

use crate::harness::{Server, cell, problem, with};

fn planned(plan: &Value) -> usize {
    plan["order"].as_array().unwrap().len()
}

fn codes(plan: &Value) -> Vec<&str> {
    let reasons = plan["views"].as_array().unwrap().iter().filter_map(|view| view["reason"]["code"].as_str());
    reasons.collect()
}

#[tokio::test]
async fn a_slim_object_lets_a_long_tool_by_where_its_sphere_does_not() {
    let data = tempfile::tempdir().unwrap();
    let server = Server::start(data.path());
    // A flash that stands 0.19 m before the camera: inside the sphere of 0.1 m at a distance of
    // 0.28 m, but 0.05 m from the axis of a slim object.
    let mut request = with(
        cell(),
        json!({
            "view_count": 12, "roll": "free", "unreachable_views": "skip",
            "view_space": {"radius": 0.28, "min_elevation_deg": 40.0, "max_elevation_deg": 90.0},
            "tool": [{"capsule": {"from": [0.0, 0.06, 0.1], "to": [0.0, 0.06, 0.24], "radius": 0.005}}],
        }),
    );
    let round = server.post_json("/v1/plans", &request).await;
    request["object"]["shape"] = json!({"cylinder": {"radius": 0.02, "height": 0.05}});
    let slim = server.post_json("/v1/plans", &request).await;
    assert!(codes(&round).contains(&"object_collision"), "{:?}", codes(&round));
    assert!(planned(&slim) > planned(&round), "{} and {}", planned(&slim), planned(&round));
    // Distances and the camera's path go by the sphere.
    let poses = |plan: &Value| -> Vec<Value> {
        plan["views"].as_array().unwrap().iter().map(|v| v["pose"]["position"].clone()).collect()
    };
    assert_eq!(poses(&slim), poses(&round));
}

#[tokio::test]
async fn a_box_as_large_as_a_cylinder_is_in_the_way_as_it_is() {
    let data = tempfile::tempdir().unwrap();
    let server = Server::start(data.path());
    let mut request = with(cell(), json!({"view_count": 10}));
    request["object"]["shape"] = json!({"box": {"size": [0.1, 0.12, 0.1], "yaw": 0.3}});
    let plan = server.post_json("/v1/plans", &request).await;
    assert!(planned(&plan) >= 5, "{:?}", codes(&plan));
}

#[tokio::test]
async fn a_region_that_holds_the_base_answers_with_reasons() {
    let data = tempfile::tempdir().unwrap();
    let server = Server::start(data.path());
    let region = json!([{"name": "everywhere", "sphere": {"center": [0.0, 0.0, 0.2], "radius": 3.0}}]);
    let plan =
        server.post_json("/v1/plans", &with(cell(), json!({"view_count": 4, "keep_out": region}))).await;
    assert_eq!(planned(&plan), 0);
    let blamed = plan["views"].as_array().unwrap().iter().map(|view| &view["reason"]);
    let blamed: Vec<&Value> = blamed.filter(|reason| reason["code"] != "no_ik").collect();
    assert!(!blamed.is_empty());
    for reason in blamed {
        assert_eq!(reason["code"], "obstacle_collision", "{reason}");
        assert!(reason["parts"].as_array().unwrap().contains(&json!("everywhere")), "{reason}");
    }
    // A pedestal that only the base touches is none of the motion's business.
    let pedestal =
        json!([{"name": "pedestal", "box": {"center": [0.0, 0.0, -0.2], "size": [0.3, 0.3, 0.5]}}]);
    let plan =
        server.post_json("/v1/plans", &with(cell(), json!({"view_count": 4, "keep_out": pedestal}))).await;
    assert!(planned(&plan) > 0, "{:?}", codes(&plan));
    let warned = plan["warnings"].as_array().unwrap().iter().any(|w| w["code"] == "base_in_keep_out");
    assert!(warned, "{}", plan["warnings"]);
}

#[tokio::test]
async fn half_the_speed_and_a_longer_rest_take_as_long_as_they_should() {
    let data = tempfile::tempdir().unwrap();
    let server = Server::start(data.path());
    let request = |timing: Value| with(cell(), json!({"view_count": 6, "timing": timing}));
    let duration = |plan: &Value| {
        let points = plan["trajectory"]["points"].as_array().unwrap();
        points.last().unwrap()["time_from_start"].as_f64().unwrap()
    };
    let fast = server.post_json("/v1/plans", &request(json!({"settle": 0.0}))).await;
    let slow = server.post_json("/v1/plans", &request(json!({"settle": 0.0, "speed_scale": 0.5}))).await;
    let resting = server.post_json("/v1/plans", &request(json!({"settle": 2.0}))).await;
    assert!((duration(&slow) - 2.0 * duration(&fast)).abs() < 0.02 * duration(&slow));
    assert!((duration(&resting) - duration(&fast) - 2.0 * planned(&fast) as f64).abs() < 0.1);
}

#[tokio::test]
async fn a_motion_of_bounded_jerk_is_longer_and_keeps_its_bounds() {
    let data = tempfile::tempdir().unwrap();
    let server = Server::start(data.path());
    let request = |jerk_limited: bool| {
        let timing = json!({"settle": 0.0, "sample_period": 0.01, "jerk_limited": jerk_limited});
        with(cell(), json!({"view_count": 6, "timing": timing}))
    };
    let plan = server.post_json("/v1/plans", &request(true)).await;
    let verdict = server.post_json("/v1/checks", &json!({"plan_id": plan["id"]})).await;
    assert_eq!(verdict["sound"], true, "{verdict}");
    let jerk_share = verdict["checked"]["largest_jerk_share"].as_f64().unwrap();
    assert!(jerk_share > 0.9 && jerk_share < 1.0 + 1e-5, "{jerk_share}");
    assert!(plan["warnings"].as_array().unwrap().iter().any(|w| w["code"] == "assumed_jerk"));
    let without = server.post_json("/v1/plans", &request(false)).await;
    let seconds = |plan: &Value| {
        plan["trajectory"]["points"].as_array().unwrap().last().unwrap()["time_from_start"].as_f64()
    };
    assert!(seconds(&plan) > seconds(&without));
}

#[tokio::test]
async fn a_region_over_the_object_is_told_and_regions_of_one_name_are_told_apart() {
    let data = tempfile::tempdir().unwrap();
    let server = Server::start(data.path());
    let warned = |plan: &Value, text: &str| {
        let warnings = plan["warnings"].as_array().unwrap();
        let told = |w: &&Value| w["code"] == "object_in_keep_out";
        warnings.iter().filter(told).any(|w| w["message"].as_str().unwrap().contains(text))
    };
    let ball =
        |x: f64, name: &str| json!({"name": name, "sphere": {"center": [x, 0.0, 0.15], "radius": 0.28}});
    let request = |regions: Value| {
        with(cell(), json!({"view_count": 4, "keep_out": regions, "unreachable_views": "skip"}))
    };
    let plan = server.post_json("/v1/plans", &request(json!([ball(0.45, "hood")]))).await;
    assert!(warned(&plan, "hood holds 100 % of the object, its centre included"), "{}", plan["warnings"]);
    let plan = server.post_json("/v1/plans", &request(json!([ball(2.0, "wall")]))).await;
    assert!(!warned(&plan, "wall"), "{}", plan["warnings"]);

    let walls = json!([ball(0.45, "case"), ball(0.4, "case"), ball(2.0, "wall")]);
    let plan = server.post_json("/v1/plans", &request(walls)).await;
    let views = plan["views"].as_array().unwrap();
    let parts = views.iter().filter_map(|view| view["reason"]["parts"].as_array()).flatten();
    let named: Vec<&str> = parts.filter_map(Value::as_str).filter(|part| part.contains("case")).collect();
    assert!(!named.is_empty() && named.iter().all(|name| name.starts_with("case (keep_out[")), "{named:?}");
}

#[tokio::test]
async fn a_trajectory_of_too_many_points_is_refused_with_the_period_that_does() {
    let data = tempfile::tempdir().unwrap();
    let server = Server::start(data.path());
    let timed = |period: f64| {
        let timing = json!({"speed_scale": 0.01, "sample_period": period});
        with(cell(), json!({"view_count": 6, "timing": timing}))
    };
    let refused = problem(server.post("/v1/plans", &timed(0.001)).await).await;
    assert_eq!(refused["code"], "trajectory_too_long", "{refused}");
    assert_eq!((&refused["field"], &refused["value"]), (&json!("timing.sample_period"), &json!(0.001)));
    let bound = refused["bound"].as_str().unwrap();
    let least: f64 = bound.strip_prefix("at least ").unwrap().split(' ').next().unwrap().parse().unwrap();
    let plan = server.post("/v1/plans", &timed(least)).await;
    assert_eq!(plan.status(), 201, "{bound}");
    let bytes = plan.bytes().await.unwrap();
    assert!(bytes.len() < 30 << 20, "{}", bytes.len());
    let plan: Value = serde_json::from_slice(&bytes).unwrap();
    let points = plan["trajectory"]["points"].as_array().unwrap().len();
    assert!((40_000..=50_000).contains(&points), "{points}");
}

//! Views that cannot be reached are replaced by others that can.

use serde_json::{Value, json};

use crate::harness::{Server, cell, problem, with, without_timings};

fn planned(plan: &Value) -> Vec<&Value> {
    plan["views"].as_array().unwrap().iter().filter(|view| view["status"] == "planned").collect()
}

/// Unit vectors from the object to the cameras.
fn directions(views: &[&Value], center: [f64; 3]) -> Vec<[f64; 3]> {
    let of = |view: &&Value| -> [f64; 3] {
        let offset: [f64; 3] =
            std::array::from_fn(|k| view["pose"]["position"][k].as_f64().unwrap() - center[k]);
        let length = offset.iter().map(|v| v * v).sum::<f64>().sqrt();
        offset.map(|v| v / length)
    };
    views.iter().map(of).collect()
}

fn angle_deg(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>().clamp(-1.0, 1.0).acos().to_degrees()
}

/// Separation and largest hole of the band from `lowest_deg` up, by brute force.
fn figures(directions: &[[f64; 3]], lowest_deg: f64) -> (f64, f64) {
    let mut separation = 180.0f64;
    for (i, a) in directions.iter().enumerate() {
        directions[..i].iter().for_each(|b| separation = separation.min(angle_deg(a, b)));
    }
    let mut hole = 0.0f64;
    for row in 0..=170 {
        let elevation = (lowest_deg + (90.0 - lowest_deg) * f64::from(row) / 170.0).to_radians();
        for column in 0..360 {
            let azimuth = f64::from(column).to_radians();
            let probe = [elevation.cos() * azimuth.cos(), elevation.cos() * azimuth.sin(), elevation.sin()];
            let nearest = directions.iter().map(|d| angle_deg(d, &probe)).fold(f64::INFINITY, f64::min);
            hole = hole.max(nearest);
        }
    }
    (separation, hole)
}

fn low_cell() -> Value {
    with(
        cell(),
        json!({"object": {"center": [0.45, 0.0, 0.1], "radius": 0.1, "table_z": 0.0}, "view_count": 35}),
    )
}

#[tokio::test]
async fn as_many_views_as_asked_for_are_planned_and_smaller_holes_left() {
    let data = tempfile::tempdir().unwrap();
    let server = Server::start(data.path());
    let skipping = with(low_cell(), json!({"unreachable_views": "skip"}));
    let thinned = server.post_json("/v1/plans", &skipping).await;
    let left = planned(&thinned).len();
    assert!(left < 35, "every view can be reached: nothing to adapt");
    assert_eq!(thinned["coverage"]["before"], thinned["coverage"]["after"]);
    assert_eq!(thinned["coverage"]["after"]["views"], left);

    let plan = server.post_json("/v1/plans", &low_cell()).await;
    assert_eq!((planned(&plan).len(), plan["order"].as_array().unwrap().len()), (35, 35));
    let coverage = &plan["coverage"];
    assert_eq!(coverage["before"], thinned["coverage"]["before"]);
    let of = |when: &str, what: &str| coverage[when][what].as_f64().unwrap();
    assert!(of("after", "largest_hole_deg") < of("before", "largest_hole_deg") - 5.0, "{coverage}");
    // 35 views on 85 % of the band: nearly as far apart as 35 on the whole of it.
    assert!(of("after", "separation_deg") > 0.9 * of("before", "separation_deg"), "{coverage}");
    let fraction = coverage["reachable_fraction"].as_f64().unwrap();
    assert!(fraction > 0.5 && fraction < 1.0, "{fraction}");
    let (separation, hole) = figures(&directions(&planned(&plan), [0.45, 0.0, 0.1]), 5.0);
    assert!((separation - of("after", "separation_deg")).abs() < 1e-4, "{separation} {coverage}");
    assert!((hole - of("after", "largest_hole_deg")).abs() < 1.0, "{hole} {coverage}");
    let warning =
        plan["warnings"].as_array().unwrap().iter().find(|w| w["code"] == "views_replaced").unwrap();
    let text = warning["message"].as_str().unwrap();
    assert!(text.contains(&format!("{} of 35", 35 - left)) && text.contains("no_ik"), "{text}");

    let elsewhere = tempfile::tempdir().unwrap();
    let again = Server::start(elsewhere.path());
    assert_eq!(without_timings(again.post_json("/v1/plans", &low_cell()).await), without_timings(plan));
}

#[tokio::test]
async fn a_region_that_hides_a_side_gets_no_camera() {
    let data = tempfile::tempdir().unwrap();
    let server = Server::start(data.path());
    let wall = json!([{"name": "wall", "box": {"center": [0.45, 0.35, 0.2], "size": [0.8, 0.3, 0.6]}}]);
    let request = with(low_cell(), json!({"view_count": 20, "roll": "free", "keep_out": wall}));
    let plan = server.post_json("/v1/plans", &request).await;
    let views = planned(&plan);
    assert_eq!(views.len(), 20, "{}", plan["warnings"]);
    for view in &views {
        assert!(view["pose"]["position"][1].as_f64().unwrap() < 0.2, "{view}");
    }
    let coverage = &plan["coverage"];
    let (separation, hole) = figures(&directions(&views, [0.45, 0.0, 0.1]), 5.0);
    assert!((separation - coverage["after"]["separation_deg"].as_f64().unwrap()).abs() < 1e-4, "{coverage}");
    assert!(
        (hole - coverage["after"]["largest_hole_deg"].as_f64().unwrap()).abs() < 1.0,
        "{hole} {coverage}"
    );
    assert!(
        coverage["after"]["largest_hole_deg"].as_f64() <= coverage["before"]["largest_hole_deg"].as_f64()
    );
}

#[tokio::test]
async fn where_fewer_poses_exist_all_are_planned_and_the_rest_tells_why_not() {
    let data = tempfile::tempdir().unwrap();
    let server = Server::start(data.path());
    let far =
        json!({"object": {"center": [1.25, 0.0, 0.2], "radius": 0.1, "table_z": 0.0}, "view_count": 200});
    let plan = server.post_json("/v1/plans", &with(cell(), far)).await;
    let count = planned(&plan).len();
    assert!(count > 0 && count < 200, "{count}");
    assert_eq!(plan["views"].as_array().unwrap().len(), 200);
    let skipped = plan["views"].as_array().unwrap().iter().filter(|view| view["status"] == "skipped");
    skipped.for_each(|view| assert!(view["reason"]["code"].is_string(), "{view}"));
    let codes: Vec<&str> =
        plan["warnings"].as_array().unwrap().iter().filter_map(|w| w["code"].as_str()).collect();
    assert!(codes.contains(&"views_replaced") && codes.contains(&"views_skipped"), "{codes:?}");
}

#[tokio::test]
async fn rolls_are_sampled_as_asked_for() {
    let data = tempfile::tempdir().unwrap();
    let server = Server::start(data.path());
    let request = |more: Value| with(with(cell(), json!({"view_count": 9})), more);
    let level = server.post_json("/v1/plans", &request(json!({}))).await;
    for view in planned(&level) {
        let [x, y, z, w]: [f64; 4] =
            std::array::from_fn(|k| view["pose"]["orientation"][k].as_f64().unwrap());
        // The camera's x axis, right in the image, is level.
        assert!((2.0 * (x * z - w * y)).abs() < 1e-9, "{view}");
    }
    for (members, code) in [
        (json!({"roll": "sampled"}), "missing_member"),
        (json!({"roll": "sampled", "roll_samples": 0}), "out_of_range"),
        (json!({"roll": "sampled", "roll_samples": 65}), "out_of_range"),
        (json!({"roll": "free", "roll_samples": 4}), "roll_not_sampled"),
        (json!({"roll_samples": 4}), "roll_not_sampled"),
    ] {
        let refused = problem(server.post("/v1/plans", &request(members.clone())).await).await;
        assert_eq!(
            (&refused["code"], &refused["field"]),
            (&json!(code), &json!("roll_samples")),
            "{members}"
        );
    }
    let one = server.post_json("/v1/plans", &request(json!({"roll": "sampled", "roll_samples": 1}))).await;
    assert_eq!(one["views"], level["views"]);
    let two = server.post_json("/v1/plans", &request(json!({"roll": "sampled", "roll_samples": 2}))).await;
    assert_eq!(planned(&two).len(), 9);
}

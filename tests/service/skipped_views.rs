//! Views that cannot be taken.

use serde_json::{Value, json};

use crate::harness::{Server, cell, problem, with};

fn skipped(plan: &Value) -> Vec<&Value> {
    plan["views"].as_array().unwrap().iter().filter(|view| view["status"] == "skipped").collect()
}

#[tokio::test]
async fn a_view_out_of_reach_is_skipped_with_its_numbers_and_the_rest_is_planned() {
    let data = tempfile::tempdir().unwrap();
    let server = Server::start(data.path());
    let mut far = with(cell(), json!({"view_count": 15, "roll": "free", "unreachable_views": "skip"}));
    far["object"]["center"] = json!([0.75, 0.0, 0.15]);
    let plan = server.post_json("/v1/plans", &far).await;
    let left_out = skipped(&plan);
    assert!(!left_out.is_empty() && left_out.len() < 15, "{} of 15", left_out.len());
    for view in &left_out {
        let reason = &view["reason"];
        assert!(reason["code"].is_string() && reason["message"].is_string(), "{view}");
        assert!(!reason["numbers"].as_object().unwrap().is_empty(), "{view}");
    }
    assert!(left_out.iter().any(|view| view["reason"]["code"] == "no_ik"));
    let order = plan["order"].as_array().unwrap();
    assert_eq!(order.len() + left_out.len(), 15);
    assert!(left_out.iter().all(|view| !order.contains(&view["id"])));
    assert!(plan["path_lower_bound_m"].as_f64() <= plan["path_length_m"].as_f64());

    far["object"]["center"] = json!([4.0, 0.0, 0.15]);
    let nothing = server.post_json("/v1/plans", &far).await;
    assert_eq!((skipped(&nothing).len(), &nothing["order"]), (15, &json!([])));
    let run = json!({"plan_id": nothing["id"], "object": {"sample": "mug"}});
    assert_eq!(problem(server.post("/v1/executions", &run).await).await["code"], "nothing_to_execute");
}

#[tokio::test]
async fn a_view_under_the_table_is_skipped_with_its_depth() {
    let data = tempfile::tempdir().unwrap();
    let server = Server::start(data.path());
    let request = json!({
        "view_count": 20,
        "object": {"center": [0.4, 0.0, 0.03], "radius": 0.1, "table_z": 0.0},
        "view_space": {"min_elevation_deg": -30.0},
    });
    let plan = server.post_json("/v1/plans", &request).await;
    let left_out = skipped(&plan);
    assert!(!left_out.is_empty() && left_out.len() < 20);
    for view in left_out {
        assert_eq!(view["reason"]["code"], "table_collision");
        let depth = view["reason"]["numbers"]["depth_m"].as_f64().unwrap();
        assert!((depth + view["pose"]["position"][2].as_f64().unwrap()).abs() < 1e-9);
    }
}

#[tokio::test]
async fn what_becomes_of_unreachable_views_is_said_to_be_unused_with_initial_ones() {
    let data = tempfile::tempdir().unwrap();
    let server = Server::start(data.path());
    let codes = |more: Value| {
        let (server, body) = (&server, with(with(cell(), json!({"views": "initial"})), more));
        async move {
            let plan = server.post_json("/v1/plans", &body).await;
            let warnings = plan["warnings"].as_array().unwrap().clone();
            warnings.iter().filter(|warning| warning["code"] == "unused_unreachable_views").count()
        }
    };
    assert_eq!(codes(json!({"unreachable_views": "skip"})).await, 1);
    assert_eq!(codes(json!({"unreachable_views": "replace"})).await, 0, "it is the default");
    assert_eq!(codes(json!({})).await, 0);
}

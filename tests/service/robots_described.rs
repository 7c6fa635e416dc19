//! Robots that the service does not know by name.

use serde_json::json;

use crate::harness::{Server, cell, with};

#[tokio::test]
async fn a_robot_given_by_its_dh_table_goes_where_the_named_one_does() {
    let data = tempfile::tempdir().unwrap();
    let server = Server::start(data.path());
    let row = |d: f64, a: f64, alpha: f64, reach: f64| json!({"d": d, "a": a, "alpha": alpha, "min": -reach, "max": reach, "max_speed": 3.0});
    let (quarter, turn, half) = (std::f64::consts::FRAC_PI_2, std::f64::consts::TAU, std::f64::consts::PI);
    let table = json!([
        row(0.1625, 0.0, quarter, turn),
        row(0.0, -0.425, 0.0, turn),
        row(0.0, -0.3922, 0.0, half),
        row(0.1333, 0.0, quarter, turn),
        row(0.0997, 0.0, -quarter, turn),
        row(0.0996, 0.0, 0.0, turn),
    ]);
    let request = with(cell(), json!({"views": "initial"}));
    let named = server.post_json("/v1/plans", &request).await;
    let described = server.post_json("/v1/plans", &with(request, json!({"robot": {"dh": table}}))).await;
    assert_ne!(named["id"], described["id"]);
    assert_eq!(described["order"], named["order"]);
    assert_eq!(described["path_length_m"], named["path_length_m"]);
    assert_eq!(described["trajectory"]["joint_names"].as_array().unwrap().len(), 6);
    let run = json!({"plan_id": described["id"], "object": {"sample": "bottle"}, "speed_factor": 100000.0});
    let run = server.post_json("/v1/executions", &run).await["id"].as_str().unwrap().to_owned();
    assert_eq!(server.wait_for(&run, &["done", "failed"]).await["state"], "done");
}

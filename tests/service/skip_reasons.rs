//! Every reason for which a view is skipped, with its numbers.

use prv::robot::RobotModel;
use serde_json::{Value, json};

use crate::harness::{Server, cell, with};

/// The reasons of one code.
fn reasons<'a>(plan: &'a Value, code: &str) -> Vec<&'a Value> {
    let reasons = plan["views"].as_array().unwrap().iter().map(|view| &view["reason"]);
    reasons.filter(|reason| reason["code"] == code).collect()
}

fn number(reason: &Value, name: &str) -> f64 {
    reason["numbers"][name].as_f64().unwrap_or_else(|| panic!("{name} in {reason}"))
}

async fn plan(server: &Server, more: Value) -> Value {
    let base = with(cell(), json!({"roll": "free", "unreachable_views": "skip"}));
    server.post_json("/v1/plans", &with(base, more)).await
}

/// A collision's parts and numbers, `second` among the parts.
fn check_contact(reason: &Value, second: &str) {
    let parts = reason["parts"].as_array().unwrap();
    assert!(parts.len() == 2 && parts[1] == second, "{reason}");
    let (depth, distance) = (number(reason, "depth_m"), number(reason, "distance_m"));
    assert!(depth > 0.0 && depth < 1.0 && distance < 0.01, "{reason}");
}

#[tokio::test]
async fn a_pose_out_of_reach_tells_its_best_residual() {
    let data = tempfile::tempdir().unwrap();
    let server = Server::start(data.path());
    let object = json!({"center": [1.3, 0.0, 0.15], "radius": 0.1, "table_z": 0.0});
    let plan = plan(&server, json!({"view_count": 8, "object": object})).await;
    let found = reasons(&plan, "no_ik");
    assert!(!found.is_empty(), "{plan}");
    for reason in found {
        let residual = number(reason, "position_residual_m");
        assert!(residual > 1e-3 && residual < 1.5, "{reason}");
        assert!(number(reason, "rotation_residual_rad").is_finite());
    }
}

#[tokio::test]
async fn a_joint_beyond_its_limit_is_named_with_the_amount() {
    let data = tempfile::tempdir().unwrap();
    let server = Server::start(data.path());
    // A UR5e whose elbow bends by 1 rad at most.
    let rows = [
        (0.1625, 0.0, std::f64::consts::FRAC_PI_2),
        (0.0, -0.425, 0.0),
        (0.0, -0.3922, 0.0),
        (0.1333, 0.0, std::f64::consts::FRAC_PI_2),
        (0.0997, 0.0, -std::f64::consts::FRAC_PI_2),
        (0.0996, 0.0, 0.0),
    ];
    let mut rows: Vec<Value> =
        rows.iter().map(|(d, a, alpha)| json!({"d": d, "a": a, "alpha": alpha})).collect();
    rows[2] = with(rows[2].clone(), json!({"name": "elbow", "min": -1.0, "max": 1.0}));
    let plan = plan(&server, json!({"view_count": 6, "robot": {"dh": rows}})).await;
    let found = reasons(&plan, "joint_limit");
    assert!(!found.is_empty(), "{}", plan["views"]);
    for reason in found {
        assert_eq!(reason["parts"], json!(["elbow"]));
        let (value, limit) = (number(reason, "value_rad"), number(reason, "limit_rad"));
        assert!(value.abs() > 1.0 && limit.abs() == 1.0, "{reason}");
        assert!((number(reason, "beyond_rad") - (value - limit).abs()).abs() < 1e-12);
    }
}

#[tokio::test]
async fn each_kind_of_collision_names_its_parts_and_depth() {
    let data = tempfile::tempdir().unwrap();
    let server = Server::start(data.path());
    // A plate across the flange that the wrist would have to fold into.
    let plate = json!([{"box": {"center": [0.0, 0.0, 0.02], "size": [0.5, 0.5, 0.01]}}]);
    let found = plan(&server, json!({"view_count": 12, "tool": plate})).await;
    let itself = reasons(&found, "self_collision");
    assert!(!itself.is_empty(), "{}", found["views"]);
    itself.iter().for_each(|reason| check_contact(reason, "tool"));

    let low = json!({"center": [0.45, 0.0, 0.02], "radius": 0.05, "table_z": 0.0});
    let space = json!({"min_elevation_deg": 0.0, "max_elevation_deg": 90.0});
    let found = plan(&server, json!({"view_count": 12, "object": low, "view_space": space})).await;
    let table = reasons(&found, "table_collision");
    assert!(!table.is_empty(), "{}", found["views"]);
    table.iter().for_each(|reason| check_contact(reason, "table"));

    let lance = json!([{"capsule": {"from": [0.0, 0.1, 0.0], "to": [0.0, 0.02, 0.3], "radius": 0.01}}]);
    let found = plan(&server, json!({"view_count": 12, "tool": lance})).await;
    let object = reasons(&found, "object_collision");
    assert!(!object.is_empty(), "{}", found["views"]);
    object.iter().for_each(|reason| check_contact(reason, "object"));

    let hood = json!([{"name": "hood", "box": {"center": [0.45, 0.0, 0.55], "size": [0.3, 0.3, 0.2]}}]);
    let found = plan(&server, json!({"view_count": 12, "keep_out": hood})).await;
    let obstacle = reasons(&found, "obstacle_collision");
    assert!(!obstacle.is_empty(), "{}", found["views"]);
    obstacle.iter().for_each(|reason| check_contact(reason, "hood"));
    assert!(!found["order"].as_array().unwrap().is_empty(), "{}", found["views"]);
}

#[tokio::test]
async fn an_arm_that_cannot_leave_its_start_has_no_path() {
    let data = tempfile::tempdir().unwrap();
    let server = Server::start(data.path());
    // A ball on a stick, in a closed case that only the stick passes.
    let start = [1.6, -1.6, 1.8, -1.8, -1.57, 0.0];
    let arm = RobotModel::named("ur5e").unwrap().kinematics;
    let ball = arm.forward(&start) * prv::geometry::Point::new(0.0, 0.0, 0.35);
    let side = |dx: f64, dy: f64, dz: f64, size: [f64; 3]| {
        let center = [ball.x + dx, ball.y + dy, ball.z + dz];
        json!({"name": "case", "box": {"center": center, "size": size}})
    };
    let keep_out = json!([
        side(0.12, 0.0, 0.0, [0.02, 0.26, 0.24]),
        side(-0.12, 0.0, 0.0, [0.02, 0.26, 0.24]),
        side(0.0, 0.12, 0.0, [0.26, 0.02, 0.24]),
        side(0.0, -0.12, 0.0, [0.26, 0.02, 0.24]),
        side(0.0, 0.0, -0.11, [0.26, 0.26, 0.02]),
        side(0.08, 0.0, 0.11, [0.1, 0.26, 0.02]),
        side(-0.08, 0.0, 0.11, [0.1, 0.26, 0.02]),
        side(0.0, 0.08, 0.11, [0.26, 0.1, 0.02]),
        side(0.0, -0.08, 0.11, [0.26, 0.1, 0.02]),
    ]);
    let tool = json!([
        {"capsule": {"from": [0.0, 0.0, 0.05], "to": [0.0, 0.0, 0.35], "radius": 0.005}},
        {"sphere": {"center": [0.0, 0.0, 0.35], "radius": 0.05}},
    ]);
    let object = json!({"center": [0.5, 0.0, 0.2], "radius": 0.05, "table_z": -0.5});
    let found = plan(
        &server,
        json!({
            "view_count": 2, "object": object, "tool": tool, "keep_out": keep_out, "start": start, "margin": 0.005,
            "view_space": {"radius": 0.5, "min_elevation_deg": 60.0},
            "camera_body": [{"sphere": {"center": [0.0, 0.0, 0.0], "radius": 0.02}}],
        }),
    )
    .await;
    let cut_off = reasons(&found, "no_path");
    assert!(!cut_off.is_empty(), "{}", found["views"]);
    for reason in cut_off {
        assert_eq!(reason["parts"], json!(["start"]));
        assert!(number(reason, "attempts") >= 1.0);
    }
    assert_eq!(found["order"], json!([]));
}

//! Numbers of the cell that cannot be meant.

use serde_json::{Value, json};

use crate::harness::{Server, cell, problem, with};

#[tokio::test]
async fn numbers_of_the_cell_out_of_their_bounds_are_named() {
    let data = tempfile::tempdir().unwrap();
    let server = Server::start(data.path());
    let shaped = |shape: Value| {
        let mut body = cell();
        body["object"]["shape"] = shape;
        body
    };
    let around = |more: Value| with(cell(), more);
    let region = |solid: Value| around(json!({"keep_out": [with(json!({"name": "post"}), solid)]}));
    let ball = |radius: f64| json!({"sphere": {"center": [0.0, 0.0, 0.0], "radius": radius}});
    let many = |count: usize| vec![ball(0.01); count];
    let cases = [
        (
            shaped(json!({"cylinder": {"radius": 0.08, "height": 0.2}})),
            "shape_beyond_sphere",
            "object.shape.cylinder",
            "object.radius, 0.1 m",
        ),
        (
            shaped(json!({"cylinder": {"radius": 50, "height": 0.1}})),
            "millimetres",
            "object.shape.cylinder.radius",
            "50 mm are 0.05 m",
        ),
        (
            shaped(json!({"box": {"size": [0.1, 0.1, -0.1]}})),
            "out_of_range",
            "object.shape.box.size[2]",
            "from 0.001",
        ),
        (
            shaped(json!({"box": {"size": [0.1, 0.1, 0.1], "yaw": 45.0}})),
            "out_of_range",
            "object.shape.box.yaw",
            "degrees?",
        ),
        (shaped(json!("cube")), "invalid_member", "object.shape", "one of `sphere`"),
        (
            region(json!({"box": {"center": [0.2, -600.0, 0.3], "size": [0.6, 0.1, 0.4]}})),
            "millimetres",
            "keep_out[0].box.center[1]",
            "-600 mm are -0.6 m",
        ),
        (
            region(json!({"box": {"center": [0.2, 0.0, 0.3], "size": [0.6, 0.0, 0.4]}})),
            "out_of_range",
            "keep_out[0].box.size[1]",
            "from 0.0001 to 10 m",
        ),
        (
            region(
                json!({"box": {"center": [0.2, 0.0, 0.3], "size": [0.6, 0.1, 0.4], "orientation": [0, 0, 1, 1]}}),
            ),
            "non_unit_quaternion",
            "keep_out[0].box.orientation",
            "norm 1",
        ),
        (
            region(json!({"capsule": {"from": [0.2, 0.0, 0.3], "to": [0.2, 0.0, 300.0], "radius": 0.1}})),
            "millimetres",
            "keep_out[0].capsule.to[2]",
            "300 mm are 0.3 m",
        ),
        (region(json!({})), "solid_description", "keep_out[0]", "exactly one of box"),
        (
            around(json!({"keep_out": [with(ball(0.1), json!({"name": ""}))]})),
            "out_of_range",
            "keep_out[0].name",
            "1 to 100",
        ),
        (
            around(json!({"keep_out": vec![with(ball(0.1), json!({"name": "post"})); 65]})),
            "too_many",
            "keep_out",
            "at most 64 entries",
        ),
        (around(json!({"tool": many(33)})), "too_many", "tool", "at most 32 entries"),
        (around(json!({"tool": [ball(20.0)]})), "millimetres", "tool[0].sphere.radius", "20 mm are 0.02 m"),
        (
            around(json!({"camera_body": [ball(-0.1)]})),
            "out_of_range",
            "camera_body[0].sphere.radius",
            "to 2 m",
        ),
        (around(json!({"margin": -0.3})), "out_of_range", "margin", "from 0 to 0.2 m"),
        (around(json!({"margin": 10.0})), "millimetres", "margin", "10 mm are 0.01 m"),
        (
            around(json!({"timing": {"speed_scale": 0.0}})),
            "out_of_range",
            "timing.speed_scale",
            "from 0.01 to 1",
        ),
        (around(json!({"timing": {"settle": 300.0}})), "milliseconds", "timing.settle", "300 ms are 0.3 s"),
        (
            around(json!({"timing": {"sample_period": 8.0}})),
            "milliseconds",
            "timing.sample_period",
            "8 ms are 0.008 s",
        ),
        (json!({"margin": 0.02}), "robot_missing", "margin", "without robot"),
    ];
    for (body, code, field, bound) in cases {
        let body = with(body, json!({"view_count": 3}));
        let refused = problem(server.post("/v1/plans", &body).await).await;
        assert_eq!((&refused["status"], &refused["code"]), (&json!(422), &json!(code)), "{refused}");
        assert_eq!(refused["field"], field, "{refused}");
        assert!(refused["bound"].as_str().unwrap().contains(bound), "{refused}");
        assert!(refused.get("value").is_some(), "{refused}");
    }
}

#[tokio::test]
async fn a_hand_eye_given_the_wrong_way_round_and_a_start_beside_its_limit_are_named() {
    let data = tempfile::tempdir().unwrap();
    let server = Server::start(data.path());
    let codes = |plan: &Value| -> Vec<String> {
        let warnings = plan["warnings"].as_array().unwrap();
        warnings.iter().map(|w| w["code"].as_str().unwrap().to_owned()).collect()
    };
    let three = with(cell(), json!({"view_count": 3}));
    let mut inverted = three.clone();
    inverted["flange_from_camera"]["position"] = json!([0.02, -0.06, -0.07]);
    let plan = server.post_json("/v1/plans", &inverted).await;
    assert!(codes(&plan).contains(&"hand_eye_inverted".to_owned()), "{plan}");
    let mut w_first = three.clone();
    w_first["flange_from_camera"]["orientation"] = json!([1.0, 0.0, 0.0, 0.0]);
    let plan = server.post_json("/v1/plans", &w_first).await;
    assert!(codes(&plan).contains(&"hand_eye_backwards".to_owned()), "{plan}");

    let beside =
        with(three.clone(), json!({"start": [0.0, -1.6, 1.6, -1.6, -1.57, std::f64::consts::TAU + 9e-4]}));
    let plan = server.post_json("/v1/plans", &beside).await;
    assert!(codes(&plan).contains(&"start_clamped".to_owned()), "{plan}");
    let first = &plan["trajectory"]["points"][0]["positions"];
    assert_eq!(first[5].as_f64(), Some(std::f64::consts::TAU));
    let beyond = with(three, json!({"start": [0.0, -1.6, 1.6, -1.6, -1.57, std::f64::consts::TAU + 2e-3]}));
    let refused = problem(server.post("/v1/plans", &beyond).await).await;
    assert_eq!((&refused["code"], &refused["field"]), (&json!("joint_limit"), &json!("start[5]")));
}

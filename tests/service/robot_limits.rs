//! Joint limits and mesh files in the request; every number of a robot with its source.

use serde_json::json;

use crate::harness::{PRV, Server, cell, problem, with};

#[tokio::test]
async fn limits_of_the_request_bind_the_plan() {
    let data = tempfile::tempdir().unwrap();
    let server = Server::start(data.path());
    let limits = json!({
        "shoulder_pan_joint": {"max_speed": 0.3, "max_acceleration": 1.0},
        "wrist_3_joint": {"min": -3.2, "max": 7.0},
    });
    let plan =
        server.post_json("/v1/plans", &with(cell(), json!({"views": "initial", "limits": limits}))).await;
    let points = plan["trajectory"]["points"].as_array().unwrap();
    for point in points {
        assert!(point["velocities"][0].as_f64().unwrap().abs() <= 0.3 + 1e-9);
        assert!(point["positions"][5].as_f64().unwrap() >= -3.2);
    }
    let codes: Vec<&str> =
        plan["warnings"].as_array().unwrap().iter().map(|w| w["code"].as_str().unwrap()).collect();
    assert!(codes.contains(&"limit_widened") && !codes.contains(&"unused_jerk_limit"), "{codes:?}");

    // What is given but binds nothing is told.
    let idle = json!({
        "views": "initial", "limits": {"elbow_joint": {"max_jerk": 50.0}},
        "view_space": {"radius": 0.3, "min_elevation_deg": 40.0},
    });
    let plan = server.post_json("/v1/plans", &with(cell(), idle)).await;
    let told = |code: &str| plan["warnings"].as_array().unwrap().iter().any(|w| w["code"] == code);
    assert!(told("unused_jerk_limit") && told("unused_band"), "{}", plan["warnings"]);

    for (limits, code, field) in [
        (json!({"elbow": {"max": 1.0}}), "unknown_joint", "limits.elbow"),
        (json!({"elbow_joint": {"min": 2.0, "max": 1.0}}), "out_of_range", "limits.elbow_joint.max"),
        (json!({"elbow_joint": {"max": 180.0}}), "out_of_range", "limits.elbow_joint.max"),
        (json!({"elbow_joint": {"max_speed": 0.0}}), "out_of_range", "limits.elbow_joint.max_speed"),
        (json!({"elbow_joint": {"max_jerk": -5.0}}), "out_of_range", "limits.elbow_joint.max_jerk"),
    ] {
        let request = with(cell(), json!({"views": "initial", "limits": limits}));
        let refused = problem(server.post("/v1/plans", &request).await).await;
        assert_eq!(
            (&refused["status"], &refused["code"], &refused["field"]),
            (&json!(422), &json!(code), &json!(field)),
            "{refused}"
        );
        assert!(!refused["bound"].as_str().unwrap().is_empty());
    }
}

#[tokio::test]
async fn every_robot_documents_its_numbers_and_their_sources() {
    let data = tempfile::tempdir().unwrap();
    let server = Server::start(data.path());
    let robots = server.get_json("/v1/robots").await;
    let names: Vec<&str> = robots.as_array().unwrap().iter().map(|r| r["model"].as_str().unwrap()).collect();
    for model in ["ur3", "ur10", "ur20", "ur30", "panda", "fr3", "xarm6"] {
        assert!(names.contains(&model), "{names:?}");
    }
    for name in names {
        let robot = server.get_json(&format!("/v1/robots/{name}")).await;
        let joints = robot["joint_names"].as_array().unwrap().len();
        assert_eq!(robot["limits"].as_array().unwrap().len(), joints);
        assert_eq!(robot["kinematics"]["dh"].as_array().unwrap().len(), joints);
        assert_eq!(robot["links"].as_array().unwrap().len(), joints + 1);
        assert!(robot["links"][1]["shapes"][0]["radius"].as_f64().unwrap() > 0.0);
        assert_ne!(robot["solver"]["name"], "numeric");
        let groups: Vec<&str> =
            robot["sources"].as_array().unwrap().iter().map(|s| s["group"].as_str().unwrap()).collect();
        let expected =
            ["kinematics", "position_limits", "speed_limits", "acceleration_limits", "link_shapes"];
        assert_eq!(groups, expected);
    }
    let printed = std::process::Command::new(PRV).args(["robots", "fr3", "--json"]).output().unwrap();
    let printed: serde_json::Value = serde_json::from_slice(&printed.stdout).unwrap();
    let fr3 = server.get_json("/v1/robots/fr3").await;
    assert_eq!(printed["robots"], json!([fr3]));
    // What is not modelled as the maker has it is said.
    let speeds = fr3["sources"][2]["source"].as_str().unwrap();
    assert!(speeds.contains("falls towards the ends"), "{speeds}");
}

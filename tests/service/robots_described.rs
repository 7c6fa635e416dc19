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
    let run = server.start_execution(&run).await;
    assert_eq!(server.wait_for(&run, &["done", "failed"]).await["state"], "done");
}

#[tokio::test]
async fn a_mesh_that_is_not_attached_is_named_in_the_plans_warnings() {
    let data = tempfile::tempdir().unwrap();
    let server = Server::start(data.path());
    let quarter = std::f64::consts::FRAC_PI_2;
    let joint = |number: usize, xyz: &str, roll: f64| {
        format!(
            "<link name='l{number}'/><joint name='j{number}' type='revolute'><origin xyz='{xyz}' rpy='{roll} 0 0'/>\
             <parent link='l{}'/><child link='l{number}'/><axis xyz='0 0 1'/>\
             <limit lower='-6.2' upper='6.2' effort='1' velocity='2'/></joint>",
            number - 1
        )
    };
    let urdf = format!(
        "<robot name='arm'><link name='l0'><collision><geometry><mesh filename='foot.stl'/></geometry></collision>\
         </link>{}{}{}{}{}{}</robot>",
        joint(1, "0 0 0.4", 0.0),
        joint(2, "0 0 0", -quarter),
        joint(3, "0.45 0 0", 0.0),
        joint(4, "0 0.4 0", -quarter),
        joint(5, "0 0 0", quarter),
        joint(6, "0 0 0", -quarter),
    );
    let request = |meshes: serde_json::Value| {
        let robot = with(json!({"urdf": urdf}), meshes);
        with(cell(), json!({"views": "initial", "robot": robot}))
    };
    let warned = |plan: &serde_json::Value, code: &str| {
        plan["warnings"].as_array().unwrap().iter().any(|w| {
            let message = w["message"].as_str().unwrap();
            w["code"] == code && message.contains("l0") && message.contains("foot.stl")
        })
    };
    let plan = server.post_json("/v1/plans", &request(json!({}))).await;
    assert!(warned(&plan, "mesh_left_out"), "{}", plan["warnings"]);
    // The corners of a box of 20 x 20 x 10 cm, as an OBJ file in base64.
    let file = "diAwLjEgMC4xIDAKdiAtMC4xIC0wLjEgMC4xCnYgMC4xIC0wLjEgMAp2IC0wLjEgMC4xIDAuMQo=";
    let plan = server.post_json("/v1/plans", &request(json!({"meshes": {"foot.stl": file}}))).await;
    assert!(warned(&plan, "mesh_replaced"), "{}", plan["warnings"]);
    let astray = request(json!({"meshes": {"foot.stl": file, "leg.stl": file}}));
    let plan = server.post_json("/v1/plans", &astray).await;
    let unused = plan["warnings"].as_array().unwrap().iter().find(|w| w["code"] == "mesh_unused").unwrap();
    let message = unused["message"].as_str().unwrap();
    assert!(message.contains("leg.stl; the URDF's names are foot.stl"), "{message}");
    let broken = request(json!({"meshes": {"foot.stl": "aGVsbG8="}}));
    let refused = crate::harness::problem(server.post("/v1/plans", &broken).await).await;
    assert_eq!((&refused["status"], &refused["code"]), (&json!(422), &json!("urdf")), "{refused}");
    assert_eq!(refused["field"], "robot.meshes.foot.stl");
}

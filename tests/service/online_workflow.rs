//! Initial plan, photos, plan, execution, images: the main job from end to end.

use serde_json::{Value, json};

use crate::harness::{Server, cell, problem, with};

#[tokio::test]
async fn an_unknown_object_is_photographed_planned_and_scanned() {
    let data = tempfile::tempdir().unwrap();
    let server = Server::start(data.path());

    let initial = server.post_json("/v1/plans", &with(cell(), json!({"views": "initial"}))).await;
    let unpredicted = json!({"predicted": null, "raw": null, "interval": null, "novelty": null, "used": 3});
    assert_eq!(initial["view_count"], unpredicted);
    assert_eq!(initial["order"].as_array().unwrap().last(), Some(&json!(0)), "ends at the top");
    let names: Vec<&str> =
        initial["views"].as_array().unwrap().iter().map(|view| view["name"].as_str().unwrap()).collect();
    assert_eq!(names, ["top", "left", "front"]);

    let photos = execute(&server, &initial).await;
    let photos = server.get_json(&format!("/v1/executions/{photos}/images")).await;
    assert_eq!(photos["images"].as_array().unwrap().len(), 3);

    // The photos' document is ready to be merged into the next request.
    let request = with(with(cell(), photos), json!({}));
    let ready = server.get("/readyz").await.status().is_success();
    let plan = if ready {
        let plan = server.post_json("/v1/plans", &request).await;
        assert_eq!(plan["view_count"]["predicted"], plan["view_count"]["used"]);
        assert!(plan["view_count"]["raw"].is_f64());
        assert!(plan["view_count"]["novelty"].as_f64().unwrap() < 1.0, "{}", plan["view_count"]);
        assert_eq!(plan["expected_image_poses"].as_array().unwrap().len(), 3);
        let codes: Vec<&str> =
            plan["warnings"].as_array().unwrap().iter().map(|w| w["code"].as_str().unwrap()).collect();
        assert!(!codes.contains(&"unexpected_image_pose"), "{codes:?}");
        plan
    } else {
        let refusal = problem(server.post("/v1/plans", &request).await).await;
        assert_eq!(
            (refusal["status"].as_u64(), refusal["code"].as_str()),
            (Some(503), Some("prediction_unavailable"))
        );
        server.post_json("/v1/plans", &with(cell(), json!({"view_count": 9}))).await
    };
    assert_eq!(plan["order"][0], 0, "starts at the top");
    let views = plan["views"].as_array().unwrap();
    assert_eq!(views.len() as u64, plan["view_count"]["used"].as_u64().unwrap());
    check_trajectory(&plan);

    let run = execute(&server, &plan).await;
    let execution = server.get_json(&format!("/v1/executions/{run}")).await;
    assert_eq!(execution["images"], plan["order"]);
    assert_eq!(execution["progress"]["views_done"], execution["progress"]["views_total"]);
    assert_eq!(execution["joints"]["names"], plan["trajectory"]["joint_names"]);

    let transforms = server.get_json(&format!("/v1/executions/{run}/transforms.json")).await;
    let frames = transforms["frames"].as_array().unwrap();
    assert_eq!(frames.len(), plan["order"].as_array().unwrap().len());
    for (frame, id) in frames.iter().zip(plan["order"].as_array().unwrap()) {
        // OpenGL axes: the third column points away from where the camera looks; the fourth is where it stands.
        let view = &views[id.as_u64().unwrap() as usize];
        for (axis, planned) in view["pose"]["position"].as_array().unwrap().iter().enumerate() {
            let stood = frame["transform_matrix"][axis][3].as_f64().unwrap();
            assert!((stood - planned.as_f64().unwrap()).abs() < 1e-6, "view {id}: {frame}");
        }
        assert!(frame["file_path"].as_str().unwrap().ends_with(&format!("{:03}.png", id.as_u64().unwrap())));
    }
    for id in plan["order"].as_array().unwrap() {
        let response = server.get(&format!("/v1/executions/{run}/images/{id}")).await;
        assert_eq!(response.headers()["content-type"], "image/png");
        let image = image::load_from_memory(&response.bytes().await.unwrap()).unwrap().into_rgba8();
        assert_eq!(image.dimensions(), (320, 180));
        let covered = image.pixels().filter(|pixel| pixel.0[3] == 255).count();
        assert!(covered > 1000, "view {id} shows the object on {covered} pixels");
        assert_eq!(image.get_pixel(0, 0).0[3], 0, "nothing in the corner");
    }
}

/// Executes a plan as fast as possible and waits for its end; returns the run's id.
async fn execute(server: &Server, plan: &Value) -> String {
    let request = json!({"plan_id": plan["id"], "object": {"sample": "mug"}, "speed_factor": 100000.0});
    let response = server.post("/v1/executions", &request).await;
    assert_eq!(response.status(), 202);
    let location = response.headers()["location"].to_str().unwrap().to_owned();
    let run: Value = response.json().await.unwrap();
    let id = run["id"].as_str().unwrap().to_owned();
    assert_eq!(location, format!("/v1/executions/{id}"));
    let ended = server.wait_for(&id, &["done", "failed"]).await;
    assert_eq!(ended["state"], "done", "{ended}");
    id
}

/// Times increase strictly, rows are whole, and every planned view is marked once, in order.
fn check_trajectory(plan: &Value) {
    let trajectory = &plan["trajectory"];
    let joints = trajectory["joint_names"].as_array().unwrap().len();
    assert_eq!(joints, 6);
    let mut last = -1.0;
    let mut marked = Vec::new();
    for point in trajectory["points"].as_array().unwrap() {
        for row in ["positions", "velocities", "accelerations"] {
            assert_eq!(point[row].as_array().unwrap().len(), joints);
        }
        let time = point["time_from_start"].as_f64().unwrap();
        assert!(time > last, "{time} follows {last}");
        last = time;
        if let Some(view) = point.get("view") {
            assert!(point["velocities"].as_array().unwrap().iter().all(|v| v.as_f64().unwrap().abs() < 1e-9));
            marked.push(view.clone());
        }
    }
    assert_eq!(Value::Array(marked), plan["order"]);
}

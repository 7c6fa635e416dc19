//! Plans that somebody changed, before the independent check.

use std::process::Command;

use serde_json::{Value, json};

use crate::harness::{PRV, Server, cell, problem, with};

fn codes(verdict: &Value) -> Vec<&str> {
    verdict["violations"].as_array().unwrap().iter().map(|v| v["code"].as_str().unwrap()).collect()
}

fn points(plan: &mut Value) -> &mut Vec<Value> {
    plan["trajectory"]["points"].as_array_mut().unwrap()
}

fn shift(point: &mut Value, member: &str, joint: usize, by: f64) {
    let value = point[member][joint].as_f64().unwrap();
    point[member][joint] = json!(value + by);
}

/// Index of the point at which the `n`th view is taken.
fn stop(plan: &Value, n: usize) -> usize {
    let points = plan["trajectory"]["points"].as_array().unwrap();
    let mut stops = points.iter().enumerate().filter(|(_, p)| p.get("view").is_some());
    stops.nth(n).unwrap().0
}

/// A change to request and plan, and the violation it is.
type Tampering = (&'static str, fn(&mut Value, &mut Value));

/// One for every kind of violation.
const TAMPERINGS: [Tampering; 22] = [
    ("too_near", |_, plan| {
        // A point moved so that the arm reaches through the table.
        let middle = stop(plan, 0) + 12;
        points(plan)[middle]["positions"][1] = json!(0.5);
        points(plan)[middle]["positions"][2] = json!(0.0);
    }),
    ("too_near", |request, plan| {
        // A region where the path goes through.
        let at = plan["views"][plan["order"][1].as_u64().unwrap() as usize]["pose"]["position"].clone();
        request["keep_out"] = json!([{"name": "late", "sphere": {"center": at, "radius": 0.03}}]);
    }),
    ("speed_limit", |_, plan| {
        for point in points(plan) {
            let time = point["time_from_start"].as_f64().unwrap();
            point["time_from_start"] = json!(0.2 * time);
        }
    }),
    ("acceleration_limit", |_, plan| {
        let middle = stop(plan, 0) + 3;
        points(plan)[middle]["accelerations"][0] = json!(30.0);
    }),
    ("jerk_limit", |request, _| request["timing"] = json!({"jerk_limited": true})),
    ("time_not_increasing", |_, plan| {
        let time = points(plan)[3]["time_from_start"].clone();
        points(plan)[4]["time_from_start"] = time;
    }),
    ("jump", |_, plan| {
        let middle = stop(plan, 0) + 5;
        shift(&mut points(plan)[middle], "positions", 5, 0.05);
    }),
    ("joint_limit", |_, plan| {
        points(plan).iter_mut().for_each(|p| shift(p, "positions", 5, 12.566370614359172));
        points(plan).iter_mut().for_each(|p| shift(p, "positions", 5, 1.0));
    }),
    ("malformed_point", |_, plan| {
        points(plan)[2]["positions"].as_array_mut().unwrap().pop();
    }),
    ("wrong_pose", |_, plan| {
        // The camera is a centimetre beside its view.
        points(plan).iter_mut().for_each(|p| shift(p, "positions", 0, 0.02));
    }),
    ("view_off_shell", |_, plan| {
        let height = plan["views"][0]["pose"]["position"][2].as_f64().unwrap();
        plan["views"][0]["pose"]["position"][2] = json!(height + 0.01);
    }),
    ("view_off_aim", |_, plan| {
        let turn = 0.01f64;
        plan["views"][0]["pose"]["orientation"] = json!([turn.cos(), turn.sin() * 0.0, turn.sin(), 0.0]);
    }),
    ("view_out_of_band", |request, _| {
        request["view_space"] = json!({"radius": 0.3, "min_elevation_deg": 40.0})
    }),
    ("view_rolled", |request, plan| {
        request["roll"] = json!("fixed");
        // Half a right angle about the optical axis of the top view.
        let s = std::f64::consts::FRAC_PI_8;
        plan["views"][1]["pose"]["orientation"] = json!([s.cos(), s.sin(), 0.0, 0.0]);
        plan["views"][1]["pose"]["position"] = json!([0.45, 0.0, 0.45]);
        let tilted = &mut plan["views"][1]["pose"];
        // From the side: the camera looks along -x, its horizon upright.
        *tilted = json!({"position": [0.75, 0.0, 0.15], "orientation": [0.0, -std::f64::consts::FRAC_1_SQRT_2, 0.0, std::f64::consts::FRAC_1_SQRT_2]});
    }),
    ("view_missing", |_, plan| {
        plan["views"].as_array_mut().unwrap().pop();
    }),
    ("view_not_taken", |_, plan| {
        let index = stop(plan, 1);
        points(plan)[index].as_object_mut().unwrap().remove("view");
    }),
    ("view_not_taken", |_, plan| {
        // The rest before the photo is cut out.
        let index = stop(plan, 1);
        points(plan).remove(index + 1);
    }),
    ("wrong_order", |_, plan| {
        plan["order"].as_array_mut().unwrap().pop();
    }),
    ("no_trajectory", |_, plan| {
        plan.as_object_mut().unwrap().remove("trajectory");
    }),
    ("wrong_joints", |_, plan| plan["trajectory"]["joint_names"].as_array_mut().unwrap().swap(0, 1)),
    ("wrong_start", |request, _| request["start"] = json!([0.0, -1.6, 1.6, -1.6, -1.57, 0.0])),
    ("not_proven", |_, plan| points(plan).iter_mut().for_each(|p| p["velocities"][0] = json!(1e6))),
];

#[tokio::test]
async fn a_plan_is_sound_and_every_kind_of_tampering_is_caught() {
    let data = tempfile::tempdir().unwrap();
    let server = Server::start(data.path());
    let request = with(cell(), json!({"view_count": 6, "view_space": {"radius": 0.3}}));
    let plan = server.post_json("/v1/plans", &request).await;
    let verdict = server.post_json("/v1/checks", &json!({"plan_id": plan["id"]})).await;
    assert_eq!(verdict["sound"], true, "{verdict}");
    let checked = &verdict["checked"];
    assert_eq!(checked["points"], plan["trajectory"]["points"].as_array().unwrap().len());
    assert_eq!(checked["undercut_bound_m"], 0.001);
    let clearance = &checked["smallest_clearance"];
    assert!(clearance["distance_m"].as_f64().unwrap() >= 0.009, "{clearance}");
    assert!(checked["largest_speed_share"].as_f64().unwrap() <= 1.000001, "{checked}");
    assert!(checked["largest_pose_error_m"].as_f64().unwrap() < 1e-9, "{checked}");
    let stored = server.get_json(&format!("/v1/plans/{}/request", plan["id"].as_str().unwrap())).await;
    let pair = json!({"request": stored, "plan": plan});
    assert_eq!(server.post_json("/v1/checks", &pair).await, verdict);

    for (expected, tamper) in TAMPERINGS {
        let (mut changed_request, mut changed) = (request.clone(), plan.clone());
        tamper(&mut changed_request, &mut changed);
        let verdict =
            server.post_json("/v1/checks", &json!({"request": changed_request, "plan": changed})).await;
        assert_eq!(verdict["sound"], false, "{expected}");
        assert!(codes(&verdict).contains(&expected), "{expected}: {:?}", codes(&verdict));
        for violation in verdict["violations"].as_array().unwrap() {
            assert!(!violation["message"].as_str().unwrap().is_empty() && violation["numbers"].is_object());
        }
    }
}

#[tokio::test]
async fn a_view_under_the_table_is_caught_without_an_arm_too() {
    let data = tempfile::tempdir().unwrap();
    let server = Server::start(data.path());
    let request =
        json!({"view_count": 6, "object": {"center": [0.0, 0.0, 0.1], "radius": 0.1, "table_z": 0.0}});
    let plan = server.post_json("/v1/plans", &request).await;
    let pair = json!({"request": request, "plan": plan});
    assert_eq!(server.post_json("/v1/checks", &pair).await["sound"], true);
    let mut raised = pair.clone();
    raised["request"]["object"]["table_z"] = json!(0.099);
    raised["plan"]["views"][0]["status"] = json!("planned");
    raised["request"]["object"]["center"] = json!([0.0, 0.0, 0.2]);
    let verdict = server.post_json("/v1/checks", &raised).await;
    assert!(codes(&verdict).contains(&"view_off_shell"), "{verdict}");
    let mut sunk = pair;
    sunk["request"]["object"]["table_z"] = json!(0.1);
    sunk["request"]["view_space"] = json!({"min_elevation_deg": -90.0});
    let low = json!({"position": [0.0, 0.0, -0.2], "orientation": [0.0, 0.0, 0.0, 1.0]});
    let last = sunk["plan"]["order"][5].as_u64().unwrap() as usize;
    sunk["plan"]["views"][last]["pose"] = low;
    let verdict = server.post_json("/v1/checks", &sunk).await;
    assert!(codes(&verdict).contains(&"view_under_table"), "{verdict}");
}

#[tokio::test]
async fn what_cannot_be_checked_is_refused_by_name() {
    let data = tempfile::tempdir().unwrap();
    let server = Server::start(data.path());
    let unknown = json!({"plan_id": "0123456789abcdef0123456789abcdef"});
    let refused = problem(server.post("/v1/checks", &unknown).await).await;
    assert_eq!((&refused["status"], &refused["code"]), (&json!(404), &json!("unknown_plan")));
    let neither = problem(server.post("/v1/checks", &json!({})).await).await;
    assert_eq!((&neither["status"], &neither["code"]), (&json!(422), &json!("check_source")));
    let request = with(cell(), json!({"view_count": 3}));
    let mut plan = server.post_json("/v1/plans", &request).await;
    plan["views"][1]["id"] = json!(7);
    let refused = problem(server.post("/v1/checks", &json!({"request": request, "plan": plan})).await).await;
    assert_eq!((&refused["code"], &refused["field"]), (&json!("view_ids"), &json!("plan.views[1].id")));
    plan["views"][1]["id"] = json!(1);
    plan["views"][1]["pose"]["orientation"] = json!([0.0, 0.0, 0.0, 0.0]);
    let refused = problem(server.post("/v1/checks", &json!({"request": request, "plan": plan})).await).await;
    assert_eq!(refused["code"], "non_unit_quaternion");
    let mut bad = request.clone();
    bad["object"]["radius"] = json!(-1.0);
    let refused = problem(server.post("/v1/checks", &json!({"request": bad, "plan": plan})).await).await;
    assert_eq!(refused["status"], 422);
}

#[test]
fn the_command_tells_sound_from_spoilt_from_unreadable_by_its_exit_code() {
    let data = tempfile::tempdir().unwrap();
    let (request, plan) = (data.path().join("request.json"), data.path().join("plan.json"));
    std::fs::write(&request, with(cell(), json!({"view_count": 4})).to_string()).unwrap();
    let planned = Command::new(PRV).arg("plan").arg(&request).output().unwrap();
    std::fs::write(&plan, &planned.stdout).unwrap();
    let check = |file: &std::path::Path, flags: &[&str]| {
        let output = Command::new(PRV).arg("check").arg(file).args(flags).output().unwrap();
        (output.status.code(), String::from_utf8_lossy(&output.stdout).into_owned())
    };
    let with_request = ["--request", request.to_str().unwrap(), "--json"];
    let (code, text) = check(&plan, &with_request);
    let verdict: Value = serde_json::from_str(&text).unwrap();
    assert_eq!((code, &verdict["sound"]), (Some(0), &json!(true)), "{verdict}");

    let mut spoilt: Value = serde_json::from_slice(&planned.stdout).unwrap();
    let first = spoilt["trajectory"]["points"][0]["time_from_start"].clone();
    spoilt["trajectory"]["points"][1]["time_from_start"] = first;
    let request_value: Value = serde_json::from_slice(&std::fs::read(&request).unwrap()).unwrap();
    let pair = data.path().join("pair.json");
    std::fs::write(&pair, json!({"request": request_value, "plan": spoilt}).to_string()).unwrap();
    let (code, text) = check(&pair, &[]);
    assert_eq!(code, Some(1), "{text}");
    assert!(text.contains("time_not_increasing"), "{text}");

    assert_eq!(check(&plan, &[]).0, Some(2));
    assert_eq!(check(data.path(), &[]).0, Some(2));
}

#[test]
fn random_cells_are_counted_and_their_log_is_resumed() {
    let data = tempfile::tempdir().unwrap();
    let log = data.path().join("log.jsonl");
    let run = |count: &str| {
        let flags = ["check", "--random", count, "--seed", "7", "--most-views", "5", "--json", "--log"];
        let output = Command::new(PRV).args(flags).arg(&log).output().unwrap();
        assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
        serde_json::from_slice::<Value>(&output.stdout).unwrap()
    };
    let counts = run("100");
    assert_eq!(counts["cells"], 100);
    assert!(counts["planned"].as_u64().unwrap() > 100, "{counts}");
    let logged = std::fs::read_to_string(&log).unwrap();
    assert_eq!(run("100"), counts);
    assert_eq!(std::fs::read_to_string(&log).unwrap(), logged);
}

#[tokio::test]
async fn numbers_beyond_any_arms_give_no_verdict_with_holes() {
    let data = tempfile::tempdir().unwrap();
    let server = Server::start(data.path());
    let request = with(cell(), json!({"view_count": 3}));
    let plan = server.post_json("/v1/plans", &request).await;
    for (member, value, bound) in [
        ("positions", json!(1e308), "within +-10000 rad"),
        ("velocities", json!(-1e300), "within +-1000000 rad/s"),
        ("accelerations", json!(10_000_000_000i64), "within +-1000000000 rad/s2"),
    ] {
        let mut changed = plan.clone();
        points(&mut changed)[3][member][2] = value.clone();
        let refused =
            problem(server.post("/v1/checks", &json!({"request": request, "plan": changed})).await).await;
        assert_eq!(refused["code"], "out_of_range", "{refused}");
        assert_eq!(refused["field"], format!("plan.trajectory.points[3].{member}[2]"));
        assert_eq!((&refused["value"], &refused["bound"]), (&value, &json!(bound)));
    }
    // The largest numbers that are judged, as close in time as they come.
    let mut wild = plan;
    for (index, point) in points(&mut wild).iter_mut().enumerate() {
        let sign = if index % 2 == 0 { 1.0 } else { -1.0 };
        for (member, most) in [("positions", 1e4), ("velocities", 1e6), ("accelerations", 1e9)] {
            point[member] = json!(vec![sign * most; 6]);
        }
        point["time_from_start"] = json!(index as f64 * 5e-324);
    }
    let wild_request = with(request, json!({"timing": {"jerk_limited": true}}));
    for step in [5e-324, 1.1e-9] {
        for (index, point) in points(&mut wild).iter_mut().enumerate() {
            point["time_from_start"] = json!(index as f64 * step);
        }
        let verdict = server.post_json("/v1/checks", &json!({"request": wild_request, "plan": wild})).await;
        assert_eq!(verdict["sound"], false);
        for share in ["largest_speed_share", "largest_acceleration_share", "largest_jerk_share"] {
            let share = verdict["checked"][share].as_f64().unwrap();
            assert!((0.0..=1e9).contains(&share), "{share}");
        }
        for violation in verdict["violations"].as_array().unwrap() {
            assert!(violation["message"].as_str().unwrap().len() < 200, "{violation}");
        }
    }
}

//! What an integrator gets wrong, and whether the answer says so in words that need no knowledge of the
//! service's inside.

use serde_json::{Value, json};

use crate::harness::{Server, cell, problem, with};

/// A body, and what must be said about it: status, code, field, value, a part of the bound.
type Case = (Value, u64, &'static str, &'static str, Value, &'static str);

/// Words of the parser that no robotics user knows.
const JARGON: [&str; 14] = [
    "f64",
    "u32",
    "struct",
    "sequence",
    "invalid type",
    "invalid value",
    "invalid length",
    "variant",
    "deserialize",
    " map",
    "NaN,",
    "expected",
    "at line",
    "None",
];

/// `cell()` for three views with `more`.
fn request(more: Value) -> Value {
    with(with(cell(), json!({"view_count": 3})), more)
}

fn object(more: Value) -> Value {
    request(json!({"object": with(cell()["object"].clone(), more)}))
}

fn region(solid: Value) -> Value {
    request(json!({"keep_out": [with(json!({"name": "post"}), solid)]}))
}

fn dh(row: Value) -> Value {
    let sound = json!({"d": 0.1, "a": 0.2, "alpha": 1.57, "min": -3.0, "max": 3.0, "max_speed": 1.0});
    let mut rows = vec![sound.clone(); 6];
    rows[2] = with(sound, row);
    request(json!({"robot": {"dh": rows}}))
}

fn limit(joint: Value) -> Value {
    request(json!({"limits": {"elbow_joint": joint}}))
}

fn types() -> Vec<Case> {
    let number = "a number";
    vec![
        (object(json!({"radius": "0.1"})), 422, "invalid_member", "object.radius", json!("0.1"), number),
        (object(json!({"radius": null})), 422, "invalid_member", "object.radius", json!(null), number),
        (
            object(json!({"center": {"x": 1}})),
            422,
            "invalid_member",
            "object.center",
            json!({"x": 1}),
            "a list of 3 numbers",
        ),
        (
            object(json!({"center": [0.4, 0.0]})),
            422,
            "invalid_member",
            "object.center",
            json!([0.4, 0]),
            "a list of 3 numbers",
        ),
        (
            object(json!({"center": [0, 0, 0, 1]})),
            422,
            "invalid_member",
            "object.center",
            json!([0, 0, 0, 1]),
            "a list of 3 numbers",
        ),
        (
            object(json!({"centre": [0, 0, 0]})),
            422,
            "invalid_member",
            "object.centre",
            json!([0, 0, 0]),
            "left out (`center`?)",
        ),
        (
            object(json!({"shape": {"cylinder": {"radius": 0.05}}})),
            422,
            "invalid_member",
            "object.shape.cylinder.height",
            json!(null),
            "given",
        ),
        (
            object(json!({"shape": {"cone": {}}})),
            422,
            "invalid_member",
            "object.shape",
            json!({"cone": {}}),
            "one of `sphere`, `cylinder`, `box`",
        ),
        (
            request(json!({"view_count": "35"})),
            422,
            "invalid_member",
            "view_count",
            json!("35"),
            "a whole number",
        ),
        (
            request(json!({"view_count": 35.5})),
            422,
            "invalid_member",
            "view_count",
            json!(35.5),
            "a whole number",
        ),
        (
            request(json!({"view_count": -1})),
            422,
            "invalid_member",
            "view_count",
            json!(-1),
            "a whole number of at least 0",
        ),
        (
            request(json!({"view_count": [35]})),
            422,
            "invalid_member",
            "view_count",
            json!([35]),
            "a whole number",
        ),
        (request(json!({"robot": "ur5e"})), 422, "invalid_member", "robot", json!("ur5e"), "an object"),
        (
            request(json!({"robot": {"name": "ur5e"}})),
            422,
            "invalid_member",
            "robot.name",
            json!("ur5e"),
            "left out: the members here are `model`",
        ),
        (request(json!({"robot": {"model": 5}})), 422, "invalid_member", "robot.model", json!(5), "a text"),
        (
            request(json!({"roll": 0})),
            422,
            "invalid_member",
            "roll",
            json!(0),
            "one of `free`, `fixed`, `sampled`",
        ),
        (
            request(json!({"roll": true})),
            422,
            "invalid_member",
            "roll",
            json!(true),
            "one of `free`, `fixed`, `sampled`",
        ),
        (
            request(json!({"objective": "fast"})),
            422,
            "invalid_member",
            "objective",
            json!("fast"),
            "one of `distance`, `time`",
        ),
        (request(json!({"start": "home"})), 422, "invalid_member", "start", json!("home"), "a list"),
        (
            request(json!({"start": [0, "a", 0, 0, 0, 0]})),
            422,
            "invalid_member",
            "start[1]",
            json!("a"),
            number,
        ),
        (request(json!({"timing": 0.5})), 422, "invalid_member", "timing", json!(0.5), "an object"),
        (
            request(json!({"timing": {"jerk_limited": "yes"}})),
            422,
            "invalid_member",
            "timing.jerk_limited",
            json!("yes"),
            "true or false",
        ),
        (request(json!({"limits": [1, 2]})), 422, "invalid_member", "limits", json!([1, 2]), "an object"),
        (
            request(json!({"keep_out": {"name": "post"}})),
            422,
            "invalid_member",
            "keep_out",
            json!({"name": "post"}),
            "a list",
        ),
        (
            request(json!({"keep_out": [{"box": {"center": [0, 0, 0], "size": [1, 1, 1]}}]})),
            422,
            "invalid_member",
            "keep_out[0].name",
            json!(null),
            "given",
        ),
        (
            request(json!({"flange_from_camera": [0, 0, 0.05, 0, 0, 0, 1]})),
            422,
            "invalid_member",
            "flange_from_camera",
            json!([0, 0, 0.05, 0, 0, 0, 1]),
            "an object",
        ),
        (
            request(json!({"flange_from_camera": {"position": [0, 0, 0.05]}})),
            422,
            "invalid_member",
            "flange_from_camera.orientation",
            json!(null),
            "given",
        ),
        (
            request(json!({"flange_from_camera": {"position": [0, 0, 0], "orientation": [0, 0, 0]}})),
            422,
            "invalid_member",
            "flange_from_camera.orientation",
            json!([0, 0, 0]),
            "a list of 4 numbers",
        ),
        (
            request(json!({"images": "photo.png"})),
            422,
            "invalid_member",
            "images",
            json!("photo.png"),
            "a list",
        ),
        (json!([1]), 422, "invalid_member", "body", json!([1]), "an object"),
        (json!("plan"), 422, "invalid_member", "body", json!("plan"), "an object"),
    ]
}

fn numbers() -> Vec<Case> {
    vec![
        (request(json!({"view_count": 201})), 422, "out_of_range", "view_count", json!(201), "from 1 to 200"),
        (
            request(
                json!({"keep_out": vec![with(json!({"name": "p"}), json!({"sphere": {"center": [2, 0, 0], "radius": 0.1}})); 65]}),
            ),
            422,
            "too_many",
            "keep_out",
            json!(65),
            "at most 64 entries",
        ),
        (
            request(json!({"images": [], "view_count": null})),
            422,
            "image_count",
            "images",
            json!(0),
            "1 to 5 images",
        ),
        (
            object(json!({"center": [450, 0, 150]})),
            422,
            "millimetres",
            "object.center[0]",
            json!(450),
            "450 mm are 0.45 m",
        ),
        (object(json!({"radius": 80})), 422, "millimetres", "object.radius", json!(80), "80 mm are 0.08 m"),
        (
            request(json!({"view_space": {"radius": 300}})),
            422,
            "millimetres",
            "view_space.radius",
            json!(300),
            "300 mm are 0.3 m",
        ),
        (
            request(json!({"flange_from_camera": {"position": [0, 0, 50], "orientation": [0, 0, 0, 1]}})),
            422,
            "millimetres",
            "flange_from_camera.position[2]",
            json!(50),
            "millimetres?",
        ),
        (
            request(json!({"flange_from_camera": {"position": [0, 0, 0.05], "orientation": [0, 0, 90, 0]}})),
            422,
            "non_unit_quaternion",
            "flange_from_camera.orientation",
            json!([0, 0, 90, 0]),
            "x, y, z, w of norm 1",
        ),
        (
            request(json!({"start": [0, -90, 90, -90, -90, 0]})),
            422,
            "joint_limit",
            "start[1]",
            json!(-90),
            "-6.2832 rad, the limit of shoulder_lift_joint (degrees? -90 degrees are -1.5708 rad)",
        ),
        (request(json!({"start": [0, 0, 0]})), 422, "joint_count", "start", json!(3), "6 joint angles"),
        (
            limit(json!({"max": 180})),
            422,
            "out_of_range",
            "limits.elbow_joint.max",
            json!(180),
            "degrees? 180 degrees are 3.1416 rad",
        ),
        (
            limit(json!({"min": -180})),
            422,
            "out_of_range",
            "limits.elbow_joint.min",
            json!(-180),
            "degrees? -180 degrees are -3.1416 rad",
        ),
        (
            limit(json!({"min": 2, "max": 1})),
            422,
            "out_of_range",
            "limits.elbow_joint.max",
            json!(1),
            "above min, 2.0000 rad",
        ),
        (
            limit(json!({"max_speed": 0})),
            422,
            "out_of_range",
            "limits.elbow_joint.max_speed",
            json!(0),
            "[0.001, 1000] rad/s",
        ),
        (
            request(json!({"limits": {"elbow": {"max": 1}}})),
            422,
            "unknown_joint",
            "limits.elbow",
            json!("elbow"),
            "elbow_joint",
        ),
        (
            dh(json!({"a": 425})),
            422,
            "out_of_range",
            "robot.dh[2].a",
            json!(425),
            "millimetres given as metres?",
        ),
        (
            dh(json!({"alpha": 90})),
            422,
            "out_of_range",
            "robot.dh[2].alpha",
            json!(90),
            "degrees given as radians?",
        ),
        (
            dh(json!({"max": 175})),
            422,
            "out_of_range",
            "robot.dh[2].max",
            json!(175),
            "degrees given as radians?",
        ),
        (dh(json!({"max_speed": 0})), 422, "out_of_range", "robot.dh[2].max_speed", json!(0), "0.001"),
        (
            request(json!({"robot": {"dh": []}})),
            422,
            "joint_count",
            "robot",
            json!(0),
            "6 to 7 moving joints",
        ),
        (
            region(json!({"box": {"center": [0.2, -600, 0.3], "size": [0.6, 0.1, 0.4]}})),
            422,
            "millimetres",
            "keep_out[0].box.center[1]",
            json!(-600),
            "-600 mm are -0.6 m",
        ),
        (request(json!({"margin": 10})), 422, "millimetres", "margin", json!(10), "10 mm are 0.01 m"),
        (
            request(json!({"timing": {"settle": 300}})),
            422,
            "milliseconds",
            "timing.settle",
            json!(300),
            "300 ms are 0.3 s",
        ),
        (
            request(json!({"timing": {"speed_scale": 50}})),
            422,
            "out_of_range",
            "timing.speed_scale",
            json!(50),
            "from 0.01 to 1",
        ),
        (
            object(json!({"shape": {"box": {"size": [0.1, 0.1, 0.1], "yaw": 45}}})),
            422,
            "out_of_range",
            "object.shape.box.yaw",
            json!(45),
            "degrees?",
        ),
        (
            request(json!({"view_space": {"min_elevation_deg": 95}})),
            422,
            "out_of_range",
            "view_space.min_elevation_deg",
            json!(95),
            "-90 to 90 degrees",
        ),
        (
            request(
                json!({"camera": {"width": 0, "height": 720, "fx": 900, "fy": 900, "cx": 640, "cy": 360}}),
            ),
            422,
            "out_of_range",
            "camera.width",
            json!(0),
            "1 to 16384",
        ),
    ]
}

fn contradictions() -> Vec<Case> {
    vec![
        (
            json!({}),
            422,
            "view_source",
            "images",
            json!("none of them"),
            "exactly one of images, view_count and views",
        ),
        (
            json!({"view_count": 3, "robot": {"model": "ur5e"}}),
            422,
            "missing_member",
            "object",
            json!(null),
            "given with a robot",
        ),
        (
            json!({"view_count": 3, "roll": "free"}),
            422,
            "robot_missing",
            "roll",
            json!("free"),
            "left out without robot",
        ),
        (
            json!({"view_count": 3, "unreachable_views": "skip"}),
            422,
            "robot_missing",
            "unreachable_views",
            json!("skip"),
            "left out without robot",
        ),
        (
            request(json!({"roll": "sampled"})),
            422,
            "missing_member",
            "roll_samples",
            json!(null),
            "from 1 to 64",
        ),
        (
            request(json!({"roll": "free", "roll_samples": 4})),
            422,
            "roll_not_sampled",
            "roll_samples",
            json!(4),
            "left out unless roll is sampled",
        ),
        (
            request(json!({"robot": {}})),
            422,
            "robot_description",
            "robot",
            json!("0 of model, dh, urdf"),
            "exactly one of",
        ),
        (
            request(json!({"robot": {"model": "ur5e", "tip_link": "tool0"}})),
            422,
            "urdf_missing",
            "robot.tip_link",
            json!("tool0"),
            "left out without robot.urdf",
        ),
        (
            request(json!({"robot": {"model": "ur5e", "base_link": "base"}})),
            422,
            "urdf_missing",
            "robot.base_link",
            json!("base"),
            "left out without robot.urdf",
        ),
        (
            request(json!({"robot": {"model": "ur5e", "meshes": {"a.stl": ""}}})),
            422,
            "urdf_missing",
            "robot.meshes",
            json!("1 files"),
            "left out without robot.urdf",
        ),
        (
            request(json!({"robot": {"model": "ur5e", "convention": "modified"}})),
            422,
            "dh_missing",
            "robot.convention",
            json!("modified"),
            "left out without robot.dh",
        ),
        (
            request(json!({"robot": {"model": "ur7"}})),
            422,
            "unknown_robot",
            "robot.model",
            json!("ur7"),
            "ur5e",
        ),
        (
            request(json!({"robot": {"urdf": "<robot name='a'/>"}})),
            422,
            "urdf",
            "robot.urdf",
            json!(null),
            "URDF",
        ),
        (
            region(json!({})),
            422,
            "solid_description",
            "keep_out[0]",
            json!("0 of box, sphere, capsule, cylinder"),
            "exactly one of",
        ),
        (
            object(json!({"center": [0.4, 0, -0.1]})),
            422,
            "object_below_table",
            "object.center[2]",
            json!(-0.1),
            "object.table_z, 0 m",
        ),
    ]
}

fn check(body: &str, refused: &Value, expected: &Case) {
    let (_, status, code, field, value, bound) = expected;
    assert_eq!(refused["status"], *status, "{body}: {refused}");
    assert_eq!(refused["code"], *code, "{body}: {refused}");
    assert_eq!(refused["field"], *field, "{body}: {refused}");
    // What a URDF's parser says is not ours to fix.
    if *code != "urdf" {
        assert_eq!(&refused["value"], value, "{body}: {refused}");
    }
    assert!(refused["bound"].as_str().unwrap().contains(bound), "{body}: {refused}");
    reads_well(body, refused);
}

/// The text names the member and holds no word of the parser.
fn reads_well(body: &str, refused: &Value) {
    let detail = refused["detail"].as_str().unwrap();
    let bound = refused["bound"].as_str().unwrap();
    for word in JARGON {
        assert!(!detail.contains(word) && !bound.contains(word), "{word:?} for {body}: {refused}");
    }
    let field = refused["field"].as_str().unwrap();
    assert!(refused["code"] == "urdf" || detail.contains(field), "{body}: {refused}");
    assert!(detail.len() < 700, "{body}: {refused}");
}

#[tokio::test]
async fn every_bad_plan_is_refused_in_words_an_integrator_knows() {
    let data = tempfile::tempdir().unwrap();
    let server = Server::start(data.path());
    for case in types().into_iter().chain(numbers()).chain(contradictions()) {
        let refused = problem(server.post("/v1/plans", &case.0).await).await;
        println!("{}", refused["detail"].as_str().unwrap());
        check(&case.0.to_string(), &refused, &case);
    }
}

#[tokio::test]
async fn other_routes_name_their_members_as_their_bodies_do() {
    let data = tempfile::tempdir().unwrap();
    let server = Server::start(data.path());
    let plan = server.post_json("/v1/plans", &request(json!({}))).await;
    let pair = |request: Value| json!({"request": request, "plan": plan});
    let execution = |more: Value| with(json!({"plan_id": plan["id"], "object": {"sample": "mug"}}), more);
    let cases: Vec<(&str, Case)> = vec![
        (
            "/v1/checks",
            (
                json!({}),
                422,
                "check_source",
                "body",
                json!("none of them"),
                "either plan_id, or request and plan",
            ),
        ),
        (
            "/v1/checks",
            (
                json!({"plan_id": "0123456789abcdef0123456789abcdef", "plan": plan}),
                422,
                "check_source",
                "body",
                json!("plan_id and plan"),
                "either plan_id",
            ),
        ),
        (
            "/v1/checks",
            (
                pair(object(json!({"radius": -1}))),
                422,
                "out_of_range",
                "request.object.radius",
                json!(-1),
                "from 0.005",
            ),
        ),
        (
            "/v1/checks",
            (
                pair(json!({"view_count": "3"})),
                422,
                "invalid_member",
                "request.view_count",
                json!("3"),
                "a whole number",
            ),
        ),
        (
            "/v1/checks",
            (
                json!({"request": request(json!({})), "plan": {"views": [], "order": []}}),
                422,
                "out_of_range",
                "plan.views",
                json!(0),
                "from 1 to 200 entries",
            ),
        ),
        (
            "/v1/checks",
            (
                json!({"request": request(json!({})), "plan": {"order": []}}),
                422,
                "invalid_member",
                "plan.views",
                json!(null),
                "given",
            ),
        ),
        (
            "/v1/reachability",
            (json!({"view_count": 3}), 422, "missing_member", "robot", json!(null), "given"),
        ),
        (
            "/v1/reachability?elevations=91",
            (request(json!({})), 422, "out_of_range", "elevations", json!(91), "from 1 to 90"),
        ),
        (
            "/v1/reachability?rows=9",
            (request(json!({})), 422, "invalid_query", "rows", json!("9"), "`elevations`"),
        ),
        ("/v1/predictions", (json!({"images": []}), 422, "invalid_member", "object", json!(null), "given")),
        (
            "/v1/executions",
            (
                json!({"plan_id": "nothing", "object": {"sample": "mug"}}),
                404,
                "unknown_plan",
                "plan_id",
                json!("nothing"),
                "the id of a stored plan",
            ),
        ),
        (
            "/v1/executions",
            (
                execution(json!({"object": {"sample": "mugg"}})),
                422,
                "unknown_object",
                "object.sample",
                json!("mugg"),
                "mug",
            ),
        ),
        (
            "/v1/executions",
            (
                execution(json!({"object": {}})),
                422,
                "object_source",
                "object",
                json!({}),
                "exactly one of sample, file and glb",
            ),
        ),
        (
            "/v1/executions",
            (
                execution(json!({"speed_factor": 0})),
                422,
                "out_of_range",
                "speed_factor",
                json!(0),
                "from 0.01 to 100000",
            ),
        ),
        (
            "/v1/executions",
            (
                execution(json!({"background": "blue"})),
                422,
                "invalid_member",
                "background",
                json!("blue"),
                "one of `transparent`, `white`, `black`",
            ),
        ),
    ];
    for (path, case) in cases {
        let refused = problem(server.post(path, &case.0).await).await;
        println!("{}", refused["detail"].as_str().unwrap());
        check(path, &refused, &case);
    }
    for (path, status, code, field, value, bound) in [
        ("/v1/view-spaces/many", 422, "invalid_path", "n", json!("many"), "a whole number"),
        ("/v1/view-spaces/0", 422, "out_of_range", "n", json!(0), "from 1 to 200"),
        ("/v1/view-spaces/5?radius=-1", 422, "out_of_range", "radius", json!(-1), "positive"),
        ("/v1/view-spaces/5?radius=wide", 422, "invalid_query", "radius", json!("wide"), "a number"),
        (
            "/v1/view-spaces/5?max_elevation_deg=100",
            422,
            "out_of_range",
            "max_elevation_deg",
            json!(100),
            "degrees",
        ),
        ("/v1/robots/ur7", 404, "unknown_robot", "model", json!("ur7"), "ur5e"),
        ("/v1/plans/abc", 404, "unknown_plan", "id", json!("abc"), "the id of a stored plan"),
        ("/v1/executions/abc", 404, "unknown_execution", "id", json!("abc"), "the id of a run"),
        ("/v1/executions/abc/images/0", 404, "unknown_execution", "id", json!("abc"), "the id of a run"),
        ("/v1/plan", 404, "no_such_route", "path", json!("/v1/plan"), "a route of"),
    ] {
        let refused = problem(server.get(path).await).await;
        println!("{}", refused["detail"].as_str().unwrap());
        check(path, &refused, &(Value::Null, status, code, field, value, bound));
    }
}

#[tokio::test]
async fn what_is_no_json_is_told_with_its_place() {
    let data = tempfile::tempdir().unwrap();
    let server = Server::start(data.path());
    for (body, field, value, bound) in [
        (r#"{"view_count": 3, "#, "body", "the end", "a whole JSON document"),
        (r#"{"view_count": 3,}"#, "body", "}", "without a comma before"),
        (r#"{'view_count': 3}"#, "body", "'", "double quotes"),
        (r#"{"view_count": 3} {}"#, "body", "{", "nothing behind it"),
        (r#"{"view_count": 1e999}"#, "view_count", "1e999", "64-bit float"),
        (r#"{"view_count": 3, "margin": NaN}"#, "margin", "NaN", "no NaN"),
    ] {
        let refused = problem(server.post_text("/v1/plans", body).await).await;
        println!("{}", refused["detail"].as_str().unwrap());
        assert_eq!(
            (&refused["status"], &refused["code"]),
            (&json!(400), &json!("malformed_json")),
            "{refused}"
        );
        assert_eq!(
            (&refused["field"], &refused["value"]),
            (&json!(field), &json!(value)),
            "{body}: {refused}"
        );
        assert!(refused["bound"].as_str().unwrap().contains(bound), "{body}: {refused}");
        assert!(refused["detail"].as_str().unwrap().contains("line 1, column"), "{refused}");
    }
}

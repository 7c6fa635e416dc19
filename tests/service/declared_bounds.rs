//! The bounds that the API description declares are those that the service keeps: every declared one that a
//! whole request meets is asked for, at it and beyond it.

use serde_json::{Value, json};

use crate::harness::{Server, cell, problem, with};

/// Members whose bound depends on others as well: at the declared one they are refused all the same.
const NARROWER: [&str; 10] = [
    // The arm's joints, and their limits.
    "start",
    "robot.dh",
    "robot.dh[0].min",
    "robot.dh[0].max",
    // What hangs on the flange, and how far from it.
    "tool",
    "camera_body",
    "flange_from_camera",
    // Within the object's sphere; outside it; of norm 1.
    "object.shape",
    "view_space",
    "orientation",
];
/// How far beyond a bound is tried, relatively: more than an elevation's rounding.
const BEYOND: f64 = 1e-6;

/// A declared bound, and values at and beyond it.
struct Case {
    /// The member, as refusals name it.
    path: String,
    pointer: String,
    at: Value,
    beyond: Value,
}

/// Follows references and leaves out null.
fn resolved<'a>(document: &'a Value, schema: &'a Value) -> Vec<&'a Value> {
    if let Some(reference) = schema["$ref"].as_str() {
        return resolved(document, document.pointer(reference.trim_start_matches('#')).unwrap());
    }
    match schema["oneOf"].as_array() {
        Some(variants) => variants.iter().flat_map(|variant| resolved(document, variant)).collect(),
        None => vec![schema],
    }
}

fn walk(
    document: &Value,
    schema: &Value,
    value: &Value,
    (path, pointer): (&str, &str),
    cases: &mut Vec<Case>,
) {
    for schema in resolved(document, schema) {
        let mut case = |at: Value, beyond: Value| {
            cases.push(Case { path: path.to_owned(), pointer: pointer.to_owned(), at, beyond });
        };
        match value {
            Value::Object(members) => {
                for (name, value) in members {
                    let declared = match &schema["properties"][name] {
                        Value::Null => &schema["additionalProperties"],
                        declared => declared,
                    };
                    if declared.is_object() {
                        let path = if path.is_empty() { name.clone() } else { format!("{path}.{name}") };
                        walk(document, declared, value, (&path, &format!("{pointer}/{name}")), cases);
                    }
                }
            }
            Value::Array(items) => {
                let of = |count: u64| Value::Array(vec![items[0].clone(); count as usize]);
                if let Some(least) = schema["minItems"].as_u64().filter(|least| *least > 0) {
                    case(of(least), of(least - 1));
                }
                if let Some(most) = schema["maxItems"].as_u64() {
                    case(of(most), of(most + 1));
                }
                walk(
                    document,
                    &schema["items"],
                    &items[0],
                    (&format!("{path}[0]"), &format!("{pointer}/0")),
                    cases,
                );
            }
            Value::String(_) => {
                if let Some(least) = schema["minLength"].as_u64().filter(|least| *least > 0) {
                    case("x".repeat(least as usize).into(), "".into());
                }
                if let Some(most) = schema["maxLength"].as_u64() {
                    case("x".repeat(most as usize).into(), "x".repeat(most as usize + 1).into());
                }
            }
            Value::Number(_) => {
                for (keyword, outwards) in [("minimum", -1.0), ("maximum", 1.0)] {
                    let Some(bound) = schema[keyword].as_f64() else { continue };
                    if value.is_u64() && schema["format"] == "int32" {
                        case(json!(bound as i64), json!(bound as i64 + outwards as i64));
                    } else {
                        case(json!(bound), json!(bound + outwards * BEYOND * bound.abs().max(BEYOND)));
                    }
                }
                for (keyword, inwards) in [("exclusiveMinimum", 1.0), ("exclusiveMaximum", -1.0)] {
                    let Some(bound) = schema[keyword].as_f64() else { continue };
                    case(json!(bound + inwards * BEYOND * bound.abs().max(BEYOND)), json!(bound));
                }
            }
            _ => {}
        }
    }
}

/// Requests that between them have every member with a bound.
fn requests() -> [Value; 2] {
    let solids = json!([
        {"box": {"center": [0.1, 0.0, 0.0], "size": [0.1, 0.1, 0.1], "orientation": [0.0, 0.0, 0.0, 1.0]}},
        {"sphere": {"center": [0.1, 0.0, 0.0], "radius": 0.1}},
        {"capsule": {"from": [0.1, 0.0, 0.0], "to": [0.2, 0.0, 0.0], "radius": 0.1}},
        {"cylinder": {"center": [0.1, 0.0, 0.0], "radius": 0.1, "height": 0.1, "orientation": [0.0, 0.0, 0.0, 1.0]}},
    ]);
    let mut around = with(
        cell(),
        json!({
            "view_count": 3, "view_space": {"radius": 0.3, "min_elevation_deg": 5.0, "max_elevation_deg": 90.0},
            "start": [0.0, -1.0, 1.0, 0.0, 0.0, 0.0], "margin": 0.01, "roll": "sampled", "roll_samples": 3,
            "timing": {"speed_scale": 1.0, "settle": 0.3, "sample_period": 0.04},
            "limits": {"elbow_joint": {"max_speed": 1.0, "max_acceleration": 1.0, "max_jerk": 1.0}},
            "tool": [solids[0]], "camera_body": [solids[1]],
        }),
    );
    around["camera"]["distortion"] = json!([0.0, 0.0, 0.0, 0.0, 0.0]);
    around["object"]["shape"] = json!({"cylinder": {"radius": 0.05, "height": 0.1}});
    around["keep_out"] = json!([{"name": "post", "box": solids[0]["box"]}]);
    let row = json!({"d": 0.1, "a": 0.2, "alpha": 1.0, "theta": 0.0, "min": -3.0, "max": 3.0,
                     "max_speed": 1.0, "max_acceleration": 1.0});
    let mut described = with(cell(), json!({"view_count": 3, "robot": {"dh": vec![row; 6]}}));
    described["object"]["shape"] = json!({"box": {"size": [0.1, 0.1, 0.1], "yaw": 0.0}});
    let solid = |index: usize| with(json!({"name": "post"}), solids[index].clone());
    described["keep_out"] = json!([solid(1)]);
    described["tool"] = json!([solids[2]]);
    described["camera_body"] = json!([solids[3]]);
    [around, described]
}

/// A check looks at a request's numbers and plans nothing.
async fn refusal(server: &Server, request: &Value, case: &Case, value: &Value) -> Option<Value> {
    let mut request = request.clone();
    *request.pointer_mut(&case.pointer).unwrap() = value.clone();
    let plan = json!({"order": [], "views": [
        {"id": 0, "status": "skipped", "pose": {"position": [0.45, 0.0, 0.45], "orientation": [1.0, 0.0, 0.0, 0.0]}}]});
    let response = server.post("/v1/checks", &json!({"request": request, "plan": plan})).await;
    if response.status() == 200 { None } else { Some(problem(response).await) }
}

#[tokio::test]
async fn what_is_declared_is_what_is_kept() {
    let data = tempfile::tempdir().unwrap();
    let server = Server::start(data.path());
    let document = server.get_json("/openapi.json").await;
    let schema = &document["components"]["schemas"]["PlanRequest"];
    let mut seen = std::collections::BTreeSet::new();
    for request in requests() {
        let mut cases = Vec::new();
        walk(&document, schema, &request, ("", ""), &mut cases);
        for case in cases {
            seen.insert(case.path.clone());
            let refused = refusal(&server, &request, &case, &case.beyond).await;
            let refused = refused.unwrap_or_else(|| panic!("{} may be {}", case.path, case.beyond));
            let field = refused["field"].as_str().unwrap().trim_start_matches("request.");
            assert_eq!(refused["status"], 422, "{refused}");
            assert!(case.path.starts_with(field), "{} is {}: {refused}", case.path, case.beyond);
            if NARROWER.iter().any(|narrower| case.path.contains(narrower)) {
                continue;
            }
            if let Some(refused) = refusal(&server, &request, &case, &case.at).await {
                let field = refused["field"].as_str().unwrap().trim_start_matches("request.");
                assert_ne!(field, case.path, "at {}: {refused}", case.at);
            }
        }
    }
    assert!(seen.len() >= 60, "{seen:?}");
}

#[tokio::test]
async fn parameters_and_speed_factors_are_kept_as_declared() {
    let data = tempfile::tempdir().unwrap();
    let server = Server::start(data.path());
    let document = server.get_json("/openapi.json").await;
    let declared = |path: &str, method: &str, name: &str| -> Value {
        let parameters = document["paths"][path][method]["parameters"].as_array().unwrap();
        parameters.iter().find(|parameter| parameter["name"] == name).unwrap()["schema"].clone()
    };
    let most = declared("/v1/view-spaces/{n}", "get", "n")["maximum"].as_u64().unwrap();
    assert_eq!(problem(server.get(&format!("/v1/view-spaces/{}", most + 1)).await).await["field"], "n");
    for (name, beyond) in [("min_elevation_deg", "-90.001"), ("max_elevation_deg", "90.001")] {
        let bounds = declared("/v1/view-spaces/{n}", "get", name);
        assert_eq!((bounds["minimum"].as_f64(), bounds["maximum"].as_f64()), (Some(-90.0), Some(90.0)));
        let refused = problem(server.get(&format!("/v1/view-spaces/3?{name}={beyond}")).await).await;
        assert_eq!(refused["field"], name);
    }
    for name in ["elevations", "azimuths"] {
        let most = declared("/v1/reachability", "post", name)["maximum"].as_u64().unwrap();
        let path = format!("/v1/reachability?{name}={}", most + 1);
        assert_eq!(problem(server.post(&path, &cell()).await).await["field"], name);
    }
    let plan = server.post_json("/v1/plans", &json!({"view_count": 1})).await;
    let bounds = &document["components"]["schemas"]["CreateExecution"]["properties"]["speed_factor"];
    for (keyword, factor) in [("minimum", 0.99), ("maximum", 1.01)] {
        let at = bounds[keyword].as_f64().unwrap();
        let run =
            |speed: f64| json!({"plan_id": plan["id"], "object": {"sample": "mug"}, "speed_factor": speed});
        let refused = problem(server.post("/v1/executions", &run(factor * at)).await).await;
        assert_eq!(refused["field"], "speed_factor");
        assert_eq!(server.post("/v1/executions", &run(at)).await.status(), 202);
    }
}

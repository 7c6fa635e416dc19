//! Bad input of a plan: every refusal names the field, the value and the bound.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde_json::{Value, json};

use crate::harness::{Server, cell, problem, with};

/// What a request is refused with.
struct Refusal {
    body: Value,
    status: u64,
    code: &'static str,
    field: &'static str,
    value: Value,
    bound: &'static str,
}

fn refusal(
    body: Value,
    code: &'static str,
    field: &'static str,
    value: impl Into<Value>,
    bound: &'static str,
) -> Refusal {
    Refusal { body, status: 422, code, field, value: value.into(), bound }
}

async fn check(server: &Server, expected: Refusal) {
    let name = format!("{} at {}", expected.code, expected.field);
    let problem = problem(server.post("/v1/plans", &expected.body).await).await;
    assert_eq!(problem["status"], expected.status, "{name}: {problem}");
    assert_eq!(problem["code"], expected.code, "{name}: {problem}");
    assert_eq!(problem["field"], expected.field, "{name}: {problem}");
    assert_eq!(problem["value"], expected.value, "{name}: {problem}");
    let bound = problem["bound"].as_str().unwrap();
    assert!(bound.contains(expected.bound), "{name}: {bound}");
}

/// `cell()` for a number of views, one member replaced by a JSON pointer.
fn changed(pointer: &str, value: impl Into<Value>) -> Value {
    let mut body = with(cell(), json!({"view_count": 5, "view_space": {"radius": 0.3}}));
    *body.pointer_mut(pointer).unwrap_or_else(|| panic!("{pointer}")) = value.into();
    body
}

#[tokio::test]
async fn numbers_out_of_their_bounds_are_named() {
    let data = tempfile::tempdir().unwrap();
    let server = Server::start(data.path());
    let cases = [
        refusal(changed("/object/radius", -0.1), "out_of_range", "object.radius", -0.1, "from 0.005 to 1 m"),
        refusal(changed("/object/radius", 0.0), "out_of_range", "object.radius", 0, "from 0.005 to 1 m"),
        refusal(
            changed("/object/radius", 1e300),
            "out_of_range",
            "object.radius",
            1e300,
            "from 0.005 to 1 m",
        ),
        refusal(changed("/object/radius", 100.0), "millimetres", "object.radius", 100, "100 mm are 0.1 m"),
        refusal(
            changed("/object/center/0", 450.0),
            "millimetres",
            "object.center[0]",
            450,
            "450 mm are 0.45 m",
        ),
        refusal(
            changed("/object/center/2", -0.2),
            "object_below_table",
            "object.center[2]",
            -0.2,
            "object.table_z, 0 m",
        ),
        refusal(changed("/view_space/radius", 300.0), "millimetres", "view_space.radius", 300, "0.3 m"),
        refusal(
            changed("/view_space/radius", 0.1),
            "camera_inside_object",
            "view_space.radius",
            0.1,
            "1.05 times object.radius, 0.105",
        ),
        refusal(changed("/view_count", 0), "out_of_range", "view_count", 0, "from 1 to 200"),
        refusal(changed("/view_count", 201), "out_of_range", "view_count", 201, "from 1 to 200"),
        refusal(changed("/camera/fx", -1.0), "out_of_range", "camera.fx", -1, "greater than 0"),
        refusal(changed("/camera/width", 40000), "out_of_range", "camera.width", 40000, "1 to 16384"),
        refusal(
            changed("/flange_from_camera/orientation", json!([0.0, 0.0, 0.0, 0.5])),
            "non_unit_quaternion",
            "flange_from_camera.orientation",
            json!([0, 0, 0, 0.5]),
            "norm 1",
        ),
        refusal(
            changed("/flange_from_camera/position/2", 50.0),
            "millimetres",
            "flange_from_camera.position[2]",
            50,
            "millimetres?",
        ),
        refusal(changed("/robot/model", "ur7"), "unknown_robot", "robot.model", "ur7", "ur5e"),
    ];
    for case in cases {
        check(&server, case).await;
    }
    let band = json!({"view_space": {"min_elevation_deg": 95.0}, "view_count": 5});
    check(&server, refusal(band, "out_of_range", "view_space.min_elevation_deg", 95, "-90 to 90")).await;
    let band = json!({"view_space": {"min_elevation_deg": 50.0, "max_elevation_deg": 40.0}, "view_count": 5});
    check(&server, refusal(band, "out_of_range", "view_space.max_elevation_deg", 40, "50 degrees")).await;
    let start = with(changed("/view_count", 5), json!({"start": [0.0, 0.0, 9.0, 0.0, 0.0, 0.0]}));
    check(
        &server,
        refusal(start, "joint_limit", "start[2]", 9, "at most 3.1416 rad, the limit of elbow_joint"),
    )
    .await;
    let start = with(changed("/view_count", 5), json!({"start": [0.0, 0.0]}));
    check(&server, refusal(start, "joint_count", "start", 2, "6 joint angles")).await;
}

#[tokio::test]
async fn members_that_contradict_each_other_are_named() {
    let data = tempfile::tempdir().unwrap();
    let server = Server::start(data.path());
    check(&server, refusal(json!({}), "view_source", "images", "none of them", "exactly one of")).await;
    let both = json!({"view_count": 5, "views": "initial"});
    check(&server, refusal(both, "view_source", "view_count", "view_count and views", "exactly one of"))
        .await;
    let no_object = json!({"view_count": 5, "robot": {"model": "ur5e"}});
    check(&server, refusal(no_object, "missing_member", "object", Value::Null, "given with a robot")).await;
    let no_robot = json!({"view_count": 5, "start": [0.0]});
    check(&server, refusal(no_robot, "robot_missing", "start", json!([0]), "without robot")).await;
    let two = changed("/robot", json!({"model": "ur5e", "urdf": "<robot/>"}));
    check(&server, refusal(two, "robot_description", "robot", "2 of model, dh, urdf", "exactly one")).await;
    let urdf = changed("/robot", json!({"urdf": "no robot"}));
    let refused = problem(server.post("/v1/plans", &urdf).await).await;
    assert_eq!((&refused["code"], &refused["field"]), (&json!("urdf"), &json!("robot.urdf")));
}

#[tokio::test]
async fn images_that_are_none_are_named() {
    let data = tempfile::tempdir().unwrap();
    let server = Server::start(data.path());
    let with_images = |images: Value| with(cell(), json!({"images": images}));
    check(&server, refusal(with_images(json!([])), "image_count", "images", 0, "1 to 5")).await;
    let six = with_images(json!(["", "", "", "", "", ""]));
    check(&server, refusal(six, "image_count", "images", 6, "1 to 5")).await;
    let text = with_images(json!(["not base64!"]));
    check(&server, refusal(text, "not_base64", "images[0]", "not base64!", "standard base64")).await;
    let gif = with_images(json!([STANDARD.encode("GIF89a..")]));
    check(
        &server,
        refusal(gif, "not_an_image", "images[0]", "8 bytes starting 47 49 46 38 39 61 2e 2e", "PNG or JPEG"),
    )
    .await;
    let empty = with_images(json!([""]));
    check(&server, refusal(empty, "not_an_image", "images[0]", "0 bytes", "PNG or JPEG")).await;
    let png = png(2, 2);
    let cut = with_images(json!([STANDARD.encode(&png[..40])]));
    let refused = problem(server.post("/v1/plans", &cut).await).await;
    assert_eq!((&refused["code"], &refused["field"]), (&json!("broken_image"), &json!("images[0]")));
    let small = with_images(json!([STANDARD.encode(&png)]));
    check(&server, refusal(small, "image_size", "images[0]", "2x2 pixels", "320x180 pixels")).await;
    let huge = with_images(json!([STANDARD.encode(huge_png())]));
    check(
        &server,
        refusal(
            huge,
            "too_many_pixels",
            "images[0]",
            "40000x40000 = 1600000000 pixels",
            "at most 25000000 pixels",
        ),
    )
    .await;
    let predictions = json!({"images": ["AAAA"], "object": {"center": [0.4, 0.0, 0.1], "radius": 0.1}});
    let refused = problem(server.post("/v1/predictions", &predictions).await).await;
    assert_eq!((&refused["code"], &refused["field"]), (&json!("not_an_image"), &json!("images[0]")));
}

#[tokio::test]
async fn documents_that_are_no_request_are_problems_too() {
    let data = tempfile::tempdir().unwrap();
    let server = Server::start(data.path());
    let cases = [
        (
            r#"{"view_count": 5, "object": {"center": [0.4, 0.0, NaN], "radius": 0.1}}"#,
            400,
            "malformed_json",
            "object.center[2]",
            json!("NaN"),
        ),
        (
            r#"{"view_count": 5, "object": {"center": [0.4, 0.0, 0.1], "radius": -Infinity}}"#,
            400,
            "malformed_json",
            "object.radius",
            json!("-Infinity"),
        ),
        (
            r#"{"view_count": 5, "object": {"center": [0.4, 0.0, 0.1], "radius": 1e999}}"#,
            400,
            "malformed_json",
            "object.radius",
            json!("1e999"),
        ),
        (r#"{"view_count": -5}"#, 422, "invalid_member", "view_count", json!(-5)),
        (r#"{"view_count": "many"}"#, 422, "invalid_member", "view_count", json!("many")),
        (r#"{"view_count": 5, "viewcount": 6}"#, 422, "invalid_member", "viewcount", json!(6)),
        (
            r#"{"view_count": 5, "object": {"radius": 0.1}}"#,
            422,
            "invalid_member",
            "object.center",
            json!(null),
        ),
        (r#"{"view_count": 5, "roll": "sideways"}"#, 422, "invalid_member", "roll", json!("sideways")),
        (r#"[]"#, 422, "invalid_member", "body", json!([])),
        ("", 400, "malformed_json", "body", json!("the end")),
    ];
    for (body, status, code, field, value) in cases {
        let refused = problem(server.post_text("/v1/plans", body).await).await;
        assert_eq!(refused["status"], status, "{body}: {refused}");
        assert_eq!(refused["code"], code, "{body}: {refused}");
        assert_eq!(refused["field"], field, "{body}: {refused}");
        assert_eq!(refused["value"], value, "{body}: {refused}");
        assert!(refused["bound"].is_string(), "{body}: {refused}");
    }
    let url = format!("{}/v1/plans", server.url);
    let untyped = problem(server.client.post(&url).body("{}").send().await.unwrap()).await;
    assert_eq!(
        (untyped["status"].as_u64(), untyped["code"].as_str()),
        (Some(415), Some("unsupported_media_type"))
    );
    let wrong_method = problem(server.client.delete(&url).send().await.unwrap()).await;
    assert_eq!(
        (wrong_method["status"].as_u64(), wrong_method["value"].as_str()),
        (Some(405), Some("DELETE"))
    );
    let nowhere = problem(server.get("/v2/plans").await).await;
    assert_eq!((nowhere["status"].as_u64(), nowhere["value"].as_str()), (Some(404), Some("/v2/plans")));
}

#[tokio::test]
async fn a_body_that_is_packed_or_in_another_charset_is_refused_by_its_header() {
    let data = tempfile::tempdir().unwrap();
    let server = Server::start(data.path());
    for (name, value, field, bound) in [
        ("content-encoding", "gzip", "Content-Encoding", "not unpacked"),
        ("content-type", "application/json; charset=iso-8859-1", "Content-Type", "UTF-8"),
        ("content-type", "text/plain", "Content-Type", "application/json"),
    ] {
        let request = server.client.post(format!("{}/v1/plans", server.url)).body(r#"{"view_count": 3}"#);
        let typed =
            if name == "content-type" { request } else { request.header("content-type", "application/json") };
        let refused = problem(typed.header(name, value).send().await.unwrap()).await;
        assert_eq!((&refused["status"], &refused["field"]), (&json!(415), &json!(field)), "{refused}");
        assert_eq!(refused["value"], value);
        assert!(refused["bound"].as_str().unwrap().contains(bound), "{refused}");
    }
    let request = server.client.post(format!("{}/v1/plans", server.url)).body(r#"{"view_count": 3}"#);
    let typed = request.header("content-type", "application/json; charset=UTF-8");
    assert_eq!(typed.header("content-encoding", "identity").send().await.unwrap().status(), 201);
}

#[tokio::test]
async fn a_body_over_32_mib_is_refused_with_the_bound() {
    let data = tempfile::tempdir().unwrap();
    let server = Server::start(data.path());
    let body = format!(r#"{{"images": ["{}"]}}"#, "A".repeat(33 << 20));
    let length = body.len();
    let refused = problem(server.post_text("/v1/plans", body).await).await;
    assert_eq!(refused["status"], 413);
    assert_eq!(refused["code"], "body_too_large");
    assert_eq!(refused["value"], length);
    assert!(refused["bound"].as_str().unwrap().contains("33554432 bytes"));
    assert!(refused["detail"].as_str().unwrap().contains("at most 33554432 bytes"));
    // The service is none the worse for it.
    assert_eq!(server.get_json("/livez").await["status"], "ok");
}

fn png(width: u32, height: u32) -> Vec<u8> {
    let mut bytes = std::io::Cursor::new(Vec::new());
    image::RgbaImage::new(width, height).write_to(&mut bytes, image::ImageFormat::Png).unwrap();
    bytes.into_inner()
}

/// The beginning of a PNG of 40,000 x 40,000 pixels, its header's checksum right.
fn huge_png() -> Vec<u8> {
    let mut bytes = b"\x89PNG\r\n\x1a\n\x00\x00\x00\x0dIHDR".to_vec();
    bytes.extend([0, 0, 0x9c, 0x40, 0, 0, 0x9c, 0x40, 8, 2, 0, 0, 0]);
    let crc = !bytes[12..].iter().fold(!0u32, |crc, byte| {
        (0..8).fold(crc ^ u32::from(*byte), |c, _| (c >> 1) ^ (0xedb8_8320 & 0u32.wrapping_sub(c & 1)))
    });
    bytes.extend(crc.to_be_bytes());
    bytes.extend(b"\x00\x00\x00\x00IDAT\x35\xaf\x06\x1e");
    bytes
}

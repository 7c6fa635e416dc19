//! The same request gives the same plan.

use serde_json::{Value, json};

use crate::harness::{Server, cell, with, without_timings};

#[tokio::test]
async fn the_same_request_gives_the_same_bytes_here_and_elsewhere() {
    let (here, elsewhere) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    let server = Server::start(here.path());
    let request = with(cell(), json!({"view_count": 12}));
    // Two at a time: both are answered with what was stored first.
    let (a, b) = tokio::join!(server.post("/v1/plans", &request), server.post("/v1/plans", &request));
    let (a, b) = (a.bytes().await.unwrap(), b.bytes().await.unwrap());
    assert_eq!(a, b);
    // Spaces, the order of members and defaults that are spelt out make no other request.
    let spelt_out = format!(
        r#"{{ "roll": "fixed", "view_space": {{"radius": 0.3, "max_elevation_deg": 90}},
             "robot": {}, "object": {}, "camera": {}, "flange_from_camera": {}, "view_count": 12 }}"#,
        request["robot"], request["object"], request["camera"], request["flange_from_camera"]
    );
    let c = server.post_text("/v1/plans", spelt_out).await;
    assert_eq!(c.status(), 200);
    assert_eq!(c.bytes().await.unwrap(), a);

    let other = Server::start_with(elsewhere.path(), &["--workers", "1"]);
    let d = other.post("/v1/plans", &request).await.bytes().await.unwrap();
    let parse = |bytes: &[u8]| without_timings(serde_json::from_slice::<Value>(bytes).unwrap());
    assert_eq!(parse(&a).to_string(), parse(&d).to_string());
    let different = server.post_json("/v1/plans", &with(request, json!({"view_count": 13}))).await;
    assert_ne!(different["id"], parse(&a)["id"]);
}

//! The committed OpenAPI document is the one that the service serves.

use std::path::Path;
use std::process::Command;

use serde_json::Value;

use crate::harness::{PRV, Server};

#[tokio::test]
async fn the_committed_document_is_the_printed_and_the_served_one() {
    let printed = String::from_utf8(Command::new(PRV).arg("openapi").output().unwrap().stdout).unwrap();
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("openapi/openapi.json");
    let committed = std::fs::read_to_string(path).unwrap();
    assert!(committed == printed, "run: prv openapi > openapi/openapi.json");
    let data = tempfile::tempdir().unwrap();
    let server = Server::start(data.path());
    assert_eq!(server.get("/openapi.json").await.text().await.unwrap(), printed);
    let docs = server.get("/docs/").await;
    assert!(docs.status().is_success());
    let page = docs.text().await.unwrap();
    assert!(
        page.contains("swagger-ui") && !page.contains("https://"),
        "the page needs nothing from elsewhere"
    );
}

#[test]
fn every_operation_tells_what_it_answers() {
    let printed = Command::new(PRV).arg("openapi").output().unwrap().stdout;
    let document: Value = serde_json::from_slice(&printed).unwrap();
    let paths = document["paths"].as_object().unwrap();
    for path in [
        "/v1/plans",
        "/v1/plans/{id}",
        "/v1/predictions",
        "/v1/view-spaces/{n}",
        "/v1/robots",
        "/livez",
        "/readyz",
    ] {
        assert!(paths.contains_key(path), "{path}");
    }
    let mut names = std::collections::BTreeSet::new();
    for (path, methods) in paths {
        for (method, operation) in methods.as_object().unwrap() {
            assert!(
                names.insert(operation["operationId"].as_str().unwrap()),
                "{method} {path} has another's name"
            );
            for refusal in ["422", "500"] {
                assert!(operation["responses"][refusal].is_object(), "{refusal} of {method} {path}");
            }
            assert!(operation["summary"].is_string(), "{method} {path}");
            assert!(!operation["responses"].as_object().unwrap().is_empty(), "{method} {path}");
        }
    }
}

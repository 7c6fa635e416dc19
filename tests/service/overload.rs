//! More requests than there are places.

use serde_json::json;

use crate::harness::{Server, problem};

#[tokio::test]
async fn a_full_service_says_when_to_come_back_and_stays_alive() {
    let data = tempfile::tempdir().unwrap();
    let server = Server::start_with(data.path(), &["--workers", "1", "--queue", "0"]);
    // Bands without a table are computed: each takes the one worker for a while.
    for minimum in 1..40 {
        let slow = format!("{}/v1/view-spaces/120?min_elevation_deg={}.5", server.url, minimum);
        let slow = tokio::spawn(server.client.get(slow).send());
        while !slow.is_finished() {
            let response = server.post("/v1/plans", &json!({"view_count": 1})).await;
            if response.status() != 503 {
                continue;
            }
            let wait: u32 = response.headers()["retry-after"].to_str().unwrap().parse().unwrap();
            assert!(wait > 0);
            assert_eq!(problem(response).await["code"], "overloaded");
            assert_eq!(server.get_json("/livez").await["status"], "ok");
            assert_eq!(slow.await.unwrap().unwrap().status(), 200, "what was admitted is answered");
            return;
        }
    }
    panic!("no request met a busy worker");
}

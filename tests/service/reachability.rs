//! Which part of the band an arm can reach.

use std::process::Command;

use serde_json::{Value, json};

use crate::harness::{PRV, Server, cell, problem, with, without_timings};

#[tokio::test]
async fn every_cell_of_the_band_is_ok_or_has_its_reason() {
    let data = tempfile::tempdir().unwrap();
    let server = Server::start(data.path());
    let answer = server.post_json("/v1/reachability?elevations=9&azimuths=24", &cell()).await;
    let grid: Vec<Vec<&str>> = answer["grid"].as_array().unwrap().iter().map(row).collect();
    assert_eq!((grid.len(), grid[0].len()), (9, 24));
    let ok = grid.iter().flatten().filter(|code| **code == "ok").count();
    assert_eq!(answer["counts"]["ok"], ok);
    let counted: u64 = answer["counts"].as_object().unwrap().values().map(|n| n.as_u64().unwrap()).sum();
    assert_eq!(counted, 9 * 24);
    for (row, part) in grid.iter().zip(answer["by_elevation"].as_array().unwrap()) {
        let reached = row.iter().filter(|code| **code == "ok").count() as f64 / 24.0;
        assert!((part["reachable_fraction"].as_f64().unwrap() - reached).abs() < 1e-12);
    }
    let columns = answer["by_azimuth"].as_array().unwrap();
    let mean = columns.iter().map(|c| c["reachable_fraction"].as_f64().unwrap()).sum::<f64>() / 24.0;
    assert!((answer["reachable_fraction"].as_f64().unwrap() - mean).abs() < 1e-9);
    // A plan of views in the same band agrees: what it skips, it skips with a code of the grid.
    let skip = with(cell(), json!({"view_count": 60, "unreachable_views": "skip"}));
    let plan = server.post_json("/v1/plans", &skip).await;
    let planned = plan["order"].as_array().unwrap().len() as f64 / 60.0;
    assert!((planned - answer["reachable_fraction"].as_f64().unwrap()).abs() < 0.15, "{planned} {answer}");
}

fn row(row: &Value) -> Vec<&str> {
    row.as_array().unwrap().iter().map(|code| code.as_str().unwrap()).collect()
}

#[tokio::test]
async fn an_object_too_far_away_gets_places_that_serve_it_better() {
    let data = tempfile::tempdir().unwrap();
    let server = Server::start(data.path());
    let far = with(cell(), json!({"object": {"center": [0.95, 0.3, 0.15], "radius": 0.1, "table_z": 0.0}}));
    let answer = server.post_json("/v1/reachability", &far).await;
    let given = answer["given"]["reachable_fraction"].as_f64().unwrap();
    assert!((given - answer["reachable_fraction"].as_f64().unwrap()).abs() < 0.1, "{answer}");
    let places = answer["suggestions"].as_array().unwrap();
    assert!(!places.is_empty() && places.len() <= 3);
    let mut last = 1.0;
    for (index, place) in places.iter().enumerate() {
        let fraction = place["reachable_fraction"].as_f64().unwrap();
        assert!(fraction > given && fraction <= last, "{places:?}");
        last = fraction;
        assert_eq!(place["center"][2], 0.15);
        for other in &places[..index] {
            let d = |k: usize| place["center"][k].as_f64().unwrap() - other["center"][k].as_f64().unwrap();
            assert!(d(0).hypot(d(1)) >= 0.05, "{places:?}");
        }
        // Asked about itself, the place is as good as promised.
        let object = json!({"center": place["center"], "radius": 0.1, "table_z": 0.0});
        let there = server.post_json("/v1/reachability", &with(cell(), json!({"object": object}))).await;
        assert!((there["given"]["reachable_fraction"].as_f64().unwrap() - fraction).abs() < 1e-9);
    }
    let again = server.post_json("/v1/reachability", &far).await;
    assert_eq!(without_timings(again), without_timings(answer));
}

#[tokio::test]
async fn a_place_in_a_keep_out_region_is_not_suggested() {
    let data = tempfile::tempdir().unwrap();
    let server = Server::start(data.path());
    // Everything but a strip on the left is taken, flat enough for the arm to work above it.
    let floor = json!([{"name": "bench", "box": {"center": [0.0, -0.9, 0.06], "size": [3.0, 2.0, 0.1]}}]);
    let request =
        with(cell(), json!({"keep_out": floor, "object": {"center": [0.0, 0.9, 0.08], "radius": 0.07}}));
    let answer = server.post_json("/v1/reachability", &request).await;
    for place in answer["suggestions"].as_array().unwrap() {
        assert!(place["center"][1].as_f64().unwrap() > 0.1 + 0.07, "{place}");
    }
}

#[tokio::test]
async fn what_cannot_be_asked_is_refused_with_its_bound() {
    let data = tempfile::tempdir().unwrap();
    let server = Server::start(data.path());
    let no_robot = json!({"object": {"center": [0.4, 0.0, 0.1], "radius": 0.1}});
    let refused = problem(server.post("/v1/reachability", &no_robot).await).await;
    assert_eq!((&refused["code"], &refused["field"]), (&json!("missing_member"), &json!("robot")));
    for (query, field) in [
        ("elevations=0", "elevations"),
        ("azimuths=361", "azimuths"),
        ("elevations=90&azimuths=300", "azimuths"),
    ] {
        let refused = problem(server.post(&format!("/v1/reachability?{query}"), &cell()).await).await;
        assert_eq!((&refused["code"], &refused["field"]), (&json!("out_of_range"), &json!(field)), "{query}");
    }
    let refused = problem(server.post("/v1/reachability?rows=3", &cell()).await).await;
    assert_eq!((refused["status"].as_u64(), &refused["field"]), (Some(422), &json!("rows")));
}

#[tokio::test]
async fn the_command_draws_the_band() {
    let data = tempfile::tempdir().unwrap();
    let file = data.path().join("request.json");
    std::fs::write(&file, cell().to_string()).unwrap();
    let reach = |flags: &[&str]| {
        let output = Command::new(PRV).arg("reach").arg(&file).args(flags).output().unwrap();
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        String::from_utf8(output.stdout).unwrap()
    };
    let map = reach(&["--elevations", "5", "--azimuths", "40"]);
    let rows: Vec<&str> =
        map.lines().filter_map(|line| line.split(' ').find(|word| word.len() == 40)).collect();
    assert_eq!(rows.len(), 5, "{map}");
    let dots = rows.iter().flat_map(|row| row.chars()).filter(|letter| *letter == '.').count();
    assert!(map.contains(&format!(". ok: {dots}")), "{map}");
    let server = Server::start(data.path());
    let printed: Value = serde_json::from_str(&reach(&["--json"])).unwrap();
    let answered = server.post_json("/v1/reachability", &cell()).await;
    assert_eq!(without_timings(printed), without_timings(answered));
}

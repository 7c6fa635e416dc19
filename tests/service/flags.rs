//! Flags of the command line and their environment variables.

use std::process::{Command, Output};

use serde_json::Value;

use crate::harness::PRV;

fn views(json: &str) -> Output {
    Command::new(PRV).args(["views", "3"]).env("PRV_JSON", json).output().unwrap()
}

#[test]
fn the_environment_turns_flags_on_and_off_as_people_write_it() {
    for on in ["1", "true", "yes", "on"] {
        let printed = views(on).stdout;
        assert!(serde_json::from_slice::<Value>(&printed).is_ok(), "{on}");
    }
    for off in ["0", "false", "no"] {
        let output = views(off);
        assert!(output.status.success(), "{off}");
        assert!(serde_json::from_slice::<Value>(&output.stdout).is_err(), "{off}");
    }
    assert_eq!(views("perhaps").status.code(), Some(2));
}

#[test]
fn an_objects_directory_that_is_none_is_refused_at_the_start() {
    let data = tempfile::tempdir().unwrap();
    let file = data.path().join("mug.obj");
    std::fs::write(&file, "").unwrap();
    for none in [data.path().join("missing"), file] {
        let output = Command::new(PRV)
            .args(["serve", "--listen", "127.0.0.1:0", "--data-dir"])
            .arg(data.path().join("data"))
            .arg("--objects-dir")
            .arg(&none)
            .output()
            .unwrap();
        assert_eq!(output.status.code(), Some(1));
        let text = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(text.contains("objects directory") && text.contains(none.to_str().unwrap()), "{text}");
    }
}

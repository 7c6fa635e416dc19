//! The README's sessions run as they are written.

use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Command, Stdio};

/// What stands before and after the blocks to run with a service.
const CURL: &str = "<!-- curl-session -->";
/// What stands before and after the blocks to run without.
const SHELL: &str = "<!-- shell-session -->";

/// The `sh` blocks between two lines `marker`, one script.
fn session(readme: &str, marker: &str) -> String {
    let parts: Vec<&str> = readme.split(marker).collect();
    assert_eq!(parts.len(), 3, "README.md holds its session between two lines {marker}");
    let mut script = String::new();
    let mut inside = false;
    for line in parts[1].lines() {
        match line.trim_end() {
            "```sh" => inside = true,
            "```" => inside = false,
            _ if inside => script.extend([line, "\n"]),
            _ => {}
        }
    }
    assert!(!script.is_empty(), "the session is empty");
    script
}

#[test]
fn the_session_in_the_readme_runs_as_written() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let readme = std::fs::read_to_string(root.join("README.md")).unwrap();
    let directory = tempfile::tempdir().unwrap();
    let mut server = Command::new(env!("CARGO_BIN_EXE_prv"))
        .args(["serve", "--listen", "127.0.0.1:0", "--log", "warn", "--data-dir"])
        .arg(directory.path().join("data"))
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let mut line = String::new();
    BufReader::new(server.stdout.take().unwrap()).read_line(&mut line).unwrap();
    let url = line.split_whitespace().find(|word| word.starts_with("http://")).unwrap().to_owned();
    let output = Command::new("bash")
        .args(["-euo", "pipefail", "-c", &session(&readme, CURL)])
        .current_dir(directory.path())
        .env("PRV_URL", url)
        .output();
    server.kill().unwrap();
    server.wait().unwrap();
    let output = output.unwrap();
    let (out, err) = (String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    assert!(output.status.success(), "{out}\n{err}");
    for file in ["plan.json", "scan/transforms.json"] {
        assert!(directory.path().join(file).is_file(), "{file} is what the session ends with\n{out}\n{err}");
    }
    assert!(directory.path().join("scan/images").read_dir().unwrap().count() > 3, "photos\n{out}\n{err}");
}

#[test]
fn the_commands_of_the_picture_draw_it() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let readme = std::fs::read_to_string(root.join("README.md")).unwrap();
    let directory = tempfile::tempdir().unwrap();
    let cell = "examples/walled_cell.json";
    for folder in ["examples", "docs"] {
        std::fs::create_dir(directory.path().join(folder)).unwrap();
    }
    std::fs::copy(root.join(cell), directory.path().join(cell)).unwrap();
    let programs = Path::new(env!("CARGO_BIN_EXE_prv")).parent().unwrap().display();
    let output = Command::new("bash")
        .args(["-euo", "pipefail", "-c", &session(&readme, SHELL)])
        .current_dir(directory.path())
        .env("PATH", format!("{programs}:{}", std::env::var("PATH").unwrap()))
        .output()
        .unwrap();
    let (out, err) = (String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    assert!(output.status.success(), "{out}\n{err}");
    let planned = |plan: &str| {
        let plan = std::fs::read(directory.path().join(plan)).unwrap();
        let plan: serde_json::Value = serde_json::from_slice(&plan).unwrap();
        plan["order"].as_array().unwrap().len()
    };
    let (left, right) = (planned("skip_plan.json"), planned("adapted_plan.json"));
    assert!(left < 30 && right == 35, "{left} and {right} views: the cell no longer shows anything");
    let picture = std::fs::read_to_string(directory.path().join("docs/adaptive_views.svg")).unwrap();
    assert_eq!(picture.matches("class=\"number\"").count(), left + right);
}

//! A spawned service and its client.

use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::Duration;

use reqwest::{Client, Response};
use serde_json::{Value, json};

/// The executable under test.
pub const PRV: &str = env!("CARGO_BIN_EXE_prv");

/// Longest time for anything a test waits for.
const PATIENCE: Duration = Duration::from_secs(120);

/// A running service; killed on drop.
pub struct Server {
    child: Child,
    pub url: String,
    pub client: Client,
}

impl Server {
    /// Starts the service on a free port.
    pub fn start(data: &Path) -> Self {
        Self::start_with(data, &[])
    }

    /// Starts it with further flags.
    pub fn start_with(data: &Path, flags: &[&str]) -> Self {
        let mut child = Command::new(PRV)
            .args(["serve", "--listen", "127.0.0.1:0", "--log", "warn", "--data-dir"])
            .arg(data)
            .args(flags)
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        let mut line = String::new();
        BufReader::new(child.stdout.take().unwrap()).read_line(&mut line).unwrap();
        let url = line.split_whitespace().find(|word| word.starts_with("http://"));
        let url = url.unwrap_or_else(|| panic!("no address in {line:?}")).to_owned();
        let client = Client::builder().timeout(PATIENCE).build().unwrap();
        Self { child, url, client }
    }

    /// Ends the service as an operator would; returns its exit code.
    pub fn terminate(mut self) -> Option<i32> {
        let status = Command::new("kill").arg(self.child.id().to_string()).status().unwrap();
        assert!(status.success());
        self.child.wait().unwrap().code()
    }

    /// Ends the service as a power cut would.
    pub fn kill(mut self) {
        self.child.kill().unwrap();
        self.child.wait().unwrap();
    }

    pub async fn get(&self, path: &str) -> Response {
        self.client.get(format!("{}{path}", self.url)).send().await.unwrap()
    }

    /// GET that must succeed.
    pub async fn get_json(&self, path: &str) -> Value {
        let response = self.get(path).await;
        let status = response.status();
        let value: Value = response.json().await.unwrap();
        assert!(status.is_success(), "{path}: {value}");
        value
    }

    pub async fn post(&self, path: &str, body: &Value) -> Response {
        self.client.post(format!("{}{path}", self.url)).json(body).send().await.unwrap()
    }

    /// POST of a text as JSON, for what no JSON library would write.
    pub async fn post_text(&self, path: &str, body: impl Into<reqwest::Body>) -> Response {
        let request = self.client.post(format!("{}{path}", self.url));
        request.header("content-type", "application/json").body(body).send().await.unwrap()
    }

    /// POST that must succeed.
    pub async fn post_json(&self, path: &str, body: &Value) -> Value {
        let response = self.post(path, body).await;
        let status = response.status();
        let value: Value = response.json().await.unwrap();
        assert!(status.is_success(), "{path}: {value}");
        value
    }

    /// Starts a run; its id.
    pub async fn start_execution(&self, request: &Value) -> String {
        self.post_json("/v1/executions", request).await["id"].as_str().unwrap().to_owned()
    }

    /// Starts a run that follows `plan` about a sample object, at so many simulated seconds a second; its id.
    pub async fn start_run(&self, plan: &Value, sample: &str, speed_factor: f64) -> String {
        let object = json!({"sample": sample});
        self.start_execution(&json!({"plan_id": plan["id"], "object": object, "speed_factor": speed_factor}))
            .await
    }

    /// Waits for a run to reach one of `states`.
    pub async fn wait_for(&self, run: &str, states: &[&str]) -> Value {
        let begin = std::time::Instant::now();
        loop {
            let execution = self.get_json(&format!("/v1/executions/{run}")).await;
            let state = execution["state"].as_str().unwrap().to_owned();
            if states.contains(&state.as_str()) {
                return execution;
            }
            assert!(begin.elapsed() < PATIENCE, "still {state}: {execution}");
            tokio::time::sleep(Duration::from_millis(20)).await;
        }
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// A problem document: status, content type and members are checked for consistency.
pub async fn problem(response: Response) -> Value {
    let status = response.status().as_u16();
    assert!(status >= 400, "{status}");
    assert_eq!(response.headers()["content-type"], "application/problem+json");
    let problem: Value = response.json().await.unwrap();
    assert_eq!(problem["status"], status, "{problem}");
    for member in ["type", "title", "code", "detail"] {
        assert!(problem[member].is_string(), "{member} of {problem}");
    }
    problem
}

/// A small camera with the D435's field of view: quick to render.
pub fn small_camera() -> Value {
    json!({"width": 320, "height": 180, "fx": 228.9, "fy": 228.3, "cx": 161.8, "cy": 93.1})
}

/// A UR5e with an object on a table before it.
pub fn cell() -> Value {
    json!({
        "camera": small_camera(),
        "object": {"center": [0.45, 0.0, 0.15], "radius": 0.1, "table_z": 0.0},
        "robot": {"model": "ur5e"},
        "flange_from_camera": {"position": [0.0, 0.0, 0.05], "orientation": [0.0, 0.0, 0.0, 1.0]},
    })
}

/// `base` with the members of `more`.
pub fn with(mut base: Value, more: Value) -> Value {
    for (name, value) in more.as_object().unwrap() {
        base[name] = value.clone();
    }
    base
}

/// `document` without the one member that differs between computations.
pub fn without_timings(mut document: Value) -> Value {
    document.as_object_mut().unwrap().remove("timings_ms").unwrap();
    document
}

//! ONNX Runtime's shared library: found or unpacked, and loaded once a process.

use std::path::Path;
use std::sync::OnceLock;

use ort::environment::Environment;

use super::PredictError;

/// The environment variable that names another `libonnxruntime.so` to use.
pub const DYLIB_VARIABLE: &str = "ORT_DYLIB_PATH";

/// The library out of the Python wheel (`build.rs`); MIT licence, see the wheel's third-party notices.
#[cfg(embedded_onnxruntime)]
static LIBRARY: &[u8] = include_bytes!(concat!(env!("OUT_DIR"), "/libonnxruntime.so"));

static ENVIRONMENT: OnceLock<Result<Environment, String>> = OnceLock::new();

/// The process's ONNX Runtime environment, made at the first call (30 to 45 ms).
///
/// `ORT_DYLIB_PATH` names the library if set; otherwise the embedded one is used.
///
/// # Errors
/// [`PredictError::Runtime`] when there is no library or it cannot be loaded; every later call says the same.
pub fn environment() -> Result<&'static Environment, PredictError> {
    ENVIRONMENT
        .get_or_init(|| match std::env::var_os(DYLIB_VARIABLE).filter(|path| !path.is_empty()) {
            Some(path) => load(Path::new(&path)).map_err(|reason| format!("{DYLIB_VARIABLE}: {reason}")),
            None => load_embedded(),
        })
        .as_ref()
        .map_err(|reason| PredictError::Runtime { reason: reason.clone() })
}

fn load(path: &Path) -> Result<Environment, String> {
    let builder = ort::init_from(path).map_err(|error| error.to_string())?;
    builder.with_name("prv").with_telemetry(false).build().map_err(|error| error.to_string())
}

#[cfg(not(embedded_onnxruntime))]
fn load_embedded() -> Result<Environment, String> {
    Err(format!("this build embeds no library; set {DYLIB_VARIABLE} to the path of libonnxruntime"))
}

/// Loads the embedded library from memory, or from a temporary file where that is not allowed.
#[cfg(embedded_onnxruntime)]
fn load_embedded() -> Result<Environment, String> {
    let in_memory = load_from_memory(LIBRARY);
    in_memory.or_else(|first| {
        load_from_file(LIBRARY).map_err(|second| {
            format!("{second} (from memory: {first}); set {DYLIB_VARIABLE} to the path of libonnxruntime")
        })
    })
}

#[cfg(embedded_onnxruntime)]
fn load_from_memory(library: &[u8]) -> Result<Environment, String> {
    use std::io::Write;
    use std::os::fd::AsRawFd;

    let descriptor = rustix::fs::memfd_create("libonnxruntime.so", rustix::fs::MemfdFlags::CLOEXEC)
        .map_err(|error| format!("memfd_create: {error}"))?;
    let mut file = std::fs::File::from(descriptor);
    file.write_all(library).map_err(|error| format!("memfd: {error}"))?;
    // The mapping outlives the descriptor, which may be closed once the library is loaded.
    load(Path::new(&format!("/proc/self/fd/{}", file.as_raw_fd())))
}

#[cfg(embedded_onnxruntime)]
fn load_from_file(library: &[u8]) -> Result<Environment, String> {
    use std::io::Write;
    use std::os::unix::fs::OpenOptionsExt;

    let path = std::env::temp_dir().join(format!("prv-libonnxruntime-{}.so", std::process::id()));
    let write = || {
        // `create_new` never follows what someone else may have put there.
        let mut file = std::fs::OpenOptions::new().write(true).create_new(true).mode(0o600).open(&path)?;
        file.write_all(library)
    };
    write().map_err(|error| format!("{}: {error}", path.display()))?;
    let loaded = load(&path);
    let _ = std::fs::remove_file(&path);
    loaded
}

//! Puts two files beside the code: ONNX Runtime's shared library, out of its hash-pinned
//! Python wheel, and the shipped PRVNet model. `predict` includes both.
//!
//! The wheel comes through `pip`, so that whatever index, mirror or proxy the user's pip is
//! configured for is the one used, and is kept in the user's cache directory.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs, io};

use sha2::{Digest, Sha256};

/// Release of the wheel and suffix of the library in it.
const VERSION: &str = "1.31.1";

/// One pinned wheel.
struct Wheel {
    arch: &'static str,
    platform: &'static str,
    sha256: &'static str,
}

const WHEELS: [Wheel; 2] = [
    Wheel {
        arch: "x86_64",
        platform: "manylinux_2_28_x86_64",
        sha256: "5752bd508126ae7c49894d3b9d2e83f0c3d487319246d04c444b393308d7ad7f",
    },
    Wheel {
        arch: "aarch64",
        platform: "manylinux_2_28_aarch64",
        sha256: "da05378364c44d4407e463982d2bf8d5e4cfea873283757e48beeb41df97b7f3",
    },
];

fn main() {
    println!("cargo:rerun-if-changed=build.rs");
    println!("cargo:rustc-check-cfg=cfg(embedded_onnxruntime)");
    let out = PathBuf::from(env::var_os("OUT_DIR").expect("cargo sets OUT_DIR"));
    if let Err(message) = shipped_model(&out).and_then(|()| onnxruntime(&out)) {
        eprintln!("\n{message}\n");
        std::process::exit(1);
    }
}

/// Writes the expression that holds the shipped model's bytes, empty while there is no model.
fn shipped_model(out: &Path) -> Result<(), String> {
    let root = PathBuf::from(env::var_os("CARGO_MANIFEST_DIR").expect("cargo sets CARGO_MANIFEST_DIR"));
    let model = root.join("models/prvnet.onnx");
    let expression = if model.is_file() {
        println!("cargo:rerun-if-changed=models/prvnet.onnx");
        format!("include_bytes!({:?})", model.display().to_string())
    } else {
        // A watched file that does not exist would make every build a full one; the directory does exist.
        println!("cargo:rerun-if-changed=models");
        println!(
            "cargo:warning=models/prvnet.onnx is missing: the executable will need --model for predictions"
        );
        "&[]".to_owned()
    };
    write_if_changed(&out.join("shipped_model.rs"), expression.as_bytes())
}

/// Puts `libonnxruntime.so` into `out` and sets `cfg(embedded_onnxruntime)`, where that is wanted and possible.
fn onnxruntime(out: &Path) -> Result<(), String> {
    let target = |key: &str| env::var(format!("CARGO_CFG_TARGET_{key}")).unwrap_or_default();
    if env::var_os("CARGO_FEATURE_EMBED_ONNXRUNTIME").is_none() {
        return Ok(());
    }
    let arch = target("ARCH");
    let wheel = WHEELS.iter().find(|wheel| wheel.arch == arch);
    let (Some(wheel), "linux", "gnu") = (wheel, target("OS").as_str(), target("ENV").as_str()) else {
        println!("cargo:warning=no pinned ONNX Runtime for this target: set ORT_DYLIB_PATH when running");
        return Ok(());
    };
    println!("cargo:rustc-cfg=embedded_onnxruntime");
    let library = out.join("libonnxruntime.so");
    if library.is_file() && fs::read_to_string(out.join("wheel")).is_ok_and(|of| of == wheel.sha256) {
        return Ok(());
    }
    let bytes = wheel_bytes(wheel, out)?;
    extract(&bytes, &library)?;
    write_if_changed(&out.join("wheel"), wheel.sha256.as_bytes())
}

/// The wheel, from the cache if it is there and whole.
fn wheel_bytes(wheel: &Wheel, out: &Path) -> Result<Vec<u8>, String> {
    let cache =
        cache_dir().filter(|dir| fs::create_dir_all(dir).is_ok()).unwrap_or_else(|| out.to_path_buf());
    let cached = cache.join(format!("onnxruntime-{VERSION}-{}.whl", wheel.arch));
    if let Some(bytes) = fs::read(&cached).ok().filter(|bytes| sha256(bytes) == wheel.sha256) {
        return Ok(bytes);
    }
    // Each build downloads into a directory of its own and renames: builds may run side by side.
    let scratch = out.join(format!("download-{}", std::process::id()));
    let downloaded = download(wheel, &scratch);
    let bytes = downloaded.and_then(|path| fs::read(&path).map_err(|e| format!("{}: {e}", path.display())));
    let _ = fs::remove_dir_all(&scratch);
    let bytes = bytes?;
    let found = sha256(&bytes);
    if found != wheel.sha256 {
        return Err(format!("the ONNX Runtime wheel's SHA-256 is {found}, must be {}", wheel.sha256));
    }
    // A cache that cannot be written costs the next build a download, nothing else.
    let partial = cache.join(format!("onnxruntime-{VERSION}-{}.{}.part", wheel.arch, std::process::id()));
    if fs::write(&partial, &bytes).and_then(|()| fs::rename(&partial, &cached)).is_err() {
        let _ = fs::remove_file(&partial);
    }
    Ok(bytes)
}

/// `$XDG_CACHE_HOME/prv-planner`, or under `~/.cache`.
fn cache_dir() -> Option<PathBuf> {
    let absolute = |key| env::var_os(key).map(PathBuf::from).filter(|path| path.is_absolute());
    absolute("XDG_CACHE_HOME")
        .or_else(|| Some(absolute("HOME")?.join(".cache")))
        .map(|c| c.join("prv-planner"))
}

/// Has pip fetch the wheel into `scratch`; the path of the file.
fn download(wheel: &Wheel, scratch: &Path) -> Result<PathBuf, String> {
    let io_error = |e: io::Error| format!("{}: {e}", scratch.display());
    fs::create_dir_all(scratch).map_err(io_error)?;
    let requirements = scratch.join("requirements.txt");
    fs::write(&requirements, format!("onnxruntime=={VERSION} --hash=sha256:{}\n", wheel.sha256))
        .map_err(io_error)?;
    let python = env::var_os("PYTHON").unwrap_or_else(|| "python3".into());
    let output = Command::new(&python)
        .args(["-m", "pip", "download", "--quiet", "--disable-pip-version-check", "--no-deps"])
        .args([
            "--only-binary=:all:",
            "--require-hashes",
            "--python-version",
            "3.11",
            "--implementation",
            "cp",
        ])
        .args(["--platform", wheel.platform, "--dest"])
        .arg(scratch)
        .arg("-r")
        .arg(&requirements)
        .output();
    let advice = format!(
        "ONNX Runtime {VERSION} is taken from its Python wheel with `{} -m pip download`, and that failed.\n\
         Install Python 3 with pip (Debian: apt-get install python3 python3-pip) and build again,\n\
         or build with --no-default-features and set ORT_DYLIB_PATH to libonnxruntime.so when running.",
        python.to_string_lossy()
    );
    match output {
        Err(error) => return Err(format!("{advice}\nThe command could not be started: {error}")),
        Ok(output) if !output.status.success() => {
            return Err(format!("{advice}\nIt said:\n{}", String::from_utf8_lossy(&output.stderr).trim()));
        }
        Ok(_) => {}
    }
    let entries = fs::read_dir(scratch).map_err(io_error)?;
    entries
        .filter_map(|entry| Some(entry.ok()?.path()))
        .find(|path| path.extension().is_some_and(|extension| extension == "whl"))
        .ok_or_else(|| format!("{advice}\npip left no wheel in {}", scratch.display()))
}

/// Unpacks the shared library out of the wheel, which is a zip archive.
fn extract(wheel: &[u8], library: &Path) -> Result<(), String> {
    let name = format!("onnxruntime/capi/libonnxruntime.so.{VERSION}");
    let unpack = || -> Result<(), Box<dyn std::error::Error>> {
        let mut archive = zip::ZipArchive::new(io::Cursor::new(wheel))?;
        let mut bytes = Vec::new();
        io::copy(&mut archive.by_name(&name)?, &mut bytes)?;
        let partial = library.with_extension("part");
        fs::write(&partial, bytes)?;
        fs::rename(&partial, library)?;
        Ok(())
    };
    unpack().map_err(|error| format!("cannot unpack {name} from the ONNX Runtime wheel: {error}"))
}

/// Leaves an equal file alone, so that its time stamp does not cause a rebuild.
fn write_if_changed(path: &Path, bytes: &[u8]) -> Result<(), String> {
    if fs::read(path).is_ok_and(|old| old == bytes) {
        return Ok(());
    }
    fs::write(path, bytes).map_err(|error| format!("{}: {error}", path.display()))
}

fn sha256(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect()
}

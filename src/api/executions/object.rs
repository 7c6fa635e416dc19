//! The object that stands before the simulated camera.

use std::fs;
use std::path::{Component, Path, PathBuf};

use axum::http::StatusCode;
use serde_json::Value;

use crate::api::convert::base64_bytes;
use crate::api::problem::Problem;
use crate::api::wire::ExecutionObject;
use crate::objects::{Source, families, object_at};
use crate::render::{Mesh, sample_names, sample_object};

/// Loads the object that `json` names; an uploaded one through a file in `scratch`.
///
/// # Errors
/// 422 unless exactly one source is given; unknown samples and made objects, files outside the objects directory,
/// files that are no meshes.
pub fn load_object(
    json: &ExecutionObject,
    objects_dir: Option<&Path>,
    scratch: &Path,
) -> Result<Mesh, Problem> {
    match (&json.sample, &json.made, &json.file, &json.glb) {
        (Some(name), None, None, None) => sample_object(name).ok_or_else(|| {
            let known = sample_names().join(", ");
            Problem::field("unknown_object", "object.sample", name.clone(), format!("one of {known}"))
        }),
        (None, Some(key), None, None) => made(key),
        (None, None, Some(file), None) => {
            let path = path_below(objects_dir, file)?;
            load("object.file", file, &path)
        }
        (None, None, None, Some(text)) => uploaded(text, scratch),
        _ => Err(Problem::field(
            "object_source",
            "object",
            serde_json::to_value(json).unwrap_or(Value::Null),
            "exactly one of sample, made, file and glb",
        )),
    }
}

/// A made object by its key; nothing that names a file.
fn made(key: &str) -> Result<Mesh, Problem> {
    let entry = object_at(key).ok().filter(|entry| matches!(entry.source, Source::Made { .. }));
    let mesh = entry.and_then(|entry| entry.load().ok());
    mesh.ok_or_else(|| {
        let known: Vec<&str> = families().map(|family| family.name()).collect();
        let bound = format!("made:FAMILY/SEED, FAMILY one of {}, SEED a whole number", known.join(", "));
        Problem::field("unknown_object", "object.made", key, bound)
    })
}

/// The file `relative` below the objects directory, links resolved.
fn path_below(objects_dir: Option<&Path>, relative: &str) -> Result<PathBuf, Problem> {
    let refuse = |bound: &str| Problem::field("object_file", "object.file", relative, bound);
    let Some(directory) = objects_dir else {
        return Err(refuse("left out: this service has no objects directory (--objects-dir)"));
    };
    let plain = Path::new(relative).components().all(|part| matches!(part, Component::Normal(_)));
    if !plain || relative.is_empty() {
        return Err(refuse("a relative path without .. below the objects directory"));
    }
    let base = directory.canonicalize()?;
    match base.join(relative).canonicalize() {
        Ok(path) if path.starts_with(&base) && path.is_file() => Ok(path),
        _ => Err(refuse("a file below the objects directory").with_status(StatusCode::NOT_FOUND)),
    }
}

fn uploaded(text: &str, scratch: &Path) -> Result<Mesh, Problem> {
    let bytes = base64_bytes("object.glb", text)?;
    if !bytes.starts_with(b"glTF") {
        let value = format!("{} bytes", bytes.len());
        return Err(Problem::field("not_a_mesh", "object.glb", value, "a binary glTF file (.glb)"));
    }
    // In a folder of its own, so that the file cannot refer to any other.
    fs::create_dir_all(scratch)?;
    let path = scratch.join("object.glb");
    fs::write(&path, &bytes)?;
    let mesh = load("object.glb", "uploaded", &path);
    fs::remove_dir_all(scratch)?;
    mesh
}

fn load(field: &str, name: &str, path: &Path) -> Result<Mesh, Problem> {
    Mesh::load(path).map_err(|error| {
        let mut problem =
            Problem::field("not_a_mesh", field, name, "an OBJ, glTF or GLB file with triangles");
        // The server's own path is nobody's business.
        let text = error.to_string().replace(&path.display().to_string(), name);
        problem.detail.push_str(&format!(" ({text})"));
        problem
    })
}

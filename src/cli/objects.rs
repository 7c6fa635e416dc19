//! `prv objects`: which objects can be used.

use std::path::PathBuf;

use prv::render::look_at_objects;

use super::CliResult;

/// List the usable objects in folders, files and furniture libraries.
#[derive(clap::Args)]
pub struct Args {
    /// Folders to search, or single .sh3f, .obj, .gltf and .glb files.
    #[arg(long = "dir", alias = "sh3f", env = "PRV_OBJECTS", required = true, num_args = 1..)]
    dirs: Vec<PathBuf>,
    /// List those that are left out, too, with the reason.
    #[arg(long, env = "PRV_ALL")]
    all: bool,
    /// Print JSON.
    #[arg(long, env = "PRV_JSON")]
    json: bool,
}

/// Lists the objects.
pub fn run(args: &Args) -> CliResult {
    let progress = indicatif::ProgressBar::new_spinner().with_message("looking at objects");
    progress.enable_steady_tick(std::time::Duration::from_millis(200));
    let mut found = Vec::new();
    for dir in &args.dirs {
        found.extend(look_at_objects(dir)?);
    }
    progress.finish_and_clear();
    let of = found.len();
    let usable = found.iter().filter(|(_, verdict)| verdict.is_ok()).count();
    found.retain(|(_, verdict)| args.all || verdict.is_ok());
    if args.json {
        let list: Vec<_> = found
            .iter()
            .map(|(o, verdict)| {
                serde_json::json!({
                    "key": o.key, "name": o.name, "category": o.category, "licence": o.licence,
                    "creator": o.creator, "object": o.address(),
                    "left_out": verdict.as_ref().err().map(ToString::to_string),
                })
            })
            .collect();
        println!("{:#}", serde_json::json!({ "usable": usable, "of": of, "objects": list }));
        return Ok(());
    }
    for (o, verdict) in &found {
        let reason = verdict.as_ref().err().map_or(String::new(), |e| format!("  LEFT OUT: {e}"));
        println!("{}  {} ({}){reason}", o.key, o.name, o.category);
    }
    eprintln!("{usable} of {of} objects are usable");
    Ok(())
}

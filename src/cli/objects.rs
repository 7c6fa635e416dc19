//! `prv objects`: which objects there are, and pictures of them.

use std::path::{Path, PathBuf};

use indicatif::{ProgressBar, ProgressStyle};
use prv::objects::{
    LookedAt, SheetSettings, Unusable, contact_sheet, families, look_at_objects, select_objects,
};

use super::CliResult;

/// List the usable objects in folders, files and furniture libraries, or the families of made objects; draw them.
#[derive(clap::Args)]
pub struct Args {
    /// Folders to search, single .sh3f, .obj, .gltf and .glb files, made:FAMILY/0..100, made:*/0..10 or .txt lists of
    /// such, each with ~texture=0..3 for variants; without any the families of made objects are listed.
    #[arg(long = "objects", aliases = ["dir", "sh3f"], env = "PRV_OBJECTS", num_args = 1..)]
    objects: Vec<String>,
    /// List those that are left out, too, with the reason.
    #[arg(long, env = "PRV_ALL")]
    all: bool,
    /// Draw the objects into this PNG file, row by row in the order of the list.
    #[arg(long, env = "PRV_SHEET", requires = "objects")]
    sheet: Option<PathBuf>,
    /// Pictures in a row of the sheet.
    #[arg(long, env = "PRV_COLUMNS", default_value_t = 8, value_parser = clap::value_parser!(u32).range(1..=100))]
    columns: u32,
    /// Pixels a side of a picture of the sheet.
    #[arg(long, env = "PRV_SIZE", default_value_t = 192, value_parser = clap::value_parser!(u32).range(16..=1024))]
    size: u32,
    /// Azimuth of the sheet's camera, degrees from +x towards +y; fronts face -y, that is -90.
    #[arg(long, env = "PRV_AZIMUTH", default_value_t = -60.0, allow_hyphen_values = true)]
    azimuth: f64,
    /// Elevation of the sheet's camera, degrees.
    #[arg(long, env = "PRV_ELEVATION", default_value_t = 25.0, allow_hyphen_values = true)]
    elevation: f64,
    /// Print JSON.
    #[arg(long, env = "PRV_JSON")]
    json: bool,
}

/// The most objects of one sheet.
const MAX_ON_SHEET: usize = 4096;

/// Lists or draws the objects.
pub fn run(args: &Args) -> CliResult {
    match &args.sheet {
        _ if args.objects.is_empty() => list_families(args.json),
        Some(path) => draw(args, path),
        None => list(args),
    }
}

fn list_families(json: bool) -> CliResult {
    if json {
        let list: Vec<_> =
            families().map(|f| serde_json::json!({"family": f.name(), "holds": f.description()})).collect();
        println!("{:#}", serde_json::json!({ "families": list }));
        return Ok(());
    }
    for family in families() {
        println!("made:{}/SEED  {}", family.name(), family.description());
    }
    Ok(())
}

fn list(args: &Args) -> CliResult {
    let progress = ProgressBar::new_spinner().with_message("looking at objects");
    progress.enable_steady_tick(std::time::Duration::from_millis(200));
    let mut found: Vec<LookedAt> = Vec::new();
    for text in &args.objects {
        // Only folders and model files are judged; what is named is taken as it is.
        if Path::new(text).exists() && !text.ends_with(".txt") {
            found.extend(look_at_objects(text)?);
        } else {
            found.extend(select_objects(&[text])?.into_iter().map(|entry| (entry, Ok(()))));
        }
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
        let reason = verdict.as_ref().err().map_or(String::new(), |e: &Unusable| format!("  LEFT OUT: {e}"));
        println!("{}  {} ({}){reason}", o.key, o.name, o.category);
    }
    eprintln!("{usable} of {of} objects are usable");
    Ok(())
}

fn draw(args: &Args, path: &Path) -> CliResult {
    let entries = select_objects(&args.objects)?;
    if entries.is_empty() || entries.len() > MAX_ON_SHEET {
        return Err(
            format!("--objects gives {} objects, a sheet holds 1 to {MAX_ON_SHEET}", entries.len()).into()
        );
    }
    let bar = ProgressBar::new(entries.len() as u64).with_style(ProgressStyle::with_template(
        "{elapsed_precise} [{wide_bar}] {pos}/{len} objects, {eta_precise} left",
    )?);
    let settings = SheetSettings {
        cell_px: args.size,
        columns: args.columns,
        azimuth_rad: args.azimuth.to_radians(),
        elevation_rad: args.elevation.to_radians(),
        ..SheetSettings::default()
    };
    let (sheet, failures) = contact_sheet(&entries, &settings, || bar.inc(1));
    bar.finish_and_clear();
    for (key, error) in &failures {
        eprintln!("warning: {key}: {error}");
    }
    sheet.save(path)?;
    if args.json {
        let keys: Vec<&str> = entries.iter().map(|entry| entry.key.as_str()).collect();
        let failed: Vec<&str> = failures.iter().map(|(key, _)| key.as_str()).collect();
        println!(
            "{:#}",
            serde_json::json!({"sheet": path, "objects": keys, "failed": failed, "columns": args.columns})
        );
    } else {
        eprintln!("{}: {} objects", path.display(), entries.len() - failures.len());
    }
    Ok(())
}

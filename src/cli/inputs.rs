//! `prv inputs`: the initial photos of labelled objects, cut as the service cuts photos, for training.

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::Mutex;

use image::RgbaImage;
use indicatif::{ProgressBar, ProgressStyle};
use prv::files::replace_unsynced;
use prv::geometry::Point;
use prv::imaging::Camera;
use prv::objects::{ObjectEntry, ObjectLookup};
use prv::predict::crop;
use prv::render::{RenderSettings, Renderer};
use prv::views::{Band, ViewSpace, initial_views_five};
use sha2::{Digest, Sha256};

use super::{CliResult, workers};

/// Distance of the initial views from the object's centre, metres (paper, section "Dataset Generation").
const VIEW_RADIUS_M: f64 = 0.3;
/// The columns that make a row of the label file one of a kind; they are copied as text.
const KEY_COLUMNS: [&str; 3] = ["object", "radius_m", "seed"];

/// Render the five initial photos of each labelled object and cut them to the network's view.
///
/// Writes OUT/<row>/<k>.png (RGBA; k: 0 top, 1 left, 2 front, 3 right, 4 back) and OUT/index.csv. Rows that are
/// there already are left alone.
#[derive(clap::Args)]
pub struct Args {
    /// Folders or files where the labelled objects are (.sh3f libraries, OBJ, glTF); made objects need none.
    #[arg(long, env = "PRV_OBJECTS", num_args = 1..)]
    objects: Vec<String>,
    /// Label file with at least the columns object, radius_m and seed.
    #[arg(long, env = "PRV_LABELS", default_value = "labels.csv")]
    labels: PathBuf,
    /// Folder to write to.
    #[arg(long, env = "PRV_INPUTS")]
    out: PathBuf,
    /// Side of the crops, pixels; best the model's own input size, which is then never resampled.
    #[arg(long, env = "PRV_CROP_SIZE", default_value_t = 224, value_parser = clap::value_parser!(u32).range(32..=1024))]
    size: u32,
    /// Objects rendered side by side; 0 for one a core.
    #[arg(long, env = "PRV_JOBS", default_value_t = 1)]
    jobs: usize,
    /// Print one JSON line a row to stdout.
    #[arg(long, env = "PRV_JSON")]
    json: bool,
}

/// One row of the label file.
struct LabelledRow {
    /// The folder's name: the first 16 hexadecimal digits of the key columns' SHA-256.
    id: String,
    key: [String; 3],
    radius_m: f64,
}

/// Renders what is missing.
pub fn run(args: &Args) -> CliResult {
    let rows = read_rows(&args.labels)?;
    let objects = ObjectLookup::new(&args.objects)?;
    std::fs::create_dir_all(&args.out)?;
    let bar = ProgressBar::new(rows.len() as u64).with_style(ProgressStyle::with_template(
        "{elapsed_precise} [{wide_bar}] {pos}/{len} objects, {eta_precise} left",
    )?);
    let failures = Mutex::new(HashMap::new());
    let outcome = workers::side_by_side(workers::threads(args.jobs), &rows, |row| {
        let outcome = match objects.get(&row.key[0]) {
            Some(entry) => photograph(&entry, row, args).map_err(|error| error.to_string()),
            None => Err(format!("is not among the usable objects of {:?}", args.objects)),
        };
        if args.json {
            println!(
                "{}",
                serde_json::json!({"row": row.id, "object": row.key[0], "error": outcome.as_ref().err()})
            );
        }
        if let Err(reason) = outcome {
            bar.suspend(|| eprintln!("{}: {reason}", row.key[0]));
            failures.lock().unwrap_or_else(|e| e.into_inner()).insert(row.id.clone(), reason);
        }
        bar.inc(1);
        Ok(())
    });
    bar.finish_and_clear();
    outcome?;
    let failures = failures.into_inner().unwrap_or_else(|e| e.into_inner());
    write_index(&args.out, rows.iter().filter(|row| !failures.contains_key(&row.id)))?;
    eprintln!(
        "{} rows with crops in {}, {} without",
        rows.len() - failures.len(),
        args.out.display(),
        failures.len()
    );
    Ok(())
}

fn read_rows(path: &Path) -> Result<Vec<LabelledRow>, Box<dyn std::error::Error>> {
    let named = |error: csv::Error| format!("{}: {error}", path.display());
    let mut reader = csv::Reader::from_path(path).map_err(named)?;
    let header = reader.headers().map_err(named)?.clone();
    let column = |name: &str| {
        header
            .iter()
            .position(|h| h == name)
            .ok_or_else(|| format!("{}: there is no column {name}", path.display()))
    };
    let columns = [column(KEY_COLUMNS[0])?, column(KEY_COLUMNS[1])?, column(KEY_COLUMNS[2])?];
    let mut rows = Vec::new();
    for record in reader.records() {
        let record = record.map_err(named)?;
        let key = columns.map(|index| record.get(index).unwrap_or_default().to_owned());
        let radius_m =
            key[1].parse().ok().filter(|radius| (0.001..0.3).contains(radius)).ok_or_else(|| {
                format!("{}: {}: radius_m is {:?}, must be 0.001 to 0.3 m", path.display(), key[0], key[1])
            })?;
        let digest = Sha256::digest(key.join("\n"));
        let id = digest.iter().take(8).map(|byte| format!("{byte:02x}")).collect();
        rows.push(LabelledRow { id, key, radius_m });
    }
    Ok(rows)
}

/// Writes the row's five crops unless they are there.
fn photograph(entry: &ObjectEntry, row: &LabelledRow, args: &Args) -> CliResult {
    let folder = args.out.join(&row.id);
    let views = initial_views_five();
    if is_complete(&folder, views.len(), args.size) {
        return Ok(());
    }
    std::fs::create_dir_all(&folder)?;
    let renderer = Renderer::new(&entry.load()?.fitted(Point::origin(), row.radius_m));
    let space = ViewSpace { center_in_base: Point::origin(), radius_m: VIEW_RADIUS_M, band: Band::DEFAULT };
    let camera = Camera::REALSENSE_D435;
    let center_in_camera = Point::new(0.0, 0.0, VIEW_RADIUS_M);
    for (k, view) in views.iter().enumerate() {
        let photo = renderer.render(&camera, &space.pose(&view.direction, 0.0), &RenderSettings::default());
        save(&crop(&photo, &camera, &center_in_camera, args.size), &folder.join(format!("{k}.png")))?;
    }
    Ok(())
}

fn is_complete(folder: &Path, count: usize, size: u32) -> bool {
    (0..count)
        .all(|k| image::image_dimensions(folder.join(format!("{k}.png"))).is_ok_and(|d| d == (size, size)))
}

/// A killed run must leave no half of a file under its final name.
fn save(image: &RgbaImage, path: &Path) -> CliResult {
    let mut png = std::io::Cursor::new(Vec::new());
    image.write_to(&mut png, image::ImageFormat::Png)?;
    Ok(replace_unsynced(path, png.get_ref())?)
}

fn write_index<'a>(out: &Path, rows: impl Iterator<Item = &'a LabelledRow>) -> CliResult {
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record(["row", KEY_COLUMNS[0], KEY_COLUMNS[1], KEY_COLUMNS[2]])?;
    for row in rows {
        writer.write_record([&row.id, &row.key[0], &row.key[1], &row.key[2]])?;
    }
    Ok(replace_unsynced(&out.join("index.csv"), &writer.into_inner()?)?)
}

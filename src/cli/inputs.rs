//! `prv inputs`: the initial photos of labelled objects, cut as the service cuts photos, for training.

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::Mutex;

use image::RgbaImage;
use indicatif::{ProgressBar, ProgressStyle};
use prv::files::replace_unsynced;
use prv::geometry::{Point, Pose, Vector};
use prv::imaging::Camera;
use prv::objects::{ObjectEntry, ObjectLookup};
use prv::predict::crop;
use prv::render::{Light, RenderSettings, Renderer};
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
    /// Turn the objects about their vertical axis by so much: other sides of them, to learn from.
    #[arg(long, env = "PRV_YAW_DEG", default_value_t = 0.0, allow_negative_numbers = true)]
    yaw_deg: f64,
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
    if !args.yaw_deg.is_finite() {
        return Err(format!("--yaw-deg is {}, must be a number", args.yaw_deg).into());
    }
    let rows = read_rows(&args.labels)?;
    let objects = ObjectLookup::new(&args.objects)?;
    std::fs::create_dir_all(&args.out)?;
    keep_angle(&args.out, args.yaw_deg)?;
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

/// Notes the angle in the folder; refuses a folder of another, whose crops would be taken for what is asked.
fn keep_angle(out: &Path, yaw_deg: f64) -> CliResult {
    let path = out.join("yaw_deg");
    let named = |error: &dyn std::fmt::Display| format!("{}: {error}", path.display());
    let known = match std::fs::read_to_string(&path) {
        Ok(text) => Some(text.trim().parse::<f64>().map_err(|error| named(&error))?),
        Err(error) if error.kind() != std::io::ErrorKind::NotFound => return Err(named(&error).into()),
        // Written before objects could be turned.
        Err(_) if out.join("index.csv").exists() => Some(0.0),
        Err(_) => None,
    };
    match known {
        Some(known) if known != yaw_deg => Err(format!(
            "{} holds objects turned by {known} degrees, --yaw-deg is {yaw_deg}: give another --out",
            out.display()
        )
        .into()),
        _ => Ok(replace_unsynced(&path, format!("{yaw_deg}\n").as_bytes())?),
    }
}

/// Writes the row's five crops unless they are there.
fn photograph(entry: &ObjectEntry, row: &LabelledRow, args: &Args) -> CliResult {
    let folder = args.out.join(&row.id);
    if is_complete(&folder, initial_views_five().len(), args.size) {
        return Ok(());
    }
    std::fs::create_dir_all(&folder)?;
    let renderer = Renderer::new(&entry.load()?.fitted(Point::origin(), row.radius_m));
    for (k, crop) in crops(&renderer, args.yaw_deg.to_radians(), args.size).enumerate() {
        save(&crop, &folder.join(format!("{k}.png")))?;
    }
    Ok(())
}

/// Crops of the five initial views of an object about the origin that is turned about its vertical axis.
fn crops(renderer: &Renderer, yaw_rad: f64, size: u32) -> impl Iterator<Item = RgbaImage> {
    // An object that is turned is seen and lit as one at rest by a camera and lights that are turned back.
    let turn = Pose::rotation(Vector::z() * -yaw_rad);
    let settings = RenderSettings { light: Light::default().turned(-yaw_rad), ..RenderSettings::default() };
    let space = ViewSpace { center_in_base: Point::origin(), radius_m: VIEW_RADIUS_M, band: Band::DEFAULT };
    let camera = Camera::REALSENSE_D435;
    let center_in_camera = Point::new(0.0, 0.0, VIEW_RADIUS_M);
    initial_views_five().into_iter().map(move |view| {
        let photo = renderer.render(&camera, &(turn * space.pose(&view.direction, 0.0)), &settings);
        crop(&photo, &camera, &center_in_camera, size)
    })
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

#[cfg(test)]
mod tests {
    use prv::render::sample_object;

    use super::*;

    /// Mean difference of a channel, steps.
    fn apart(a: &RgbaImage, b: &RgbaImage, channel: usize) -> f64 {
        let each = a.pixels().zip(b.pixels()).map(|(a, b)| f64::from(a[channel].abs_diff(b[channel])));
        each.sum::<f64>() / f64::from(a.width() * a.height())
    }

    #[test]
    fn a_folder_holds_objects_turned_by_one_angle() {
        let folder = tempfile::tempdir().unwrap();
        keep_angle(folder.path(), 137.5).unwrap();
        keep_angle(folder.path(), 137.5).unwrap();
        let told = keep_angle(folder.path(), 90.0).unwrap_err().to_string();
        assert!(told.contains("turned by 137.5 degrees, --yaw-deg is 90"), "{told}");
        let old = tempfile::tempdir().unwrap();
        std::fs::write(old.path().join("index.csv"), "row\n").unwrap();
        assert!(keep_angle(old.path(), 90.0).is_err());
        keep_angle(old.path(), 0.0).unwrap();
    }

    #[test]
    fn an_object_that_is_turned_shows_its_other_sides_in_the_same_light() {
        let mug = Renderer::new(&sample_object("mug").unwrap().fitted(Point::origin(), 0.08));
        let turned_by = |yaw_deg: f64| crops(&mug, yaw_deg.to_radians(), 96).collect::<Vec<_>>();
        let (rest, turned, whole) = (turned_by(0.0), turned_by(80.0), turned_by(360.0));
        // Front stands 80 degrees on from left.
        let (left, front, alpha, red) = (1, 2, 3, 0);
        assert!(apart(&rest[left], &turned[front], alpha) < 0.05, "front shows what left did");
        assert!(apart(&rest[left], &rest[front], alpha) > 1.0, "the mug's handle tells the sides apart");
        assert!(apart(&rest[left], &turned[front], red) > 1.0, "the light has stayed where it was");
        assert!((0..4).all(|channel| apart(&rest[left], &whole[left], channel) < 0.05));
    }
}

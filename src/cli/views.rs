//! `prv views`: directions and poses on a band around an object.

use std::io::Write;
use std::path::PathBuf;

use indicatif::{ProgressBar, ProgressStyle};
use prv::geometry::{Point, azimuth_elevation_from_direction};
use prv::views::{Band, MAX_VIEWS, ViewSpace, best_known_rad, covering_radius_rad, generate_table, tammes};
use serde_json::json;

use super::{CliResult, views_search};

/// Place views around an object, as far apart as they can be.
///
/// Prints unit directions from the object's centre and camera poses (base_from_camera, OpenCV axes:
/// x right, y down, z forward; quaternions x, y, z, w), the top view first.
#[derive(clap::Args)]
pub struct Args {
    /// Number of views, 1 to 200.
    #[arg(required_unless_present_any = ["table", "search", "summary", "improve"])]
    count: Option<usize>,
    /// Lowest elevation, degrees.
    #[arg(long, env = "PRV_MIN_ELEVATION", default_value_t = 5.0, allow_hyphen_values = true)]
    min_elevation: f64,
    /// Highest elevation, degrees.
    #[arg(long, env = "PRV_MAX_ELEVATION", default_value_t = 90.0, allow_hyphen_values = true)]
    max_elevation: f64,
    /// Distance of the cameras from the object's centre, metres.
    #[arg(long, env = "PRV_VIEW_RADIUS", default_value_t = 0.3, allow_hyphen_values = true)]
    radius: f64,
    /// The object's centre in the robot's base frame: x,y,z in metres.
    #[arg(
        long,
        env = "PRV_CENTER",
        value_delimiter = ',',
        num_args = 1,
        default_value = "0,0,0",
        allow_hyphen_values = true
    )]
    center: Vec<f64>,
    /// Turn of every camera about its optical axis, degrees; 0 keeps the horizon level.
    #[arg(long, env = "PRV_ROLL", default_value_t = 0.0, allow_hyphen_values = true)]
    roll: f64,
    /// Print JSON.
    #[arg(long, env = "PRV_JSON")]
    json: bool,
    /// Instead, generate the table of sets for the default band (minutes) and print it.
    #[arg(long, env = "PRV_TABLE", conflicts_with = "count")]
    table: bool,
    /// Instead, search this band for better sets of 3 to 100 views, a line a round appended to this
    /// file; rounds it holds already are not run again.
    #[arg(long, env = "PRV_SEARCH", conflicts_with = "count")]
    search: Option<PathBuf>,
    /// Instead, print the best separation that such a file holds for each band and number of views.
    #[arg(long, env = "PRV_SUMMARY", conflicts_with_all = ["count", "search"])]
    summary: Option<PathBuf>,
    /// Instead, print the table of sets improved by those of such a file.
    #[arg(long, env = "PRV_IMPROVE", conflicts_with_all = ["count", "search", "table", "summary"])]
    improve: Option<PathBuf>,
    /// Numbers of views to search; 3 to 100 when left out.
    #[arg(long, env = "PRV_COUNTS", value_delimiter = ',', requires = "search")]
    counts: Vec<usize>,
    /// Rounds of the search, some seconds a set each.
    #[arg(long, env = "PRV_ROUNDS", default_value_t = 1, requires = "search")]
    rounds: u16,
}

/// Runs the placement.
pub fn run(args: &Args) -> CliResult {
    if let Some(file) = &args.search {
        return views_search::run(file, (args.min_elevation, args.max_elevation), &args.counts, args.rounds);
    }
    if let Some(file) = &args.summary {
        return views_search::summary(file);
    }
    if let Some(file) = &args.improve {
        return views_search::improve(file);
    }
    if args.table {
        return print_table();
    }
    let &[x, y, z] = args.center.as_slice() else {
        return Err(format!("--center has {} numbers, must have 3", args.center.len()).into());
    };
    if let Some(bad) = [x, y, z, args.roll].into_iter().find(|v| !v.is_finite()) {
        return Err(format!("--center and --roll must be finite, found {bad}").into());
    }
    let band = Band::from_degrees(args.min_elevation, args.max_elevation)?;
    let space = ViewSpace { center_in_base: Point::new(x, y, z), radius_m: args.radius, band };
    space.validate()?;
    let set = tammes(args.count.unwrap_or(0), band)?;
    let mut out = std::io::stdout().lock();
    let separation_deg = set.separation_rad.to_degrees();
    let covering_deg = covering_radius_rad(&set.directions, band).to_degrees();
    let best_known_deg = best_known_rad(set.directions.len(), band).map(f64::to_degrees);
    if args.json {
        let views: Vec<_> = set
            .directions
            .iter()
            .enumerate()
            .map(|(id, direction)| {
                let pose = space.pose(direction, args.roll.to_radians());
                let (t, q) = (pose.translation.vector, pose.rotation.coords);
                json!({
                    "id": id,
                    "direction": [direction.x, direction.y, direction.z],
                    "pose": { "position": [t.x, t.y, t.z], "orientation": [q.x, q.y, q.z, q.w] },
                })
            })
            .collect();
        let answer = json!({
            "count": views.len(),
            "min_elevation_deg": args.min_elevation,
            "max_elevation_deg": args.max_elevation,
            "radius": args.radius,
            "center": [x, y, z],
            "separation_deg": separation_deg,
            "best_known_deg": best_known_deg,
            "largest_hole_deg": covering_deg,
            "views": views,
        });
        writeln!(out, "{answer:#}")?;
    } else {
        writeln!(out, "separation {separation_deg:.3} deg, largest hole {covering_deg:.3} deg")?;
        if let Some(best_deg) = best_known_deg {
            let share = 100.0 * separation_deg / best_deg;
            writeln!(out, "best separation known {best_deg:.3} deg: {share:.2} % reached")?;
        }
        writeln!(out, "  id  azimuth elevation        x         y         z")?;
        for (id, direction) in set.directions.iter().enumerate() {
            let (azimuth, elevation) = azimuth_elevation_from_direction(direction);
            let at = space.position(direction);
            writeln!(
                out,
                "{id:4} {:8.2} {:9.2} {:9.4} {:9.4} {:9.4}",
                azimuth.to_degrees(),
                elevation.to_degrees(),
                at.x,
                at.y,
                at.z
            )?;
        }
    }
    Ok(())
}

fn print_table() -> CliResult {
    let bar = ProgressBar::new(MAX_VIEWS as u64);
    if let Ok(style) = ProgressStyle::with_template("{wide_bar} {pos}/{len} sets, {eta} left") {
        bar.set_style(style);
    }
    let mut out = std::io::stdout().lock();
    generate_table(|n, line| {
        bar.set_position(n as u64);
        writeln!(out, "{line}").and_then(|()| out.flush())
    })?;
    bar.finish_and_clear();
    Ok(())
}

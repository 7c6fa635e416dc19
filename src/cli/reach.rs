//! `prv reach`: which part of the band of views an arm can reach.

use std::io::{Read, Write};
use std::path::PathBuf;

use prv::api::{PlanRequestJson, ReachabilityAnswer, parse_json, reachability_of};

use super::CliResult;

/// Show which part of the band of views the arm of a request can reach, as a map, and where to put
/// the object instead.
#[derive(clap::Args)]
pub struct Args {
    /// The request, JSON as for `prv plan`; `-` reads standard input.
    file: PathBuf,
    /// Rows of the map, 1 to 90.
    #[arg(long, env = "PRV_ELEVATIONS")]
    elevations: Option<usize>,
    /// Columns of the map, 1 to 360.
    #[arg(long, env = "PRV_AZIMUTHS")]
    azimuths: Option<usize>,
    /// Print the JSON of `POST /v1/reachability`.
    #[arg(long, env = "PRV_JSON")]
    json: bool,
}

/// Letters of the map.
const LETTERS: [(&str, char); 8] = [
    ("ok", '.'),
    ("no_ik", 'i'),
    ("joint_limit", 'j'),
    ("self_collision", 's'),
    ("table_collision", 't'),
    ("object_collision", 'o'),
    ("obstacle_collision", 'x'),
    ("no_path", 'p'),
];

/// Asks and prints. A refused request prints its problem document to standard error.
pub fn run(args: &Args) -> CliResult {
    let bytes = if args.file.as_os_str() == "-" {
        let mut bytes = Vec::new();
        std::io::stdin().read_to_end(&mut bytes)?;
        bytes
    } else {
        std::fs::read(&args.file).map_err(|error| format!("{}: {error}", args.file.display()))?
    };
    let ask = || {
        let request: PlanRequestJson = parse_json(&bytes)?;
        reachability_of(&request, args.elevations, args.azimuths, &prv::motion::Stop::default())
    };
    let answer = match ask() {
        Ok(answer) => answer,
        Err(problem) => return Err(serde_json::to_string(&problem)?.into()),
    };
    if args.json {
        println!("{}", serde_json::to_string(&answer)?);
        return Ok(());
    }
    Ok(print(&answer, &mut std::io::stdout().lock())?)
}

fn print(answer: &ReachabilityAnswer, out: &mut impl Write) -> std::io::Result<()> {
    let percent = |fraction: f64| format!("{:.0} %", 100.0 * fraction);
    writeln!(out, "{} of the band can be reached", percent(answer.reachable_fraction))?;
    writeln!(out, "elevation, deg; azimuth 0 (+x) to 360 deg from left to right")?;
    for (row, part) in answer.grid.iter().zip(&answer.by_elevation).rev() {
        let letter =
            |code: &String| LETTERS.iter().find(|(name, _)| name == code).map_or('?', |(_, letter)| *letter);
        let cells: String = row.iter().map(letter).collect();
        writeln!(out, "{:6.1} {cells} {:>5}", part.angle_deg, percent(part.reachable_fraction))?;
    }
    for (code, letter) in LETTERS {
        if let Some(count) = answer.counts.get(code).filter(|count| **count > 0) {
            writeln!(out, "{letter} {code}: {count}")?;
        }
    }
    let place = |center: [f64; 3]| center.map(|v| format!("{v:.3}")).join(", ");
    writeln!(
        out,
        "object at ({}): {}",
        place(answer.given.center),
        percent(answer.given.reachable_fraction)
    )?;
    for suggestion in &answer.suggestions {
        writeln!(
            out,
            "better at ({}): {}",
            place(suggestion.center),
            percent(suggestion.reachable_fraction)
        )?;
    }
    answer.warnings.iter().try_for_each(|warning| writeln!(out, "{}: {}", warning.code, warning.message))
}

//! `prv draw`: a plan as a picture.

use std::path::{Path, PathBuf};

use prv::api::{PlanAnswer, PlanRequestJson, Problem, parse_json, plan_panel, reach_map};
use prv::draw::{Panel, hemispheres};

use super::CliResult;

/// Draw the views of a plan on their hemisphere, seen from above, as SVG: views numbered in the
/// order of the path, skipped ones crossed, and with the request the part of the band that the arm
/// reaches.
#[derive(clap::Args)]
pub struct Args {
    /// The plan, JSON as `prv plan` and POST /v1/plans answer it.
    plan: PathBuf,
    /// The request that the plan answers; its arm and cell tell what is shaded.
    #[arg(long, env = "PRV_REQUEST")]
    request: Option<PathBuf>,
    /// Another plan of the same cell, drawn to the right.
    #[arg(long, env = "PRV_BESIDE")]
    beside: Option<PathBuf>,
    /// Title of the plan; its file's name when left out.
    #[arg(long, env = "PRV_TITLE")]
    title: Option<String>,
    /// Title of the other plan; its file's name when left out.
    #[arg(long, env = "PRV_BESIDE_TITLE", requires = "beside")]
    beside_title: Option<String>,
    /// Rows of the shaded grid, 1 to 90.
    #[arg(long, env = "PRV_ELEVATIONS", requires = "request")]
    elevations: Option<usize>,
    /// Columns of the shaded grid, 1 to 360.
    #[arg(long, env = "PRV_AZIMUTHS", requires = "request")]
    azimuths: Option<usize>,
    /// File to write.
    #[arg(long, env = "PRV_OUT")]
    out: PathBuf,
    /// Print what was drawn as JSON.
    #[arg(long, env = "PRV_JSON")]
    json: bool,
}

/// Draws.
pub fn run(args: &Args) -> CliResult {
    let reach = match &args.request {
        Some(file) => {
            let request: PlanRequestJson = parse(file)?;
            Some(reach_map(&request, args.elevations, args.azimuths).map_err(|problem| said(&problem))?)
        }
        None => None,
    };
    let panel = |file: &Path, title: Option<&String>| -> Result<Panel, Box<dyn std::error::Error>> {
        let plan: PlanAnswer = parse(file)?;
        let name = || file.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let title = title.cloned().unwrap_or_else(name);
        Ok(plan_panel(&title, &plan, reach.clone())
            .map_err(|problem| format!("{}: {}", file.display(), said(&problem)))?)
    };
    let mut panels = vec![panel(&args.plan, args.title.as_ref())?];
    if let Some(beside) = &args.beside {
        panels.push(panel(beside, args.beside_title.as_ref())?);
    }
    let svg = hemispheres(&panels);
    std::fs::write(&args.out, &svg).map_err(|error| format!("{}: {error}", args.out.display()))?;
    if args.json {
        let drawn = panels
            .iter()
            .map(|panel| serde_json::json!({"planned": panel.planned.len(), "skipped": panel.skipped.len()}));
        let drawn: Vec<_> = drawn.collect();
        println!("{}", serde_json::json!({"file": args.out, "bytes": svg.len(), "panels": drawn}));
    } else {
        println!("{}: {} bytes", args.out.display(), svg.len());
    }
    Ok(())
}

fn parse<T: serde::de::DeserializeOwned>(file: &Path) -> Result<T, Box<dyn std::error::Error>> {
    let bytes = std::fs::read(file).map_err(|error| format!("{}: {error}", file.display()))?;
    Ok(parse_json(&bytes).map_err(|problem| format!("{}: {}", file.display(), said(&problem)))?)
}

/// The problem document of a refusal.
fn said(problem: &Problem) -> String {
    serde_json::to_string(problem).unwrap_or_default()
}

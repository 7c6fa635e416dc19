//! `prv check`: whether a plan is sound, and whether plans of random cells are.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use prv::api::{CheckAnswer, CheckedPlanJson, PlanRequestJson, check_plan, parse_json};
use serde_json::Value;

use super::check_random;

/// Check a plan against its request, by code of its own: view poses, limits, time law and
/// continuous collisions from the trajectory's points alone.
///
/// Exit codes: 0 sound, 1 violations (they are listed), 2 unreadable or refused.
#[derive(clap::Args)]
pub struct Args {
    /// The plan, JSON as POST /v1/plans answers it, changed or not; or {"request": .., "plan": ..}.
    #[arg(required_unless_present = "random")]
    plan: Option<PathBuf>,
    /// The request that the plan answers (GET /v1/plans/{id}/request for a stored one).
    #[arg(long, env = "PRV_REQUEST")]
    request: Option<PathBuf>,
    /// Instead of a plan from a file, plan and check this many random cells.
    #[arg(long, env = "PRV_RANDOM", conflicts_with_all = ["plan", "request"])]
    random: Option<u64>,
    /// Seed of the first random cell; the following ones count up.
    #[arg(long, env = "PRV_SEED", default_value_t = 0)]
    seed: u64,
    /// Most views of a random cell, 4 to 200.
    #[arg(long, env = "PRV_MOST_VIEWS", default_value_t = 40, value_parser = clap::value_parser!(u64).range(4..=200))]
    most_views: u64,
    /// File to which counts of every 100 seeds are appended; seeds that are in it are not run again.
    #[arg(long, env = "PRV_CHECK_LOG", requires = "random")]
    log: Option<PathBuf>,
    /// Print JSON: the answer of POST /v1/checks, or the counts of random cells.
    #[arg(long, env = "PRV_JSON")]
    json: bool,
}

/// Checks.
pub fn run(args: &Args) -> ExitCode {
    let verdict = match (&args.plan, args.random) {
        (_, Some(count)) => {
            let run = check_random::Run {
                first: args.seed,
                count,
                most_views: args.most_views as usize,
                log: args.log.as_deref(),
                json: args.json,
            };
            run.start()
        }
        (Some(plan), None) => {
            file(plan, args.request.as_deref()).and_then(|answer| print(&answer, args.json))
        }
        (None, None) => Err("no plan given".into()),
    };
    match verdict {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::from(1),
        Err(error) => {
            eprintln!("prv: {error}");
            ExitCode::from(2)
        }
    }
}

/// Whether all is sound.
pub type Verdict = Result<bool, Box<dyn std::error::Error>>;

#[derive(serde::Deserialize)]
struct Pair {
    request: Value,
    plan: Value,
}

fn file(plan: &Path, request: Option<&Path>) -> Result<CheckAnswer, Box<dyn std::error::Error>> {
    let read = |path: &Path| std::fs::read(path).map_err(|error| format!("{}: {error}", path.display()));
    let plan_bytes = read(plan)?;
    let (request, plan) = match request {
        Some(request) => (read(request)?, plan_bytes),
        None => {
            let pair: Pair = serde_json::from_slice(&plan_bytes).map_err(|error| {
                format!(
                    "{}: {error}; give the plan's request with --request, or both as {{\"request\", \"plan\"}}",
                    plan.display()
                )
            })?;
            (pair.request.to_string().into_bytes(), pair.plan.to_string().into_bytes())
        }
    };
    let checked = || {
        let request: PlanRequestJson = parse_json(&request)?;
        let plan: CheckedPlanJson = parse_json(&plan)?;
        check_plan(request, plan, &prv::motion::Stop::default())
    };
    Ok(checked().map_err(|problem| serde_json::to_string(&problem).unwrap_or_default())?)
}

fn print(answer: &CheckAnswer, json: bool) -> Verdict {
    if json {
        println!("{}", serde_json::to_string(answer)?);
        return Ok(answer.sound);
    }
    for violation in &answer.violations {
        println!("{}: {}", violation.code, violation.message);
    }
    let checked = &answer.checked;
    let count = answer.violations.len();
    let verdict = if answer.sound { "sound".to_owned() } else { format!("{count} violations") };
    println!("{verdict}: {} views, {} points, {:.2} s", checked.views, checked.points, checked.seconds);
    for (name, near) in
        [("nearest", &checked.smallest_clearance), ("nearest of its own", &checked.smallest_self_clearance)]
    {
        if let Some(near) = near {
            let [a, b] = &near.between;
            println!("{name}: {a} and {b}, {:.4} m at {:.2} s", near.distance_m, near.time);
        }
    }
    if checked.points > 0 {
        let share = 100.0 * checked.largest_speed_share;
        println!("fastest: {share:.1} % of a speed limit; {} states measured", checked.states);
    }
    Ok(answer.sound)
}

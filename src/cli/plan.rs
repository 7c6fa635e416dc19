//! `prv plan`: a plan without a service.

use std::io::Read;
use std::path::PathBuf;

use prv::api::{PlanRequestJson, Planner, parse_json};

use super::{CliResult, workers};

/// Plan the request in a file and print the plan: the same JSON as `POST /v1/plans`.
#[derive(clap::Args)]
pub struct Args {
    /// The request, JSON; `-` reads standard input.
    file: PathBuf,
    /// Another prediction model than the one in the executable.
    #[arg(long, env = "PRV_MODEL")]
    model: Option<PathBuf>,
    /// Threads for the prediction; 0 for one a core. The plan does not depend on it.
    #[arg(long, env = "PRV_THREADS", default_value_t = 0)]
    threads: usize,
    /// Indent the plan.
    #[arg(long, env = "PRV_PRETTY")]
    pretty: bool,
    /// The plan is JSON with and without this flag.
    #[arg(long, env = "PRV_JSON")]
    json: bool,
}

/// Plans. A refused request prints its problem document to standard error.
pub fn run(args: &Args) -> CliResult {
    let bytes = if args.file.as_os_str() == "-" {
        let mut bytes = Vec::new();
        std::io::stdin().read_to_end(&mut bytes)?;
        bytes
    } else {
        std::fs::read(&args.file).map_err(|error| format!("{}: {error}", args.file.display()))?
    };
    let threads = workers::threads(args.threads);
    let plan = || {
        let request: PlanRequestJson = parse_json(&bytes)?;
        Planner::load(args.model.as_deref(), threads, 1).plan(&request.into())
    };
    match plan() {
        Ok(plan) if args.pretty => println!("{}", serde_json::to_string_pretty(&plan)?),
        Ok(plan) => println!("{}", serde_json::to_string(&plan)?),
        Err(problem) => return Err(serde_json::to_string(&problem)?.into()),
    }
    Ok(())
}

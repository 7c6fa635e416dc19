//! `prv order`: the shortest path through given points.

use std::path::PathBuf;
use std::time::Duration;

use prv::geometry::Point;
use prv::order::{LocalPath, Obstacle, order_points};
use serde::Deserialize;
use serde_json::json;

use super::CliResult;

/// Find the shortest path through points around an object.
///
/// FILE holds {"points":[[x,y,z],..],"start":i,"obstacle":{"center":[x,y,z],"radius":r,"table_z":z}},
/// metres; obstacle and its table_z may be left out. Prints {"order","path_length_m","lower_bound_m",
/// "optimal"}: no path is shorter than lower_bound_m; optimal means within 1e-9 of it, relatively.
#[derive(clap::Args)]
pub struct Args {
    /// The problem, JSON; - reads it from standard input.
    file: PathBuf,
    /// Seconds to spend; counted in work done, so that the answer does not depend on the machine. A busy one, or
    /// many hundreds of points, which no cache holds, may take two or three times as long.
    #[arg(long, env = "PRV_ORDER_BUDGET", default_value_t = 10.0)]
    budget: f64,
    /// Also print the path as points at most this far apart, metres ("curve").
    #[arg(long, env = "PRV_CURVE_STEP")]
    curve_step: Option<f64>,
    /// Print JSON. It is what this command prints anyway.
    #[arg(long, env = "PRV_JSON")]
    json: bool,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Problem {
    points: Vec<[f64; 3]>,
    #[serde(default)]
    start: usize,
    #[serde(default)]
    obstacle: Option<Ball>,
    #[serde(default)]
    table_z: Option<f64>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Ball {
    center: [f64; 3],
    radius: f64,
    #[serde(default)]
    table_z: Option<f64>,
}

/// Runs the ordering.
pub fn run(args: &Args) -> CliResult {
    let name = args.file.display();
    let text = if args.file.as_os_str() == "-" {
        std::io::read_to_string(std::io::stdin())
    } else {
        std::fs::read_to_string(&args.file)
    }
    .map_err(|error| format!("{name}: {error}"))?;
    let problem: Problem = serde_json::from_str(&text).map_err(|error| format!("{name}: {error}"))?;
    let budget = Duration::try_from_secs_f64(args.budget)
        .map_err(|error| format!("--budget is {}: {error}", args.budget))?;
    let points: Vec<Point> = problem.points.iter().map(|&p| Point::from(p)).collect();
    let mut obstacle = Obstacle { table_z_m: problem.table_z, ..Obstacle::none() };
    if let Some(ball) = problem.obstacle {
        obstacle.center = Point::from(ball.center);
        obstacle.radius_m = ball.radius;
        obstacle.table_z_m = ball.table_z.or(obstacle.table_z_m);
    }
    let path = order_points(&points, problem.start, &obstacle, budget)?;
    let mut answer = json!({
        "order": path.order,
        "path_length_m": path.length,
        "lower_bound_m": path.lower_bound,
        "optimal": path.optimal,
    });
    if let Some(step) = args.curve_step {
        if !(step > 0.0 && step.is_finite()) {
            return Err(format!("--curve-step is {step} m, must be positive").into());
        }
        let legs: Vec<_> = path
            .order
            .windows(2)
            .map(|pair| LocalPath::between(points[pair[0]], points[pair[1]], &obstacle).sample(step))
            .map(|leg| leg.iter().map(|p| [p.x, p.y, p.z]).collect::<Vec<_>>())
            .collect();
        answer["curve"] = json!(legs);
    }
    println!("{answer:#}");
    Ok(())
}

//! `prv robots`: the built-in arms, their limits and where the numbers come from.

use prv::api::robot_details;
use prv::robot::RobotModel;

use super::CliResult;

/// List the built-in robots with their joints, limits and the sources of their numbers.
#[derive(clap::Args)]
pub struct Args {
    /// Only this robot.
    #[arg(env = "PRV_ROBOT")]
    model: Option<String>,
    /// Print JSON: under `robots` what GET /v1/robots/{model} answers for each.
    #[arg(long, env = "PRV_JSON")]
    json: bool,
}

/// Prints the list.
pub fn run(args: &Args) -> CliResult {
    let robots = match &args.model {
        Some(name) => vec![RobotModel::named(name)?],
        None => RobotModel::names().into_iter().map(RobotModel::named).collect::<Result<Vec<_>, _>>()?,
    };
    if args.json {
        let list: Vec<_> = robots.iter().map(robot_details).collect();
        println!("{:#}", serde_json::json!({ "robots": list }));
    } else {
        robots.iter().for_each(print);
    }
    Ok(())
}

fn print(robot: &RobotModel) {
    println!("{}  ({} -> {})", robot.name, robot.base_frame, robot.flange_frame);
    for joint in &robot.joints {
        println!(
            "  {:<20} {:>8.2} .. {:>7.2} deg {:>8.1} deg/s {:>8.1} deg/s2",
            joint.name,
            joint.lower_rad.to_degrees(),
            joint.upper_rad.to_degrees(),
            joint.max_speed_rad_per_s.to_degrees(),
            joint.max_acceleration_rad_per_s2.to_degrees(),
        );
    }
    println!("  solver: {}", robot.solver().description());
    robot.sources.iter().for_each(|source| println!("  - {source}"));
    println!();
}

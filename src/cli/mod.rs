//! The command line: one file a subcommand, each with its arguments and its `run`.

mod camera_flag;
mod capture;
mod check;
mod check_random;
mod draw;
mod evaluate;
mod health;
mod inputs;
mod label;
mod labels;
mod nerf;
mod objects;
mod openapi;
mod order;
mod plan;
mod predict;
mod reach;
mod render;
mod robots;
mod serve;
mod views;
mod views_search;
mod workers;

use std::process::ExitCode;

use clap::builder::BoolishValueParser;
use clap::{Arg, ArgAction, CommandFactory, FromArgMatches, Parser, Subcommand};

/// View planning for robots that reconstruct objects they have never seen.
#[derive(Parser)]
#[command(name = "prv", version, about, long_about = None)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

/// One variant a subcommand; each holds the arguments defined in the file of its name.
#[derive(Subcommand)]
enum Command {
    /// Photograph an object with the simulated camera.
    Capture(capture::Args),
    /// Check a plan, or plans of random cells.
    Check(check::Args),
    /// Draw a plan as a picture.
    Draw(draw::Args),
    /// Ask a running service whether it is ready.
    Health(health::Args),
    /// Render the initial photos of labelled objects, cut for training.
    Inputs(inputs::Args),
    /// Label objects with the number of views a NeRF of them needs.
    Label(label::Args),
    Labels(labels::Args),
    Evaluate(evaluate::Args),
    /// Train a NeRF on posed images and measure it.
    Nerf(nerf::Args),
    /// List the usable objects in folders and furniture libraries.
    Objects(objects::Args),
    /// Print the OpenAPI document.
    Openapi(openapi::Args),
    /// Find the shortest path through points around an object.
    Order(order::Args),
    /// Plan a request from a file.
    Plan(plan::Args),
    /// Predict how many views an object needs.
    Predict(predict::Args),
    /// Show which part of the band of views an arm can reach.
    Reach(reach::Args),
    /// Render an object.
    Render(render::Args),
    /// List the built-in robots, their limits and the sources of their numbers.
    Robots(robots::Args),
    /// Serve the HTTP interface; what `prv` does without a subcommand.
    Serve(serve::Args),
    /// Place views around an object, as far apart as they can be.
    Views(views::Args),
}

/// What a subcommand returns: an error is printed to stderr and becomes exit code 1.
pub type CliResult = Result<(), Box<dyn std::error::Error>>;

/// Parses the command line and runs it. Exit codes: 0 done, 1 failed, 2 bad usage (clap); those of
/// `check` are its own.
pub fn run() -> ExitCode {
    leave_quietly_when_nobody_reads();
    // Without a subcommand the program serves, so that `cargo run --release` does.
    let words: Vec<_> = std::env::args_os().collect();
    let words = if words.len() == 1 { vec!["prv".into(), "serve".into()] } else { words };
    let cli = Cli::from_arg_matches(&with_plain_booleans(Cli::command()).get_matches_from(words));
    let cli = cli.unwrap_or_else(|error| error.exit());
    let result: CliResult = match cli.command {
        Command::Capture(args) => capture::run(&args),
        Command::Check(args) => return check::run(&args),
        Command::Draw(args) => draw::run(&args),
        Command::Health(args) => health::run(&args),
        Command::Inputs(args) => inputs::run(&args),
        Command::Label(args) => label::run(&args),
        Command::Labels(args) => labels::run(&args),
        Command::Evaluate(args) => evaluate::run(&args),
        Command::Nerf(args) => nerf::run(&args),
        Command::Objects(args) => objects::run(&args),
        Command::Openapi(args) => openapi::run(&args),
        Command::Order(args) => order::run(&args),
        Command::Plan(args) => plan::run(&args),
        Command::Predict(args) => predict::run(&args),
        Command::Reach(args) => reach::run(&args),
        Command::Render(args) => render::run(&args),
        Command::Robots(args) => robots::run(&args),
        Command::Serve(args) => serve::run(&args),
        Command::Views(args) => views::run(&args),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) if is_broken_pipe(error.as_ref()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("prv: {error}");
            let mut source = error.source();
            while let Some(cause) = source {
                eprintln!("  caused by: {cause}");
                source = cause.source();
            }
            ExitCode::FAILURE
        }
    }
}

/// Lets the environment turn flags on and off as people write it: 1, yes and on as well as true.
fn with_plain_booleans(command: clap::Command) -> clap::Command {
    let plain = |flag: Arg| match flag.get_action() {
        ArgAction::SetTrue => flag.value_parser(BoolishValueParser::new()),
        _ => flag,
    };
    command.mut_args(plain).mut_subcommands(with_plain_booleans)
}

/// `prv robots | head -1`: whoever reads has enough. `println!` knows no other way to say so than a panic.
fn leave_quietly_when_nobody_reads() {
    let usual = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |panic| {
        let text = panic.payload().downcast_ref::<String>().map_or("", String::as_str);
        if text.starts_with("failed printing to stdout") && text.contains("Broken pipe") {
            std::process::exit(0);
        }
        usual(panic);
    }));
}

fn is_broken_pipe(error: &(dyn std::error::Error + 'static)) -> bool {
    let kind = error.downcast_ref::<std::io::Error>().map(std::io::Error::kind);
    kind == Some(std::io::ErrorKind::BrokenPipe)
}

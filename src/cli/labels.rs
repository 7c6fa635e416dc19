//! `prv labels`: joins label files and reads their curves again.

use std::collections::HashSet;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use indicatif::{ProgressBar, ProgressStyle};
use prv::label::protocol::{GAIN_DB, NEAR_DB, PAPER_ALPHA_DB};
use prv::label::reading::{Thresholds, read_label};
use prv::label::record::{LabelRecord, Reading};
use prv::label::store::{LabelStore, read_labels};

use super::{CliResult, workers};

/// Rows read before they are written: what a stop in between loses.
const ROWS_AT_ONCE: usize = 64;

/// Rows of a file that is there already which are read again to see that their thresholds are the same.
const ROWS_COMPARED: usize = 8;

/// Join label files (shards of `prv label`) and read the labels off their curves again.
///
/// Trains nothing: the PSNR of every NeRF is in the files. A row that several files have is taken from the first. Where
/// it is stopped, the same command goes on.
#[derive(clap::Args)]
pub struct Args {
    /// Label files.
    #[arg(required = true, env = "PRV_LABEL_FILES", value_delimiter = ',')]
    files: Vec<PathBuf>,
    /// File to write; rows it has already stay.
    #[arg(long, env = "PRV_LABELS")]
    out: PathBuf,
    /// v* is where one more view brings less than this, dB.
    #[arg(long, env = "PRV_ALPHA", default_value_t = PAPER_ALPHA_DB)]
    alpha: f64,
    /// v_gain, the label, is where one more view brings less than this, dB, on the steady curve.
    #[arg(long, env = "PRV_GAIN", default_value_t = GAIN_DB)]
    gain: f64,
    /// v_near is where the curve comes this close to its value at 100 views, dB.
    #[arg(long, env = "PRV_NEAR", default_value_t = NEAR_DB)]
    near: f64,
    /// Rows read side by side; 0 for one a core.
    #[arg(long, env = "PRV_JOBS", default_value_t = 0)]
    jobs: usize,
    /// Print JSON.
    #[arg(long, env = "PRV_JSON")]
    json: bool,
}

/// Joins and reads.
pub fn run(args: &Args) -> CliResult {
    for (name, value) in [("alpha", args.alpha), ("gain", args.gain), ("near", args.near)] {
        if !(value.is_finite() && value > 0.0) {
            return Err(format!("--{name} is {value}, must be greater than 0 dB").into());
        }
    }
    let thresholds = Thresholds { alpha_db: args.alpha, gain_db: args.gain, near_db: args.near };
    // Read before the file to write is opened: what is wrong with them leaves no file behind.
    let mut given = Vec::new();
    for file in &args.files {
        given.extend(read_labels(file)?.into_iter().map(|record| (file, record)));
    }
    if args.out.is_file() {
        refuse_other_thresholds(&args.out, thresholds)?;
    }
    let mut store = LabelStore::open(&args.out)?;
    let (before, mut twice) = (store.len(), 0);
    let (mut records, mut chosen) = (Vec::new(), HashSet::new());
    for (file, record) in given {
        let finished = store.is_finished(&record.object, record.draw, record.repeat);
        if finished || !chosen.insert((record.object.clone(), record.draw, record.repeat)) {
            twice += 1;
        } else {
            records.push((file, record, OnceLock::new()));
        }
    }
    let bar = ProgressBar::new(records.len() as u64).with_style(ProgressStyle::with_template(
        "{elapsed_precise} [{wide_bar}] {pos}/{len} rows, {eta_precise} left",
    )?);
    for part in records.chunks(ROWS_AT_ONCE) {
        let outcome = workers::side_by_side(workers::threads(args.jobs), part, |(file, record, reading)| {
            let LabelRecord { object, draw, repeat, .. } = record;
            let read = read_label(&record.samples, thresholds, record.seed).map_err(|error| {
                format!("{}, {object}, size {draw}, measurement {repeat}: {error}", file.display())
            })?;
            bar.inc(1);
            reading.set(read).map_err(|_| format!("{object} was read twice"))
        });
        // In the order of the files, up to the first that could not be read.
        for (_, record, reading) in part {
            let Some(reading) = reading.get() else { break };
            store.append(&LabelRecord { reading: *reading, ..record.clone() })?;
        }
        if let Err(error) = outcome {
            bar.abandon();
            return Err(error.into());
        }
    }
    bar.finish_and_clear();
    let added = store.len() - before;
    if args.json {
        println!("{}", serde_json::json!({ "rows": store.len(), "added": added, "already_there": twice }));
    } else {
        println!("{}: {} rows, {added} added, {twice} already there", args.out.display(), store.len());
    }
    Ok(())
}

/// Rows of a file that were read with other thresholds are of another label; a few of them tell.
fn refuse_other_thresholds(out: &Path, thresholds: Thresholds) -> CliResult {
    let rows = read_labels(out)?;
    for row in rows.iter().step_by((rows.len() / ROWS_COMPARED).max(1)) {
        let again = read_label(&row.samples, thresholds, row.seed)?;
        let numbers = |reading: &Reading| (reading.v_gain, reading.v_star, reading.v_near);
        if numbers(&again) != numbers(&row.reading) {
            let text = format!(
                "{}: its row of {} was read with other thresholds or by another version; give another --out",
                out.display(),
                row.object
            );
            return Err(text.into());
        }
    }
    Ok(())
}

//! `prv evaluate`: reproduces the paper's tables on held-out objects.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use indicatif::{ProgressBar, ProgressStyle};
use prv::evaluate::candidate::{Candidate, CandidateError};
use prv::evaluate::plot::bars;
use prv::evaluate::store::ReconstructionStore;
use prv::evaluate::table_one::TableOne;
use prv::evaluate::trial::{Outcome, Trial, TrialError, reconstruct};
use prv::files::replace_unsynced;
use prv::label::record::LabelRecord;
use prv::label::store::read_labels;
use prv::nerf::NerfSettings;
use prv::objects::{ObjectEntry, ObjectLookup};
use prv::predict::{Predictor, model_bytes};

use super::{CliResult, workers};

/// Reproduce tables of the paper on objects the network has not seen.
#[derive(clap::Args)]
pub struct Args {
    #[command(subcommand)]
    table: Table,
}

#[derive(clap::Subcommand)]
enum Table {
    Table1(TableOneArgs),
}

/// Compare PRVNet with mode, median and mean of the labels: Table I.
///
/// Reconstructs each held-out object with the number of views of every method, and compares with the result of its
/// own label: PSNR, SSIM and movement. Writes reconstructions.csv, which a stopped run resumes and other networks reuse,
/// and from it trials.csv, table1.csv, table1.md, table1.svg and settings.json, which names the networks.
#[derive(clap::Args)]
struct TableOneArgs {
    /// Folders or files where the labelled objects are (.sh3f libraries, OBJ, glTF); made objects need none.
    #[arg(long, env = "PRV_OBJECTS", num_args = 1..)]
    objects: Vec<String>,
    /// Label file of `prv label`.
    #[arg(long, env = "PRV_LABELS", default_value = "models/labels.csv")]
    labels: PathBuf,
    /// Another model than the one in the executable, or several of different turns (`make turns`): each is judged on
    /// the objects that it holds out, five on every object.
    #[arg(long, env = "PRV_MODEL", num_args = 1..)]
    model: Vec<PathBuf>,
    /// Folder to write to.
    #[arg(long, env = "PRV_OUT")]
    out: PathBuf,
    /// How many sizes of each object the networks have learnt from: mode, median and mean are of those labels, and of
    /// the ones that a network's epoch was chosen by. What is judged is the first size of each object that is held out.
    #[arg(long, env = "PRV_SIZES", default_value_t = 2, value_parser = clap::value_parser!(u64).range(1..))]
    sizes: u64,
    /// At most this many objects, the first of the label file.
    #[arg(long, env = "PRV_LIMIT")]
    limit: Option<usize>,
    /// Objects side by side, one thread each; 0 for one a core.
    #[arg(long, env = "PRV_JOBS", default_value_t = 1)]
    jobs: usize,
    /// Print the table as JSON.
    #[arg(long, env = "PRV_JSON")]
    json: bool,
}

/// Runs the comparison.
pub fn run(args: &Args) -> CliResult {
    let Table::Table1(args) = &args.table;
    let records = read_labels(&args.labels)?;
    let objects = ObjectLookup::new(&args.objects)?;
    std::fs::create_dir_all(&args.out)?;
    let jobs = workers::threads(args.jobs);
    let candidates = candidates(&args.model, &records, args.sizes)?;
    for Candidate { predictor, turn, known, .. } in &candidates {
        let trained_on = predictor.info().trained_on;
        if trained_on as usize != *known {
            eprintln!(
                "the model of turn {turn} has learnt from {trained_on} labels; mode, median and mean are of the {known} that it was trained or chosen by"
            );
        }
    }
    let store = Mutex::new(ReconstructionStore::open(&args.out.join("reconstructions.csv"))?);
    let held_out: Vec<(&LabelRecord, &Candidate)> = records
        .iter()
        .filter(|record| record.reading.v_gain.is_some())
        .filter_map(|record| {
            Some((record, candidates.iter().find(|candidate| candidate.may_be_judged_on(record))?))
        })
        .collect();
    let found: Vec<(ObjectEntry, &LabelRecord, &Candidate)> = held_out
        .iter()
        .filter_map(|(record, candidate)| Some((objects.get(&record.object)?, *record, *candidate)))
        .collect();
    let missing = held_out.len() - found.len();
    let work: Vec<_> = found.into_iter().take(args.limit.unwrap_or(usize::MAX)).collect();
    eprintln!("{} objects held out, {missing} of them not found; {} to judge", held_out.len(), work.len());
    if work.is_empty() {
        return Err("nothing to judge: no object of a held-out label was found in --objects".into());
    }
    let bar = ProgressBar::new(work.len() as u64).with_style(ProgressStyle::with_template(
        "{elapsed_precise} [{wide_bar}] {pos}/{len} objects, {eta_precise} left",
    )?);
    let (trials, failed) = (Mutex::new(BTreeMap::new()), AtomicUsize::new(0));
    let numbered: Vec<_> = work.iter().enumerate().collect();
    let outcome = workers::side_by_side(jobs, &numbered, |(index, (entry, record, candidate))| {
        match reconstruct(entry, record, candidate, &NerfSettings::label(), &store) {
            Ok(trial) => {
                trials.lock().map_err(|e| e.to_string())?.insert(*index, trial);
            }
            Err(TrialError::Store(error)) => return Err(error.to_string()),
            Err(error) => {
                failed.fetch_add(1, Ordering::Relaxed);
                bar.suspend(|| eprintln!("{}: {error}", record.object));
            }
        }
        bar.inc(1);
        Ok(())
    });
    bar.finish_and_clear();
    outcome?;
    let trials: Vec<Trial> = trials.into_inner().map_err(|e| e.to_string())?.into_values().collect();
    write_trials(args, &trials)?;
    report(args, &TableOne::of(&trials))?;
    let settings: serde_json::Value = candidates.iter().map(Candidate::settings).collect();
    write(args, "settings.json", format!("{settings:#}\n").as_bytes())?;
    match failed.into_inner() {
        0 => Ok(()),
        failed => Err(format!("{failed} objects could not be reconstructed and are not in the table").into()),
    }
}

/// The given models, or the one in the executable. A prediction takes far less than a reconstruction, so one session
/// each is enough.
fn candidates(
    models: &[PathBuf],
    records: &[LabelRecord],
    sizes: u64,
) -> Result<Vec<Candidate>, Box<dyn std::error::Error>> {
    let mut predictors = Vec::new();
    if models.is_empty() {
        predictors.push(Predictor::load(&model_bytes(None)?, 1, 1)?);
    }
    for path in models {
        predictors.push(Predictor::load(&model_bytes(Some(path))?, 1, 1)?);
    }
    Candidate::all(predictors, records, sizes).map_err(|error| match error {
        CandidateError::OtherLabels { .. } => format!("{error}: --sizes says which").into(),
        other => other.into(),
    })
}

/// Replaces a file of the folder by a whole one.
fn write(args: &TableOneArgs, name: &str, bytes: &[u8]) -> CliResult {
    Ok(replace_unsynced(&args.out.join(name), bytes)?)
}

fn write_trials(args: &TableOneArgs, trials: &[Trial]) -> CliResult {
    let mut csv = csv::Writer::from_writer(Vec::new());
    csv.write_record(["object", "draw", "method", "views", "psnr_db", "ssim", "movement_m"])?;
    for trial in trials {
        for Outcome { method, views, reconstruction } in &trial.outcomes {
            let counts = [trial.draw.to_string(), method.word().to_owned(), views.to_string()];
            let cells = std::iter::once(trial.object.clone()).chain(counts).chain(reconstruction.cells());
            csv.write_record(cells)?;
        }
    }
    write(args, "trials.csv", &csv.into_inner()?)
}

fn report(args: &TableOneArgs, table: &TableOne) -> CliResult {
    let markdown = table.markdown();
    write(args, "table1.md", markdown.as_bytes())?;
    write(args, "table1.svg", bars(table).as_bytes())?;
    let mut csv = csv::Writer::from_writer(Vec::new());
    csv.write_record([
        "method",
        "objects",
        "mean_views",
        "psnr_difference_db",
        "psnr_sd_db",
        "psnr_p",
        "ssim_difference",
        "ssim_sd",
        "ssim_p",
        "movement_difference_m",
        "movement_sd_m",
        "movement_p",
    ])?;
    for row in &table.rows {
        let mut cells =
            vec![row.method.word().to_owned(), table.objects.to_string(), format!("{:.2}", row.views.1)];
        for cell in &row.cells {
            let p = cell.p_value.map_or_else(String::new, |p| format!("{p:.4}"));
            cells.extend([format!("{:.6}", cell.mean), format!("{:.6}", cell.deviation), p]);
        }
        csv.write_record(cells)?;
    }
    write(args, "table1.csv", &csv.into_inner()?)?;
    if args.json {
        let rows: Vec<_> = table.rows.iter().map(|row| {
            let cell = |k: usize| serde_json::json!({
                "mean": row.cells[k].mean, "deviation": row.cells[k].deviation, "p_value": row.cells[k].p_value,
            });
            serde_json::json!({
                "method": row.method.word(), "views_min": row.views.0, "views_mean": row.views.1,
                "views_max": row.views.2, "psnr_difference_db": cell(0), "ssim_difference": cell(1),
                "movement_difference_m": cell(2),
            })
        }).collect();
        println!("{:#}", serde_json::json!({ "objects": table.objects, "rows": rows }));
    } else {
        print!("{markdown}");
    }
    Ok(())
}

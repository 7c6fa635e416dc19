//! `prv label`: how many views each object of a folder needs.

use std::path::PathBuf;
use std::str::FromStr;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use indicatif::{ProgressBar, ProgressStyle};
use prv::label::measure::{LabelSettings, measure};
use prv::label::protocol::{curve_design, seed_of};
use prv::label::record::{over_black, over_both, samples_text};
use prv::label::store::LabelStore;
use prv::nerf::NerfSettings;
use prv::objects::{ObjectEntry, select_objects};

use super::{CliResult, workers};

/// Labels objects with the number of views a NeRF of them needs; one CSV row an object.
///
/// May be killed at any time: a finished object is on disk before the next one starts.
#[derive(clap::Args)]
pub struct Args {
    /// Folders or files of objects (.sh3f libraries, OBJ, glTF), made:FAMILY/0..100, made:*/0..10, or .txt lists of
    /// such; with ~texture=0..3 at the end the variants of them in other textures.
    #[arg(long, env = "PRV_OBJECTS", required = true, num_args = 1..)]
    objects: Vec<String>,
    /// File to append to.
    #[arg(long, env = "PRV_LABELS", default_value = "labels.csv")]
    out: PathBuf,
    /// Part of the objects to label, as i/n with 0 <= i < n; the parts do not overlap.
    #[arg(long, env = "PRV_SHARD", default_value = "0/1")]
    shard: Shard,
    /// Continue a file that has rows; without it a file that has rows is left alone.
    #[arg(long, env = "PRV_RESUME")]
    resume: bool,
    /// Objects labelled side by side, one thread each; 0 for one a core.
    #[arg(long, env = "PRV_JOBS", default_value_t = 1)]
    jobs: usize,
    /// Stop after this many objects of the shard (they are in random order).
    #[arg(long, env = "PRV_LIMIT")]
    limit: Option<usize>,
    /// Sizes each object is labelled at, in 0.07 to 0.12 m; all objects get their first size first.
    #[arg(long, env = "PRV_SIZES", default_value_t = 1, value_parser = clap::value_parser!(u64).range(1..=20))]
    sizes: u64,
    /// Measure again with other NeRF seeds, turns of the view sets and test views: 0 for the first measurement.
    #[arg(long, env = "PRV_REPEAT", default_value_t = 0, value_parser = clap::value_parser!(u64).range(0..=1000))]
    repeat: u64,
    /// How each NeRF is trained. Views needed move with it: keep labels of two kinds in two files.
    #[arg(long, env = "PRV_TRAINING", value_enum, default_value_t = Training::Label)]
    training: Training,
    /// Exit with 0 although objects could not be labelled, as where a queue would start a failed job again. They are
    /// named on stderr, and tried again by the next run.
    #[arg(long, env = "PRV_ALLOW_FAILURES")]
    allow_failures: bool,
    /// Print one JSON line an object to stdout.
    #[arg(long, env = "PRV_JSON")]
    json: bool,
}

/// A preset of [`NerfSettings`].
#[derive(Clone, Copy, Debug, clap::ValueEnum)]
enum Training {
    /// 1,000 steps at low rates.
    Label,
    /// 750 steps at higher rates on a smaller table: like quality at 0.7 of the cost, and twice the noise.
    Fast,
}

impl Training {
    fn settings(self) -> NerfSettings {
        match self {
            Training::Label => NerfSettings::label(),
            Training::Fast => NerfSettings::label_fast(),
        }
    }
}

/// Part `index` of `count`.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Shard {
    index: u64,
    count: u64,
}

impl FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let bad = || format!("{text:?} is not a shard, must be i/n with 0 <= i < n, as in 0/4");
        let (index, count) = text.split_once('/').ok_or_else(bad)?;
        let shard =
            Self { index: index.parse().map_err(|_| bad())?, count: count.parse().map_err(|_| bad())? };
        if shard.index < shard.count { Ok(shard) } else { Err(bad()) }
    }
}

/// Runs the labelling.
pub fn run(args: &Args) -> CliResult {
    let store = LabelStore::open(&args.out)?;
    if !store.is_empty() && !args.resume {
        return Err(format!(
            "{} holds {} finished objects; give --resume to continue it",
            args.out.display(),
            store.len()
        )
        .into());
    }
    // Random order by hash, so that what is finished at any time is a fair sample, on any number of machines.
    let mut entries: Vec<ObjectEntry> = select_objects(&args.objects)?;
    entries.sort_by_cached_key(|entry| seed_of(&entry.key, 0));
    let all = entries.len();
    if all == 0 {
        let asked = args.objects.join(" ");
        return Err(
            format!("no usable object in {asked}; `prv objects --all` says what is wrong with each").into()
        );
    }
    entries.retain(|entry| seed_of(&entry.key, 1) % args.shard.count == args.shard.index);
    entries.truncate(args.limit.unwrap_or(usize::MAX));
    let work: Vec<(&ObjectEntry, u64)> = (0..args.sizes)
        .flat_map(|draw| entries.iter().map(move |entry| (entry, draw)))
        .filter(|(entry, draw)| !store.is_finished(&entry.key, *draw, args.repeat))
        .collect();
    eprintln!("{all} objects, {} labels of this shard to make, {} finished", work.len(), store.len());

    let nerfs: usize = curve_design().iter().map(|(_, nerfs)| nerfs).sum();
    let bar = ProgressBar::new((work.len() * nerfs) as u64).with_style(ProgressStyle::with_template(
        "{elapsed_precise} [{wide_bar}] {pos}/{len} NeRFs, {eta_precise} left {msg}",
    )?);
    let store = Mutex::new(store);
    let failed = AtomicUsize::new(0);
    let outcome = workers::side_by_side(workers::threads(args.jobs), &work, |&(entry, draw)| {
        let settings = LabelSettings { nerf: args.training.settings(), draw, repeat: args.repeat };
        match measure(entry, &settings, &mut |_, _| bar.inc(1)) {
            Ok(record) => {
                let mut store = store.lock().map_err(|e| e.to_string())?;
                store.append(&record).map_err(|e| e.to_string())?;
                let reading = &record.reading;
                bar.set_message(format!(
                    "{} gain={:?} near={} v*={:?}",
                    record.object, reading.v_gain, reading.v_near, reading.v_star
                ));
                if args.json {
                    let line = serde_json::json!({
                        "object": record.object, "draw": record.draw, "repeat": record.repeat,
                        "radius_m": record.radius_m, "status": reading.status.word(),
                        "v_gain": reading.v_gain, "v_gain_sigma": reading.v_gain_sigma,
                        "v_star": reading.v_star, "v_star_sigma": reading.v_star_sigma,
                        "v_near": reading.v_near, "v_near_sigma": reading.v_near_sigma,
                        "rms_db": reading.rms_db, "psnr_db": samples_text(&record.samples, over_black),
                        "psnr_both_db": samples_text(&record.samples, over_both), "cpu_s": record.cpu_s,
                    });
                    println!("{line}");
                }
            }
            Err(error) => {
                failed.fetch_add(1, Ordering::Relaxed);
                bar.suspend(|| eprintln!("{}: {error}", entry.key));
            }
        }
        Ok(())
    });
    bar.finish();
    outcome?;
    let failures = |n| format!("{n} of the labels could not be made; see the lines above");
    match failed.into_inner() {
        0 => Ok(()),
        n if args.allow_failures => {
            eprintln!("{}", failures(n));
            Ok(())
        }
        n => Err(failures(n).into()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_cannot_be_labelled_fails_the_command_unless_failures_are_allowed() {
        let folder = tempfile::tempdir().unwrap();
        let broken = folder.path().join("broken.obj");
        // Enough triangles and colours, and a texture coordinate that is not there.
        let faces = |colour: u32| format!("usemtl {colour}\n{}", "f 1/9 2/9 3/9\n".repeat(40));
        let vertices = "mtllib broken.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\n".to_owned();
        std::fs::write(&broken, vertices + &faces(1) + &faces(2) + &faces(3)).unwrap();
        let colour = |colour: u32| format!("newmtl {colour}\nKd 0.{colour} 0.5 0.2\n");
        std::fs::write(folder.path().join("broken.mtl"), colour(1) + &colour(2) + &colour(3)).unwrap();
        let args = |object: &str, allow_failures| Args {
            objects: vec![folder.path().join(object).display().to_string()],
            out: folder.path().join("labels.csv"),
            shard: Shard { index: 0, count: 1 },
            resume: true,
            jobs: 1,
            limit: None,
            sizes: 1,
            repeat: 0,
            training: Training::Label,
            allow_failures,
            json: false,
        };
        let refused = run(&args("broken.obj", false)).unwrap_err().to_string();
        assert!(refused.starts_with("1 of the labels could not be made"), "{refused}");
        run(&args("broken.obj", true)).unwrap();
        assert!(LabelStore::open(&folder.path().join("labels.csv")).unwrap().is_empty());

        std::fs::write(folder.path().join("small.obj"), "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n").unwrap();
        let nothing = run(&args("small.obj", true)).unwrap_err().to_string();
        assert!(nothing.contains("small.obj") && nothing.contains("--all"), "{nothing}");
    }
}

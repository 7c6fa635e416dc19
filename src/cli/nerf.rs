//! `prv nerf`: trains a NeRF on a folder of posed images and measures it.

use std::path::{Path, PathBuf};
use std::time::Instant;

use indicatif::{ProgressBar, ProgressStyle};
use prv::geometry::Point;
use prv::imaging::transforms::{DEFAULT_TEST_EVERY, ImageSet, read_transforms};
use prv::nerf::{Bounds, Nerf, NerfSettings, train};

use super::CliResult;

/// Train a NeRF on a folder with a transforms.json and print PSNR and SSIM on its test frames.
///
/// Reads folders of this program, instant-ngp, nerfstudio and synthetic NeRF. One thread.
#[derive(clap::Args)]
pub struct Args {
    /// Folder with transforms.json, or transforms_train.json and transforms_test.json.
    dir: PathBuf,
    /// Optimiser steps.
    #[arg(long, env = "PRV_STEPS", default_value_t = NerfSettings::standard().steps)]
    steps: u32,
    /// Samples with colour and gradient in a step.
    #[arg(long, env = "PRV_SAMPLES", default_value_t = NerfSettings::standard().samples_per_step)]
    samples: u32,
    /// Seed of weights, rays and backgrounds.
    #[arg(long, env = "PRV_SEED", default_value_t = 0)]
    seed: u64,
    /// Trust the images' alpha: nothing may appear where one view shows only background. For
    /// masks as exact as rendered ones; steadier and better, above all for thin parts.
    #[arg(long, env = "PRV_CARVE")]
    carve: bool,
    /// Where the folder names no test frames, hold out every so manieth, beginning with the first; 0 for none.
    #[arg(long, env = "PRV_TEST_EVERY", default_value_t = DEFAULT_TEST_EVERY)]
    test_every: usize,
    /// Centre of the cube that holds the object, x,y,z in the poses' unit; default: from the file.
    #[arg(long, env = "PRV_CENTER", value_delimiter = ',', num_args = 3, allow_hyphen_values = true)]
    center: Option<Vec<f64>>,
    /// Half the edge of that cube; default: from the file.
    #[arg(long, env = "PRV_HALF_EXTENT", allow_hyphen_values = true)]
    half_extent: Option<f64>,
    /// Write the renders of the test frames (of the training frames if there are none) into this folder.
    #[arg(long, env = "PRV_OUT")]
    out: Option<PathBuf>,
    /// Print JSON.
    #[arg(long, env = "PRV_JSON")]
    json: bool,
}

/// Trains and measures.
pub fn run(args: &Args) -> CliResult {
    let set = read_transforms(&args.dir, args.test_every)?;
    let bounds = bounds(args, &set);
    let settings = NerfSettings {
        steps: args.steps,
        samples_per_step: args.samples,
        seed: args.seed,
        carve: args.carve,
        ..NerfSettings::standard()
    };
    settings.check()?;
    let bar = ProgressBar::new(u64::from(settings.steps));
    bar.set_style(ProgressStyle::with_template("training {bar:40} {pos}/{len} loss {msg} {eta} left")?);
    let started = Instant::now();
    let nerf = train(&set.train, &bounds, &settings, &mut |progress| {
        if progress.step % 50 == 0 || progress.step == progress.steps {
            bar.set_message(format!("{:.5}", progress.loss));
            bar.set_position(u64::from(progress.step));
        }
    })?;
    bar.finish_and_clear();
    let seconds = started.elapsed().as_secs_f64();
    if let Some(out) = &args.out {
        write_renders(&nerf, if set.test.is_empty() { &set.train } else { &set.test }, out)?;
    }
    let evaluation = nerf.evaluate(&set.test);
    let tested = !set.test.is_empty();
    if args.json {
        let frames: Vec<_> = (evaluation.psnr_db.iter().zip(&evaluation.ssim))
            .map(|(psnr, ssim)| serde_json::json!({ "psnr_db": psnr, "ssim": ssim }))
            .collect();
        let answer = serde_json::json!({
            "psnr_db": tested.then(|| evaluation.mean_psnr_db()),
            "ssim": tested.then(|| evaluation.mean_ssim()),
            "train_frames": set.train.len(), "test_frames": frames,
            "steps": settings.steps, "samples_per_step": settings.samples_per_step, "seed": settings.seed,
            "train_s": seconds, "instruction_set": settings.instruction_set.name(),
        });
        println!("{answer:#}");
    } else if tested {
        println!("PSNR {:.2} dB", evaluation.mean_psnr_db());
        println!("SSIM {:.4}", evaluation.mean_ssim());
    }
    let (train, test) = (set.train.len(), set.test.len());
    eprintln!(
        "trained on {train} frames in {seconds:.1} s ({}), tested on {test}",
        settings.instruction_set.name()
    );
    if !tested {
        eprintln!("no test frames: nothing measured; --test-every holds some out");
    }
    Ok(())
}

fn bounds(args: &Args, set: &ImageSet) -> Bounds {
    let mut bounds = Bounds::from(set.cube);
    if let Some([x, y, z]) = args.center.as_deref() {
        bounds.center = Point::new(*x, *y, *z);
    }
    if let Some(half_extent_m) = args.half_extent {
        bounds.half_extent_m = half_extent_m;
    }
    bounds
}

fn write_renders(nerf: &Nerf, views: &[prv::imaging::PosedImage], out: &Path) -> CliResult {
    std::fs::create_dir_all(out).map_err(|error| format!("{}: {error}", out.display()))?;
    for (i, view) in views.iter().enumerate() {
        let path = out.join(format!("{i:04}.png"));
        nerf.render(&view.camera, &view.world_from_camera)
            .save(&path)
            .map_err(|error| format!("{}: {error}", path.display()))?;
    }
    Ok(())
}

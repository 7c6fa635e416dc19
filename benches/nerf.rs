//! NeRF: speed and quality of training, for each instruction set this CPU has.
//!
//! CPU seconds depend on what else runs on the core's other thread and on its caches;
//! the core's own multiply-add rate, measured first, tells how much of it there was.
//! `PRV_BENCH_STEPS=1500x2048,2500x4096` chooses other budgets, `PRV_BENCH_OBJECT` another object.

mod common;

use std::hint::black_box;

use common::row;
use prv::geometry::{Point, Pose, direction_from_azimuth_elevation, look_at};
use prv::imaging::{Camera, PosedImage};
use prv::nerf::{Bounds, InstructionSet, NerfSettings, train};
use prv::render::{RenderSettings, Renderer, sample_names, sample_object};

const RADIUS_M: f64 = 0.1;
const VIEWS: usize = 50;
const TESTS: usize = 24;

fn main() {
    let name = std::env::var("PRV_BENCH_OBJECT").unwrap_or_else(|_| "robot".to_owned());
    let Some(mesh) = sample_object(&name) else {
        eprintln!("PRV_BENCH_OBJECT={name}: no such object, there are {:?}", sample_names());
        return;
    };
    let renderer = Renderer::new(&mesh.fitted(Point::origin(), RADIUS_M));
    let camera = Camera::square(128, 0.36);
    let (train_set, test_set) =
        (views(&renderer, &camera, VIEWS, 0.0), views(&renderer, &camera, TESTS, 1.0));
    let bounds = Bounds { center: Point::origin(), half_extent_m: RADIUS_M };
    if let Some(rate) = register_gflops() {
        row("this core's fused multiply-adds, right now", rate, "GFLOP/s", None);
    }
    for settings in budgets() {
        for set in InstructionSet::available() {
            let settings = NerfSettings { instruction_set: set, ..settings };
            let budget = format!("{name} {}x{} {}", settings.steps, settings.samples_per_step, set.name());
            let start = cpu_seconds();
            let Ok(nerf) = train(&train_set, &bounds, &settings, &mut |_| {}) else { return };
            let trained = cpu_seconds() - start;
            let start = cpu_seconds();
            let psnr = nerf.psnr_db(&test_set);
            let tested = cpu_seconds() - start;
            let samples = f64::from(settings.steps) * f64::from(settings.samples_per_step);
            // The bounds are for AVX-512 and AVX2 on a core that has 250 GFLOP/s of the former.
            let bound = match set.name() {
                "avx512" => Some(2.3),
                "avx2" => Some(4.6),
                _ => None,
            };
            row(&format!("{budget}: training, {VIEWS} views"), trained, "s", bound);
            row(&format!("{budget}: kept samples"), samples / trained * 1e-6, "M/s", None);
            row(&format!("{budget}: a 128x128 test view"), tested / TESTS as f64 * 1e3, "ms", Some(8.0));
            let mean = psnr.iter().sum::<f64>() / psnr.len() as f64;
            println!(
                "{:<58} {mean:>12.3} dB     at least 29.000  {}",
                format!("{budget}: PSNR"),
                if mean >= 29.0 { "ok" } else { "UNDER" }
            );
        }
    }
}

/// The presets, or what the environment asks for.
fn budgets() -> Vec<NerfSettings> {
    let Ok(asked) = std::env::var("PRV_BENCH_STEPS") else {
        return vec![
            NerfSettings::label(),
            NerfSettings::label_fast(),
            NerfSettings::carved(),
            NerfSettings::standard(),
        ];
    };
    let parse = |text: &str| {
        let (steps, samples) = text.split_once('x')?;
        let (steps, samples_per_step) = (steps.parse().ok()?, samples.parse().ok()?);
        Some(NerfSettings { steps, samples_per_step, ..NerfSettings::standard() })
    };
    asked.split(',').filter_map(parse).collect()
}

/// Views in a golden spiral on the upper hemisphere.
fn views(renderer: &Renderer, camera: &Camera, count: usize, turn: f64) -> Vec<PosedImage> {
    (0..count)
        .map(|i| {
            let elevation = (0.08 + 0.9 * (i as f64 + 0.5) / count as f64).asin();
            let toward = direction_from_azimuth_elevation(i as f64 * 2.399_963 + turn, elevation);
            let eye = Point::origin() + toward.into_inner() * 0.3;
            let world_from_camera: Pose = look_at(&eye, &Point::origin(), 0.0);
            let image = renderer.render(camera, &world_from_camera, &RenderSettings::default());
            PosedImage { image, camera: *camera, world_from_camera }
        })
        .collect()
}

/// CPU seconds of this thread; of the clock on the wall where the system does not tell.
fn cpu_seconds() -> f64 {
    let stat = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap_or_default();
    match stat.split(' ').next().and_then(|ns| ns.parse::<f64>().ok()) {
        Some(ns) => ns * 1e-9,
        None => std::time::SystemTime::now()
            .duration_since(std::time::UNIX_EPOCH)
            .map_or(0.0, |since| since.as_secs_f64()),
    }
}

/// What eight chains of the widest fused multiply-add reach; `None` without the instruction.
fn register_gflops() -> Option<f64> {
    const CHAINS: usize = 16;
    const WIDTH: usize = 16;
    // One array of lanes a chain and a loop over lanes inside: what compilers turn into vectors.
    #[inline(always)]
    fn chains(rounds: u32) -> f32 {
        let mut x = [1.0f32; CHAINS * WIDTH];
        for _ in 0..rounds {
            for lane in &mut x {
                *lane = lane.mul_add(0.999, 0.001);
            }
        }
        x.iter().sum()
    }
    #[cfg(target_arch = "x86_64")]
    {
        #[target_feature(enable = "avx512f")]
        fn avx512(rounds: u32) -> f32 {
            chains(rounds)
        }
        #[target_feature(enable = "avx2,fma")]
        fn avx2(rounds: u32) -> f32 {
            chains(rounds)
        }
        let rounds = black_box(2_000_000);
        let start = cpu_seconds();
        match InstructionSet::best().name() {
            // SAFETY: the best set has these instructions.
            "avx512" => black_box(unsafe { avx512(rounds) }),
            // SAFETY: as above.
            "avx2" => black_box(unsafe { avx2(rounds) }),
            _ => return None,
        };
        let flops = 2.0 * f64::from(rounds) * (CHAINS * WIDTH) as f64;
        return Some(flops / (cpu_seconds() - start) * 1e-9);
    }
    #[allow(unreachable_code)]
    None
}

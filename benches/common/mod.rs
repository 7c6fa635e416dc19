//! What the benches share: a median of several runs, and one row a figure.
#![allow(dead_code)]

use std::time::Instant;

/// Median over `runs` runs of the seconds that one of `repeats` calls takes.
pub fn median_time(runs: usize, repeats: usize, mut call: impl FnMut()) -> f64 {
    call();
    let mut seconds: Vec<f64> = (0..runs.max(1))
        .map(|_| {
            let start = Instant::now();
            (0..repeats.max(1)).for_each(|_| call());
            start.elapsed().as_secs_f64() / repeats.max(1) as f64
        })
        .collect();
    seconds.sort_by(f64::total_cmp);
    seconds[seconds.len() / 2]
}

/// As [`median_time`] in processor seconds of this thread: what other processes take does not count, only
/// what they do to the caches. Wall seconds where the system is not Linux.
pub fn median_processor_time(runs: usize, repeats: usize, mut call: impl FnMut()) -> f64 {
    call();
    let mut seconds: Vec<f64> = (0..runs.max(1))
        .map(|_| {
            let start = processor_seconds();
            (0..repeats.max(1)).for_each(|_| call());
            (processor_seconds() - start) / repeats.max(1) as f64
        })
        .collect();
    seconds.sort_by(f64::total_cmp);
    seconds[seconds.len() / 2]
}

/// What one call returns, and the processor seconds of this thread that it took.
pub fn processor_time<T>(call: impl FnOnce() -> T) -> (T, f64) {
    let start = processor_seconds();
    let value = call();
    (value, processor_seconds() - start)
}

#[cfg(target_os = "linux")]
fn processor_seconds() -> f64 {
    let time = rustix::time::clock_gettime(rustix::time::ClockId::ThreadCPUTime);
    time.tv_sec as f64 + time.tv_nsec as f64 * 1e-9
}

#[cfg(not(target_os = "linux"))]
fn processor_seconds() -> f64 {
    static START: std::sync::LazyLock<Instant> = std::sync::LazyLock::new(Instant::now);
    START.elapsed().as_secs_f64()
}

/// Prints a figure beside its bound, and whether it holds.
pub fn row(name: &str, value: f64, unit: &str, bound: Option<f64>) {
    match bound {
        Some(bound) => {
            let verdict = if value <= bound { "ok" } else { "OVER" };
            println!("{name:<58} {value:>12.3} {unit:<6} bound {bound:>10.3}  {verdict}");
        }
        None => println!("{name:<58} {value:>12.3} {unit}"),
    }
}

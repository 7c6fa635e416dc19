//! Simulated time against the wall clock.

use std::time::{Duration, Instant};

use super::SimulateError;

/// Slowest pace.
pub const MIN_SPEED_FACTOR: f64 = 0.01;
/// Fastest pace; rendering is slower than that.
pub const MAX_SPEED_FACTOR: f64 = 100_000.0;

/// Maps simulated seconds to moments of the wall clock.
pub(super) struct Pace {
    speed_factor: f64,
    moment: Instant,
    time_s: f64,
}

impl Pace {
    pub(super) fn start(speed_factor: f64) -> Result<Self, SimulateError> {
        let (least, most) = (MIN_SPEED_FACTOR, MAX_SPEED_FACTOR);
        if !(least..=most).contains(&speed_factor) {
            return Err(SimulateError::SpeedFactor { value: speed_factor, least, most });
        }
        Ok(Self { speed_factor, moment: Instant::now(), time_s: 0.0 })
    }

    /// The simulated time now, seconds.
    pub(super) fn now_s(&self) -> f64 {
        self.time_s + self.moment.elapsed().as_secs_f64() * self.speed_factor
    }

    /// Says that it is `time_s` now: the arm stands still while a photo is rendered.
    pub(super) fn resume_at(&mut self, time_s: f64) {
        self.moment = Instant::now();
        self.time_s = time_s;
    }

    /// How long to sleep until `time_s`, at most `longest`; zero when it is past.
    pub(super) fn until(&self, time_s: f64, longest: Duration) -> Duration {
        let seconds = ((time_s - self.now_s()) / self.speed_factor).clamp(0.0, longest.as_secs_f64());
        Duration::from_secs_f64(seconds)
    }
}

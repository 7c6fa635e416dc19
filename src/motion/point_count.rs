//! How many points a trajectory has before it is sampled.

use super::error::MotionError;
use super::request::Timing;

/// Most points of a trajectory. A point of a seven-joint arm takes some 450 bytes of JSON: the whole
/// stays below 25 MB, what a checker's request can hold.
pub const MOST_POINTS: usize = 50_000;

/// Periods that are proposed are whole multiples of this, seconds.
const PROPOSED_STEP_S: f64 = 1e-3;

/// Points of a motion of `period_s` that takes `duration_s`, its beginning left out.
pub(super) fn samples(duration_s: f64, period_s: f64) -> f64 {
    (duration_s / period_s).ceil().max(1.0)
}

/// Refuses motions from rest to rest of these durations whose samples, with `stops` rests between
/// them, are more than [`MOST_POINTS`], and says which period would do.
pub(super) fn check(durations_s: &[f64], stops: usize, timing: &Timing) -> Result<(), MotionError> {
    // A rest has a point where the arm comes to stand and one where it leaves; the first of all a third.
    let count = |period_s: f64| {
        let moving: f64 = durations_s.iter().map(|duration_s| samples(*duration_s, period_s)).sum();
        moving + (2 * stops + 1) as f64
    };
    let most = MOST_POINTS as f64;
    if count(timing.sample_period_s) <= most {
        return Ok(());
    }
    let steps = (Timing::SAMPLE_PERIOD_S.1 / PROPOSED_STEP_S).round() as usize;
    let candidates: Vec<usize> = (1..=steps).collect();
    let first = candidates.partition_point(|step| count(*step as f64 * PROPOSED_STEP_S) > most);
    Err(MotionError::TooManyPoints {
        most: MOST_POINTS,
        duration_s: durations_s.iter().sum(),
        sample_period_s: timing.sample_period_s,
        speed_scale: timing.speed_scale,
        least_period_s: candidates.get(first).map(|step| *step as f64 * PROPOSED_STEP_S),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn timing(sample_period_s: f64) -> Timing {
        Timing { sample_period_s, ..Timing::default() }
    }

    #[test]
    fn the_period_that_is_proposed_is_the_least_that_does() {
        let durations_s = vec![3.3; 100];
        let Err(MotionError::TooManyPoints { least_period_s: Some(least_s), .. }) =
            check(&durations_s, 100, &timing(0.001))
        else {
            panic!("330,000 points are too many")
        };
        assert_eq!(check(&durations_s, 100, &timing(least_s)), Ok(()));
        assert!(check(&durations_s, 100, &timing(least_s - PROPOSED_STEP_S)).is_err());
    }

    #[test]
    fn a_motion_too_long_for_any_period_is_refused_without_one() {
        let error = check(&[1e6], 1, &timing(0.04)).unwrap_err();
        assert!(matches!(error, MotionError::TooManyPoints { least_period_s: None, .. }), "{error}");
        assert!(check(&[f64::INFINITY], 1, &timing(0.04)).is_err());
    }
}

//! From the NeRFs of an object to its label: the fit, both definitions, their noise and the status.

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::fit::{CurvePoint, FitError, fit_curve, refit};
use super::lognormal::{LogNormalCurve, MAX_VIEWS};
use super::protocol::{CEILING_VIEWS, NEAR_DB, PAPER_ALPHA_DB};
use super::record::{CurveSample, LabelStatus, Reading, curve_points};

/// Where on a curve a label is read.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Thresholds {
    /// v* is where one more view brings less than this, dB (paper, equation 1).
    pub alpha_db: f64,
    /// v_near is where the curve is this close to its value at 100 views, dB.
    pub near_db: f64,
}

impl Default for Thresholds {
    /// The paper's alpha and [`NEAR_DB`].
    fn default() -> Self {
        Self { alpha_db: PAPER_ALPHA_DB, near_db: NEAR_DB }
    }
}

const BOOTSTRAP_DRAWS: usize = 100;
/// A set better than the ceiling by this many standard errors of the two is better by more than noise.
const BETTER_SIGMAS: f64 = 3.0;

/// Reads the label off the NeRFs; deterministic in `seed`, which only moves the two sigmas.
///
/// # Errors
/// [`FitError`] for too few or non-finite points.
pub fn read_label(samples: &[CurveSample], thresholds: Thresholds, seed: u64) -> Result<Reading, FitError> {
    let points = curve_points(samples);
    let fit = fit_curve(&points)?;
    let v_star = fit.curve.required_views(thresholds.alpha_db);
    let (v_star_sigma, v_near_sigma) = sigmas(&points, &fit.curve, thresholds, seed);
    Ok(Reading {
        status: status(samples, v_star),
        v_star,
        v_star_sigma,
        v_near: views_near_ceiling(&fit.curve, thresholds.near_db),
        v_near_sigma,
        curve: fit.curve,
        rms_db: fit.rms_db,
    })
}

/// The fewest views whose value on the curve is within `near_db` of that of 100 views.
pub fn views_near_ceiling(curve: &LogNormalCurve, near_db: f64) -> u32 {
    let enough = curve.value(CEILING_VIEWS as f64) - near_db;
    (1..CEILING_VIEWS as u32).find(|&v| curve.value(f64::from(v)) >= enough).unwrap_or(CEILING_VIEWS as u32)
}

/// Standard deviations of v* and v_near (views) by residual bootstrap: curves are fitted to the
/// fitted values plus residuals drawn with replacement. A draw whose curve has no v* counts as
/// [`MAX_VIEWS`].
fn sigmas(points: &[CurvePoint], curve: &LogNormalCurve, thresholds: Thresholds, seed: u64) -> (f64, f64) {
    let residuals: Vec<f64> = points.iter().map(|&(x, y)| y - curve.value(x)).collect();
    if residuals.is_empty() {
        return (0.0, 0.0);
    }
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let (star, near): (Vec<f64>, Vec<f64>) = (0..BOOTSTRAP_DRAWS)
        .map(|_| {
            let redrawn: Vec<CurvePoint> = points
                .iter()
                .map(|&(x, _)| (x, curve.value(x) + residuals[rng.random_range(0..residuals.len())]))
                .collect();
            let redrawn = refit(&redrawn, *curve).curve;
            let star = redrawn.required_views(thresholds.alpha_db).unwrap_or(MAX_VIEWS);
            (f64::from(star), f64::from(views_near_ceiling(&redrawn, thresholds.near_db)))
        })
        .unzip();
    (standard_deviation(&star), standard_deviation(&near))
}

fn standard_deviation(values: &[f64]) -> f64 {
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    let squares = values.iter().map(|v| (v - mean).powi(2)).sum::<f64>();
    (squares / values.len().saturating_sub(1).max(1) as f64).sqrt()
}

fn status(samples: &[CurveSample], v_star: Option<u32>) -> LabelStatus {
    let Some(ceiling) = samples.iter().find(|s| s.views == CEILING_VIEWS) else { return LabelStatus::Ok };
    // The spread of NeRFs of one number of views, over those that have several.
    let spreads = samples.iter().filter(|s| s.psnr_db.len() > 1 && s.views > CEILING_VIEWS / 5);
    let variances: Vec<f64> = spreads.map(|s| standard_deviation(&s.psnr_db).powi(2)).collect();
    let variance = variances.iter().sum::<f64>() / variances.len().max(1) as f64;
    let better = |s: &CurveSample| {
        let error = (variance / s.psnr_db.len().max(1) as f64
            + variance / ceiling.psnr_db.len().max(1) as f64)
            .sqrt();
        s.views < CEILING_VIEWS && s.mean_db() > ceiling.mean_db() + BETTER_SIGMAS * error
    };
    match v_star {
        None => LabelStatus::NoPlateau,
        Some(_) if samples.iter().any(better) => LabelStatus::NotConverged,
        Some(_) => LabelStatus::Ok,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::label::protocol::curve_design;

    const TRUTH: LogNormalCurve = LogNormalCurve { y0: 12.0, amplitude: 22.0, x_c: 5.0, width: 0.9 };

    fn measured(seed: u64, noise_db: f64) -> Vec<CurveSample> {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let mut noisy = |v: usize| TRUTH.value(v as f64) + rng.random_range(-1.7..1.7) * noise_db;
        let design = curve_design();
        design
            .into_iter()
            .map(|(views, n)| CurveSample { views, psnr_db: (0..n).map(|_| noisy(views)).collect() })
            .collect()
    }

    #[test]
    fn exact_samples_give_both_numbers_of_their_curve() {
        let reading = read_label(&measured(0, 0.0), Thresholds::default(), 0).unwrap();
        assert_eq!(reading.v_star, TRUTH.required_views(PAPER_ALPHA_DB));
        assert_eq!(reading.v_near, views_near_ceiling(&TRUTH, NEAR_DB));
        assert_eq!(reading.status, LabelStatus::Ok);
        assert!(reading.v_star_sigma < 0.5 && reading.v_near_sigma < 0.5);
    }

    #[test]
    fn the_sigmas_tell_how_far_repeated_labels_scatter() {
        let readings: Vec<Reading> = (0..24)
            .map(|seed| read_label(&measured(seed, 0.15), Thresholds::default(), seed).unwrap())
            .collect();
        let mean = |f: &dyn Fn(&Reading) -> f64| readings.iter().map(f).sum::<f64>() / readings.len() as f64;
        let near: Vec<f64> = readings.iter().map(|r| f64::from(r.v_near)).collect();
        let (said, seen) = (mean(&|r| r.v_near_sigma), standard_deviation(&near));
        assert!(said > 0.5 * seen && said < 2.0 * seen, "said {said}, seen {seen}");
        let star: Vec<f64> = readings.iter().map(|r| f64::from(r.v_star.unwrap_or(MAX_VIEWS))).collect();
        let (said, seen) = (mean(&|r| r.v_star_sigma), standard_deviation(&star));
        assert!(said > 0.5 * seen && said < 2.0 * seen, "said {said}, seen {seen}");
    }

    #[test]
    fn a_set_far_above_the_ceiling_marks_the_curve_and_one_within_noise_does_not() {
        let mut samples = measured(3, 0.1);
        assert_eq!(read_label(&samples, Thresholds::default(), 0).unwrap().status, LabelStatus::Ok);
        let before_last = samples.len() - 2;
        samples[before_last].psnr_db.iter_mut().for_each(|p| *p += 1.5);
        let reading = read_label(&samples, Thresholds::default(), 0).unwrap();
        assert_eq!(reading.status, LabelStatus::NotConverged);
    }
}

//! From the NeRFs of an object to its label: the fits, the definitions, their noise and the status.

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::fit::{CurvePoint, FitError, Scheme, fit_curve, refit};
use super::lognormal::{LogNormalCurve, MAX_VIEWS};
use super::protocol::{CEILING_VIEWS, GAIN_DB, NEAR_DB, PAPER_ALPHA_DB};
use super::record::{CurveSample, LabelStatus, Reading, curve_points, over_black, over_both};
use super::steady::nerf_sigma_db;

/// Where on a curve a label is read.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Thresholds {
    /// v* is where one more view brings less than this, dB (paper, equation 1).
    pub alpha_db: f64,
    /// v_gain is where one more view brings less than this, dB.
    pub gain_db: f64,
    /// v_near is where the curve is this close to its value at 100 views, dB.
    pub near_db: f64,
}

impl Default for Thresholds {
    /// The paper's alpha, [`GAIN_DB`] and [`NEAR_DB`].
    fn default() -> Self {
        Self { alpha_db: PAPER_ALPHA_DB, gain_db: GAIN_DB, near_db: NEAR_DB }
    }
}

const BOOTSTRAP_DRAWS: usize = 100;
/// Parameters of a curve.
const PARAMETERS: f64 = 4.0;
/// A set better than the ceiling by this many standard errors of the two is better by more than noise.
const BETTER_SIGMAS: f64 = 3.0;

/// Reads the label off the NeRFs; deterministic in `seed`, which only moves the sigmas.
///
/// # Errors
/// [`FitError`] for too few or non-finite points.
pub fn read_label(samples: &[CurveSample], thresholds: Thresholds, seed: u64) -> Result<Reading, FitError> {
    let paper = curve_points(samples, over_black);
    let paper_curve = fit_curve(&paper, Scheme::Orthogonal)?.curve;
    let star = |curve: &LogNormalCurve| curve.required_views(thresholds.alpha_db);
    let steady = curve_points(samples, over_both);
    let fit = fit_curve(&steady, Scheme::Steady)?;
    let gain = |curve: &LogNormalCurve| curve.required_views(thresholds.gain_db);
    let near = |curve: &LogNormalCurve| views_near_ceiling(curve, thresholds.near_db);

    let count = |views: Option<u32>| f64::from(views.unwrap_or(MAX_VIEWS));
    let paper_curves = redrawn_curves(&paper, &paper_curve, Scheme::Orthogonal, seed);
    let curves = redrawn_curves(&steady, &fit.curve, Scheme::Steady, seed);
    let v_gain = gain(&fit.curve);
    Ok(Reading {
        status: status(samples, v_gain),
        v_gain,
        v_gain_sigma: standard_deviation(curves.iter().map(|c| count(gain(c)))),
        v_star: star(&paper_curve),
        v_star_sigma: standard_deviation(paper_curves.iter().map(|c| count(star(c)))),
        v_near: near(&fit.curve),
        v_near_sigma: standard_deviation(curves.iter().map(|c| f64::from(near(c)))),
        curve: fit.curve,
        rms_db: fit.rms_db,
    })
}

/// The fewest views whose value on the curve is within `near_db` of that of 100 views.
pub fn views_near_ceiling(curve: &LogNormalCurve, near_db: f64) -> u32 {
    let enough = curve.value(CEILING_VIEWS as f64) - near_db;
    (1..CEILING_VIEWS as u32).find(|&v| curve.value(f64::from(v)) >= enough).unwrap_or(CEILING_VIEWS as u32)
}

/// Residual bootstrap: curves fitted to the fitted values plus residuals drawn with replacement, each residual
/// scaled from the noise where it was measured to the noise where it is put, all by what the fit's four parameters
/// took of them.
fn redrawn_curves(
    points: &[CurvePoint],
    curve: &LogNormalCurve,
    scheme: Scheme,
    seed: u64,
) -> Vec<LogNormalCurve> {
    let noise = |views: f64| match scheme {
        Scheme::Orthogonal => 1.0,
        Scheme::Steady => nerf_sigma_db(views),
    };
    let count = points.len() as f64;
    let widened = (count / (count - PARAMETERS).max(1.0)).sqrt();
    let residuals: Vec<f64> =
        points.iter().map(|&(x, y)| widened * (y - curve.value(x)) / noise(x)).collect();
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    (0..BOOTSTRAP_DRAWS)
        .map(|_| {
            let redrawn: Vec<CurvePoint> = points
                .iter()
                .map(|&(x, _)| {
                    (x, curve.value(x) + noise(x) * residuals[rng.random_range(0..residuals.len())])
                })
                .collect();
            refit(&redrawn, *curve, scheme).curve
        })
        .collect()
}

fn standard_deviation(values: impl ExactSizeIterator<Item = f64> + Clone) -> f64 {
    let count = values.len();
    let mean = values.clone().sum::<f64>() / count as f64;
    let squares = values.map(|v| (v - mean).powi(2)).sum::<f64>();
    (squares / count.saturating_sub(1).max(1) as f64).sqrt()
}

/// "Better by more than noise" takes the noise that [`nerf_sigma_db`] knows of, since one label has too few NeRFs
/// of a number to measure it.
fn status(samples: &[CurveSample], v_gain: Option<u32>) -> LabelStatus {
    let Some(ceiling) = samples.iter().find(|s| s.views == CEILING_VIEWS) else { return LabelStatus::Ok };
    let mean = |s: &CurveSample| over_both(s).iter().sum::<f64>() / over_both(s).len().max(1) as f64;
    let variance = |s: &CurveSample| nerf_sigma_db(s.views as f64).powi(2) / over_both(s).len().max(1) as f64;
    let better = |s: &CurveSample| {
        s.views < CEILING_VIEWS
            && mean(s) > mean(ceiling) + BETTER_SIGMAS * (variance(s) + variance(ceiling)).sqrt()
    };
    match v_gain {
        None => LabelStatus::NoPlateau,
        Some(_) if samples.iter().any(better) => LabelStatus::NotConverged,
        Some(_) => LabelStatus::Ok,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::label::protocol::curve_design;

    const TRUTH: LogNormalCurve = LogNormalCurve { y0: 12.0, amplitude: 22.0, x_c: 2.5, width: 1.2 };

    fn measured(seed: u64, noise: f64) -> Vec<CurveSample> {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let mut noisy =
            |v: usize| TRUTH.value(v as f64) + rng.random_range(-1.7..1.7) * noise * nerf_sigma_db(v as f64);
        let design = curve_design();
        design
            .into_iter()
            .map(|(views, n)| {
                let psnr_db: Vec<f64> = (0..n).map(|_| noisy(views)).collect();
                // Over black the curve is another one: flatter, and higher.
                let black = |x: &f64| 20.0 + 0.6 * x;
                CurveSample { views, psnr_db: psnr_db.iter().map(black).collect(), both_db: psnr_db }
            })
            .collect()
    }

    #[test]
    fn exact_samples_give_both_numbers_of_their_curve() {
        let reading = read_label(&measured(0, 0.0), Thresholds::default(), 0).unwrap();
        assert_eq!(reading.v_star, TRUTH.required_views(PAPER_ALPHA_DB / 0.6));
        assert_eq!(reading.v_gain, TRUTH.required_views(GAIN_DB));
        assert!(reading.v_near.abs_diff(views_near_ceiling(&TRUTH, NEAR_DB)) <= 1);
        assert_eq!(reading.status, LabelStatus::Ok);
        assert!(reading.v_star_sigma < 0.5 && reading.v_gain_sigma < 0.5 && reading.v_near_sigma < 0.5);
    }

    #[test]
    fn the_sigmas_tell_how_far_repeated_labels_scatter() {
        let readings: Vec<Reading> = (0..24)
            .map(|seed| read_label(&measured(seed, 1.0), Thresholds::default(), seed).unwrap())
            .collect();
        let mean = |f: &dyn Fn(&Reading) -> f64| readings.iter().map(f).sum::<f64>() / readings.len() as f64;
        let both = |said: f64, values: Vec<f64>| {
            let seen = standard_deviation(values.into_iter());
            assert!(said > 0.4 * seen && said < 2.0 * seen, "said {said}, seen {seen}");
        };
        let count = |views: Option<u32>| f64::from(views.unwrap_or(MAX_VIEWS));
        both(mean(&|r| r.v_gain_sigma), readings.iter().map(|r| count(r.v_gain)).collect());
        both(mean(&|r| r.v_near_sigma), readings.iter().map(|r| f64::from(r.v_near)).collect());
        both(mean(&|r| r.v_star_sigma), readings.iter().map(|r| count(r.v_star)).collect());
    }

    #[test]
    fn the_rows_of_the_label_file_are_what_reading_their_curves_gives() {
        let records = crate::label::store::read_labels("models/labels.csv".as_ref()).unwrap();
        for record in records.iter().step_by(records.len() / 5) {
            let Reading { status, v_gain, v_near, v_gain_sigma, .. } =
                read_label(&record.samples, Thresholds::default(), record.seed).unwrap();
            let written = &record.reading;
            assert_eq!(
                (status, v_gain, v_near),
                (written.status, written.v_gain, written.v_near),
                "{}",
                record.object
            );
            assert!((v_gain_sigma - written.v_gain_sigma).abs() < 0.1, "{}", record.object);
        }
    }

    #[test]
    fn a_set_far_above_the_ceiling_marks_the_curve_and_one_within_noise_does_not() {
        let mut samples = measured(3, 0.7);
        assert_eq!(read_label(&samples, Thresholds::default(), 0).unwrap().status, LabelStatus::Ok);
        let before_last = samples.len() - 2;
        samples[before_last].both_db.iter_mut().for_each(|p| *p += 1.5);
        let reading = read_label(&samples, Thresholds::default(), 0).unwrap();
        assert_eq!(reading.status, LabelStatus::NotConverged);
    }
}

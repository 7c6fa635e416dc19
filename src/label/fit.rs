//! Fits a curve to the NeRFs of an object, in two ways.

use nalgebra::{Matrix4, Vector4};

use super::lognormal::LogNormalCurve;
use super::orthogonal::orthogonal;
use super::steady::steady;

/// One measured point: views and the PSNR they gave, dB.
pub type CurvePoint = (f64, f64);

/// What a fit makes small.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scheme {
    /// The paper's: orthogonal distances, unit weights.
    Orthogonal,
    /// Ours: residuals by their noise, outliers held back, widths drawn to their mean.
    Steady,
}

/// A fitted curve and how well it fits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurveFit {
    /// The curve.
    pub curve: LogNormalCurve,
    /// Root mean square of the vertical residuals, dB.
    pub rms_db: f64,
}

/// Why no curve could be fitted.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FitError {
    /// Fewer points than parameters.
    #[error("{given} curve points, must be at least {least}")]
    TooFewPoints {
        /// Points given.
        given: usize,
        /// Least number.
        least: usize,
    },
    /// A point is not a finite number of views above zero and a finite PSNR.
    #[error("curve point {index} is ({views}, {psnr_db}), must be finite with views above 0")]
    BadPoint {
        /// Its index.
        index: usize,
        /// Its views.
        views: f64,
        /// Its PSNR.
        psnr_db: f64,
    },
}

/// Fewest points a fit takes: one more than it has parameters.
const LEAST_POINTS: usize = 5;

/// A cost, and the Gauss-Newton matrix and gradient for reducing it over `[y0, amplitude, ln x_c, ln width]`.
pub(super) struct NormalEquations {
    /// Sum of the squared residuals: of distances in views and dB, or standardised.
    pub cost: f64,
    /// `J^T J` of the residuals' Jacobian.
    pub hessian: Matrix4<f64>,
    /// `-J^T r`: half of where the cost falls most steeply.
    pub gradient: Vector4<f64>,
}

/// Fits the curve to `points` (any order).
///
/// # Errors
/// [`FitError`] for too few or non-finite points.
pub fn fit_curve(points: &[CurvePoint], scheme: Scheme) -> Result<CurveFit, FitError> {
    if points.len() < LEAST_POINTS {
        return Err(FitError::TooFewPoints { given: points.len(), least: LEAST_POINTS });
    }
    for (index, &(views, psnr_db)) in points.iter().enumerate() {
        if !(views.is_finite() && views > 0.0 && psnr_db.is_finite()) {
            return Err(FitError::BadPoint { index, views, psnr_db });
        }
    }
    Ok(refit(points, starting_curve(points), scheme))
}

/// Fits the curve to `points` from a curve that is close already, as for a resampled set of
/// the same points, by Levenberg-Marquardt. Points are taken as they are.
pub fn refit(points: &[CurvePoint], start: LogNormalCurve, scheme: Scheme) -> CurveFit {
    let normal = |parameters: &Vector4<f64>| match scheme {
        Scheme::Orthogonal => orthogonal(points, &curve_of(parameters)),
        Scheme::Steady => steady(points, &curve_of(parameters)),
    };
    let mut parameters = Vector4::new(start.y0, start.amplitude, start.x_c.ln(), start.width.ln());
    let mut damping = 1e-3;
    let mut at = normal(&parameters);
    for _ in 0..200 {
        let mut damped: Matrix4<f64> = at.hessian;
        for k in 0..4 {
            damped[(k, k)] += damping * at.hessian[(k, k)].max(1e-9);
        }
        let Some(step) = damped.cholesky().map(|c| c.solve(&at.gradient)) else {
            damping *= 10.0;
            continue;
        };
        let mut next = parameters + step;
        // Middles and widths outside these ranges are flat lines or steps, where the parameters mean nothing.
        next[2] = next[2].clamp(-3.0, 7.0);
        next[3] = next[3].clamp(-3.0, 2.0);
        let there = normal(&next);
        if there.cost < at.cost {
            let gain = (at.cost - there.cost) / at.cost.max(1e-300);
            (parameters, at) = (next, there);
            damping = (damping * 0.3).max(1e-12);
            if gain < 1e-12 {
                break;
            }
        } else {
            damping *= 4.0;
            if damping > 1e12 {
                break;
            }
        }
    }
    let curve = curve_of(&parameters);
    let squares = points.iter().map(|&(x, y)| (y - curve.value(x)).powi(2)).sum::<f64>();
    CurveFit { curve, rms_db: (squares / points.len().max(1) as f64).sqrt() }
}

/// The best curve of a grid over `x_c` and `width`, with `y0` and `amplitude` by linear least squares.
fn starting_curve(points: &[CurvePoint]) -> LogNormalCurve {
    let mut best = (f64::INFINITY, LogNormalCurve { y0: 0.0, amplitude: 1.0, x_c: 5.0, width: 1.0 });
    for i in 0..24 {
        for j in 0..16 {
            let x_c = 0.5 * 1.2f64.powi(i);
            let width = 0.15 * 1.2f64.powi(j);
            let unit = LogNormalCurve { y0: 0.0, amplitude: 1.0, x_c, width };
            let n = points.len() as f64;
            let (mut sp, mut sy, mut spp, mut spy) = (0.0, 0.0, 0.0, 0.0);
            for &(x, y) in points {
                let p = unit.value(x);
                sp += p;
                sy += y;
                spp += p * p;
                spy += p * y;
            }
            let determinant = n * spp - sp * sp;
            if determinant < 1e-9 {
                continue;
            }
            let amplitude = (n * spy - sp * sy) / determinant;
            let y0 = (sy - amplitude * sp) / n;
            let curve = LogNormalCurve { y0, amplitude, x_c, width };
            let cost = points.iter().map(|&(x, y)| (y - curve.value(x)).powi(2)).sum::<f64>();
            if cost < best.0 {
                best = (cost, curve);
            }
        }
    }
    best.1
}

fn curve_of(p: &Vector4<f64>) -> LogNormalCurve {
    LogNormalCurve { y0: p[0], amplitude: p[1], x_c: p[2].exp(), width: p[3].exp() }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn curve_points(curve: &LogNormalCurve) -> Vec<CurvePoint> {
        (3..50).step_by(2).chain([100]).map(|v| (f64::from(v), curve.value(f64::from(v)))).collect()
    }

    #[test]
    fn exact_points_give_back_their_curve() {
        for (amplitude, x_c, width) in [(15.0, 5.0, 0.8), (22.0, 9.0, 1.1), (8.0, 3.0, 0.6)] {
            let truth = LogNormalCurve { y0: 12.0, amplitude, x_c, width };
            let fit = fit_curve(&curve_points(&truth), Scheme::Orthogonal).unwrap();
            assert!(fit.rms_db < 1e-4, "{fit:?}");
            assert_eq!(fit.curve.required_views(0.02), truth.required_views(0.02));
        }
    }

    #[test]
    fn the_orthogonal_fit_forgives_an_error_in_views_where_the_curve_is_steep() {
        let truth = LogNormalCurve { y0: 10.0, amplitude: 20.0, x_c: 6.0, width: 0.5 };
        let mut points = curve_points(&truth);
        // One steep point measured half a view early.
        points[1].1 = truth.value(points[1].0 + 0.5);
        let fit = fit_curve(&points, Scheme::Orthogonal).unwrap();
        let off = f64::from(fit.curve.required_views(0.02).unwrap())
            - f64::from(truth.required_views(0.02).unwrap());
        assert!(off.abs() <= 2.0, "{off}");
    }

    #[test]
    fn too_few_points_and_nan_are_refused_with_their_numbers() {
        assert_eq!(
            fit_curve(&[(3.0, 20.0)], Scheme::Steady),
            Err(FitError::TooFewPoints { given: 1, least: 5 })
        );
        let points = [(3.0, 20.0), (5.0, f64::NAN), (7.0, 21.0), (9.0, 22.0), (11.0, 22.5)];
        assert!(matches!(fit_curve(&points, Scheme::Orthogonal), Err(FitError::BadPoint { index: 1, .. })));
    }
}

//! Orthogonal distance regression: the paper's fit.
//!
//! Both axes carry unit weight (one view weighs as much as one dB), which is what
//! the paper's authors' fit used. Each point's foot on the curve is found by
//! Gauss-Newton steps; the four parameters by Levenberg-Marquardt on the signed
//! orthogonal distances (Boggs, Byrd and Schnabel 1987 in its reduced form).

use nalgebra::{Matrix4, Vector4};

use super::fit::{CurvePoint, NormalEquations};
use super::lognormal::LogNormalCurve;

/// Sum of squared orthogonal distances, and the Gauss-Newton matrix and gradient for reducing it.
pub(super) fn orthogonal(points: &[CurvePoint], curve: &LogNormalCurve) -> NormalEquations {
    let (mut cost, mut hessian, mut gradient) = (0.0, Matrix4::zeros(), Vector4::zeros());
    for &(x, y) in points {
        let foot = foot_on_curve(x, y, curve);
        let slope = curve.slope(foot);
        let (dx, dy) = (x - foot, y - curve.value(foot));
        // At the foot the residual is normal to the curve, so its length moves with
        // the parameters by the curve's vertical shift seen along that normal.
        let tilt = 1.0 / (1.0 + slope * slope).sqrt();
        let distance = (dx * dx + dy * dy).sqrt().copysign(dy);
        let row = Vector4::from(curve.parameter_gradient(foot)) * tilt;
        cost += distance * distance;
        hessian += row * row.transpose();
        gradient += row * distance;
    }
    NormalEquations { cost, hessian, gradient }
}

/// The views coordinate of the point on the curve that is nearest to (x, y).
fn foot_on_curve(x: f64, y: f64, curve: &LogNormalCurve) -> f64 {
    let mut foot = x;
    let distance = |t: f64| (x - t).powi(2) + (y - curve.value(t)).powi(2);
    let mut best = distance(foot);
    for _ in 0..20 {
        let slope = curve.slope(foot);
        // Gauss-Newton on the squared distance; halved until it descends.
        let mut step = ((x - foot) + slope * (y - curve.value(foot))) / (1.0 + slope * slope);
        let mut moved = false;
        for _ in 0..8 {
            let candidate = (foot + step).max(0.05);
            let at = distance(candidate);
            if at < best {
                (foot, best, moved) = (candidate, at, true);
                break;
            }
            step *= 0.5;
        }
        if !moved || step.abs() < 1e-9 {
            break;
        }
    }
    foot
}

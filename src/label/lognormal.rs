//! The curve PSNR(v) of one object: a scaled log-normal cumulative distribution.

use std::f64::consts::{FRAC_1_SQRT_2, TAU};

/// `C(v) = y0 + amplitude * Phi(ln(v / x_c) / width)`, dB over the number of views
/// (paper, section "Labeling of Required Number of Views").
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LogNormalCurve {
    /// Value at zero views, dB.
    pub y0: f64,
    /// Rise from zero to infinitely many views, dB.
    pub amplitude: f64,
    /// Views at half the rise.
    pub x_c: f64,
    /// Standard deviation of ln(v).
    pub width: f64,
}

/// The largest number of views that is looked at when reading v* off a curve.
pub const MAX_VIEWS: u32 = 200;

impl LogNormalCurve {
    /// C at `views`, dB.
    pub fn value(&self, views: f64) -> f64 {
        if views <= 0.0 {
            return self.y0;
        }
        self.y0 + self.amplitude * normal_cdf((views / self.x_c).ln() / self.width)
    }

    /// dC/dv at `views`, dB per view.
    pub fn slope(&self, views: f64) -> f64 {
        if views <= 0.0 {
            return 0.0;
        }
        let z = (views / self.x_c).ln() / self.width;
        self.amplitude * normal_pdf(z) / (self.width * views)
    }

    /// Gradient of [`Self::value`] with respect to `[y0, amplitude, ln x_c, ln width]`.
    pub fn parameter_gradient(&self, views: f64) -> [f64; 4] {
        let z = (views.max(1e-12) / self.x_c).ln() / self.width;
        let density = self.amplitude * normal_pdf(z);
        [1.0, normal_cdf(z), -density / self.width, -density * z]
    }

    /// v*: the first number of views after the steepest one with
    /// `C(v + 1) - C(v) < alpha_db` (paper, equation 1).
    ///
    /// The curve is S-shaped over v, so its first few differences may be small as
    /// well; they are before the rise and do not count. A curve that does not rise needs
    /// no second view. `None` when one more view still pays at [`MAX_VIEWS`].
    pub fn required_views(&self, alpha_db: f64) -> Option<u32> {
        if self.amplitude <= 0.0 {
            return Some(1);
        }
        let gain = |v: u32| self.value(f64::from(v + 1)) - self.value(f64::from(v));
        let steepest = (1..MAX_VIEWS).max_by(|a, b| gain(*a).total_cmp(&gain(*b)))?;
        (steepest..=MAX_VIEWS).find(|&v| gain(v) < alpha_db)
    }
}

fn normal_pdf(z: f64) -> f64 {
    (-0.5 * z * z).exp() / TAU.sqrt()
}

fn normal_cdf(z: f64) -> f64 {
    0.5 * libm::erfc(-z * FRAC_1_SQRT_2)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_normal_distribution_matches_its_tables() {
        // NIST/SEMATECH e-Handbook, cumulative normal table.
        for (z, p) in [(0.0, 0.5), (1.0, 0.841_344_746), (1.96, 0.975_002_105), (3.0, 0.998_650_102)] {
            assert!((normal_cdf(z) - p).abs() < 1e-9, "{z}");
            assert!((normal_cdf(-z) - (1.0 - p)).abs() < 1e-9, "-{z}");
        }
    }

    #[test]
    fn the_far_tail_keeps_its_digits() {
        // Q(6) and Q(10) of the standard normal distribution (Abramowitz and Stegun, table 26.2).
        for (z, tail) in [(6.0, 9.865_876_450e-10), (10.0, 7.619_853_024e-24)] {
            assert!((normal_cdf(-z) / tail - 1.0).abs() < 1e-9, "{z}");
        }
    }

    #[test]
    fn the_slope_is_the_derivative_of_the_value() {
        let curve = LogNormalCurve { y0: 14.0, amplitude: 17.0, x_c: 6.0, width: 0.9 };
        for v in [2.0, 6.0, 20.0, 45.0] {
            let numeric = (curve.value(v + 1e-5) - curve.value(v - 1e-5)) / 2e-5;
            assert!((numeric - curve.slope(v)).abs() < 1e-6);
        }
    }

    #[test]
    fn the_parameter_gradient_matches_finite_differences() {
        let at =
            |p: [f64; 4]| LogNormalCurve { y0: p[0], amplitude: p[1], x_c: p[2].exp(), width: p[3].exp() };
        let p = [14.0, 17.0, 6.0f64.ln(), 0.9f64.ln()];
        for v in [2.0, 9.0, 40.0] {
            let analytic = at(p).parameter_gradient(v);
            for k in 0..4 {
                let (mut up, mut down) = (p, p);
                up[k] += 1e-6;
                down[k] -= 1e-6;
                let numeric = (at(up).value(v) - at(down).value(v)) / 2e-6;
                assert!((numeric - analytic[k]).abs() < 1e-6, "parameter {k} at {v}");
            }
        }
    }

    #[test]
    fn required_views_skips_the_flat_foot_before_the_rise() {
        let curve = LogNormalCurve { y0: 10.0, amplitude: 20.0, x_c: 12.0, width: 0.3 };
        assert!(curve.value(2.0) - curve.value(1.0) < 0.02);
        let v = curve.required_views(0.02).unwrap();
        assert!(curve.value(f64::from(v + 1)) - curve.value(f64::from(v)) < 0.02);
        assert!(curve.value(f64::from(v)) - curve.value(f64::from(v - 1)) >= 0.02);
        assert!(v > 12);
    }

    #[test]
    fn a_curve_that_does_not_rise_needs_one_view() {
        for amplitude in [0.0, -0.3, -20.0] {
            let curve = LogNormalCurve { y0: 30.0, amplitude, x_c: 5.0, width: 1.0 };
            assert_eq!(curve.required_views(0.05), Some(1));
        }
    }

    #[test]
    fn a_curve_that_never_flattens_has_no_required_views() {
        let curve = LogNormalCurve { y0: 0.0, amplitude: 500.0, x_c: 300.0, width: 1.0 };
        assert_eq!(curve.required_views(0.02), None);
    }
}

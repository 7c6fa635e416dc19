//! Paired t-test (Student 1908).

use std::f64::consts::{FRAC_1_PI, FRAC_1_SQRT_2};

/// Two-sided p-value of the hypothesis that the pairs' differences have mean zero; `None` for fewer
/// than two pairs or differences that are all the same.
pub fn paired_p_value(a: &[f64], b: &[f64]) -> Option<f64> {
    let differences: Vec<f64> = a.iter().zip(b).map(|(a, b)| a - b).collect();
    let n = differences.len() as f64;
    if differences.len() < 2 {
        return None;
    }
    let mean = differences.iter().sum::<f64>() / n;
    let variance = differences.iter().map(|d| (d - mean).powi(2)).sum::<f64>() / (n - 1.0);
    if variance <= 0.0 || !variance.is_finite() {
        return None;
    }
    Some(two_sided(mean / (variance / n).sqrt(), differences.len() - 1))
}

/// Probability of a larger |t| with `freedom` degrees of freedom, by Simpson's rule over
/// the density from 0 to |t|.
fn two_sided(t: f64, freedom: usize) -> f64 {
    // Beyond this the tail is below 1e-12 for every freedom that matters, and the rule needs its points near zero.
    let t = t.abs().min(60.0);
    let nu = freedom as f64;
    let density = |x: f64| density_at_zero(freedom) * (1.0 + x * x / nu).powf(-0.5 * (nu + 1.0));
    let intervals = 6000;
    let step = t / f64::from(intervals);
    let inner: f64 =
        (1..intervals).map(|i| density(f64::from(i) * step) * if i % 2 == 1 { 4.0 } else { 2.0 }).sum();
    let half = (density(0.0) + inner + density(t)) * step / 3.0;
    (1.0 - 2.0 * half).clamp(0.0, 1.0)
}

/// Gamma((nu + 1) / 2) / (sqrt(nu pi) Gamma(nu / 2)), by the recurrence of Gamma from nu = 1 or 2.
fn density_at_zero(freedom: usize) -> f64 {
    let odd = freedom % 2 == 1;
    // The ratio of the two Gammas over sqrt(pi), at nu = 1 and 2.
    let mut ratio = if odd { FRAC_1_PI } else { 0.5 };
    for nu in (if odd { 1..freedom } else { 2..freedom }).step_by(2) {
        ratio *= (nu as f64 + 1.0) / nu as f64;
    }
    if freedom == 2 {
        return 0.5 * FRAC_1_SQRT_2;
    }
    ratio / (freedom as f64).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_distribution_matches_its_tables() {
        // NIST/SEMATECH e-Handbook, upper critical values of Student's t, 0.05 two-sided.
        for (freedom, t) in [(1, 12.706), (2, 4.303), (5, 2.571), (10, 2.228), (30, 2.042), (100, 1.984)] {
            assert!((two_sided(t, freedom) - 0.05).abs() < 2e-4, "{freedom}: {}", two_sided(t, freedom));
        }
        assert!((two_sided(0.0, 7) - 1.0).abs() < 1e-9);
        assert!(two_sided(1e9, 50) < 1e-9);
    }

    #[test]
    fn a_shift_is_seen_and_noise_is_not() {
        let a: Vec<f64> = (0..40).map(|i| f64::from(i * 37 % 11)).collect();
        let shifted: Vec<f64> = a.iter().enumerate().map(|(i, x)| x + 1.0 + 0.3 * (i % 3) as f64).collect();
        let noisy: Vec<f64> =
            a.iter().enumerate().map(|(i, x)| x + if i % 2 == 0 { 1.0 } else { -1.0 }).collect();
        assert!(paired_p_value(&a, &shifted).unwrap() < 1e-6);
        assert!(paired_p_value(&a, &noisy).unwrap() > 0.9);
        assert_eq!(paired_p_value(&a, &a), None);
        assert_eq!(paired_p_value(&[1.0], &[2.0]), None);
    }
}

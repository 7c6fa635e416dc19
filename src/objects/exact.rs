//! Elementary functions that give the same bits on every machine: additions, multiplications,
//! divisions and square roots alone, no libm. Good to about 1e-8, plenty for shapes and colours.

use std::f64::consts::{LN_2, PI, SQRT_2, TAU};

/// Sine of an angle in turns.
pub(super) fn sin_turns(turns: f64) -> f64 {
    let t = turns - (turns + 0.5).floor();
    // Folded to a quarter turn on either side, where the series is short.
    let t = if t > 0.25 {
        0.5 - t
    } else if t < -0.25 {
        -0.5 - t
    } else {
        t
    };
    let x = t * TAU;
    let q = x * x;
    let series = 1.0 - q / 156.0;
    let series = 1.0 - q / 110.0 * series;
    let series = 1.0 - q / 72.0 * series;
    let series = 1.0 - q / 42.0 * series;
    let series = 1.0 - q / 20.0 * series;
    x * (1.0 - q / 6.0 * series)
}

/// Cosine of an angle in turns.
pub(super) fn cos_turns(turns: f64) -> f64 {
    sin_turns(turns + 0.25)
}

/// Sine of an angle in turns, for textures.
pub(super) fn wave(turns: f32) -> f32 {
    sin_turns(f64::from(turns)) as f32
}

/// Angle of (x, y) in turns, -0.5 to 0.5, good to 1e-5.
pub(super) fn angle_turns(y: f32, x: f32) -> f32 {
    let (a, b) = (x.abs(), y.abs());
    let z = if a.max(b) > 0.0 { a.min(b) / a.max(b) } else { 0.0 };
    let q = z * z;
    // Abramowitz and Stegun 4.4.49.
    let atan = z * (0.999_866 + q * (-0.330_299_5 + q * (0.180_141 + q * (-0.085_133 + q * 0.020_835_1))));
    let turns = atan / TAU as f32;
    let turns = if b > a { 0.25 - turns } else { turns };
    let turns = if x < 0.0 { 0.5 - turns } else { turns };
    if y < 0.0 { -turns } else { turns }
}

/// e to the power of `x`; 0 below -700, the value at 700 above that.
pub(super) fn exp(x: f64) -> f64 {
    if x < -700.0 {
        return 0.0;
    }
    let x = x.min(700.0);
    let k = (x / LN_2 + 0.5).floor();
    let r = x - k * LN_2;
    let series = (1..=11).rev().fold(1.0, |sum, n| 1.0 + r / f64::from(n) * sum);
    series * f64::from_bits(((1023 + k as i64) as u64) << 52)
}

/// Natural logarithm of a positive normal number.
pub(super) fn ln(x: f64) -> f64 {
    let bits = x.max(f64::MIN_POSITIVE).to_bits();
    let mut exponent = ((bits >> 52) as i64 - 1023) as f64;
    let mut mantissa = f64::from_bits((bits & ((1 << 52) - 1)) | (1023 << 52));
    if mantissa > SQRT_2 {
        mantissa *= 0.5;
        exponent += 1.0;
    }
    let z = (mantissa - 1.0) / (mantissa + 1.0);
    let q = z * z;
    let series = [13.0, 11.0, 9.0, 7.0, 5.0, 3.0, 1.0].iter().fold(0.0, |sum, n| sum * q + 1.0 / n);
    exponent * LN_2 + 2.0 * z * series
}

/// `x` to the power of `e` for `x` not negative.
pub(super) fn power(x: f64, e: f64) -> f64 {
    if x > 0.0 { exp(e * ln(x)) } else { 0.0 }
}

/// The arc of a half circle, 0 to 1 to 0 for t from 0 to 1.
pub(super) fn arch(t: f64) -> f64 {
    (1.0 - (2.0 * t - 1.0) * (2.0 * t - 1.0)).max(0.0).sqrt()
}

/// Length of a full turn of radius `r`.
pub(super) fn circumference(r: f64) -> f64 {
    2.0 * PI * r
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_series_agree_with_libm() {
        for i in -400..400 {
            let x = f64::from(i) * 0.013;
            assert!((sin_turns(x) - (x * TAU).sin()).abs() < 1e-8);
            assert!((cos_turns(x) - (x * TAU).cos()).abs() < 1e-8);
            assert!((exp(x) / x.exp() - 1.0).abs() < 1e-10);
            let positive = x.abs() + 1e-6;
            assert!((ln(positive) - positive.ln()).abs() < 1e-8);
            assert!((power(positive, 0.7) - positive.powf(0.7)).abs() < 1e-7);
            let (s, c) = (x as f32).sin_cos();
            let turns = (s.atan2(c) / TAU as f32 - angle_turns(s, c)).abs();
            assert!(turns < 1e-5 || (turns - 1.0).abs() < 1e-5, "{x}");
        }
    }
}

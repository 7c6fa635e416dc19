//! Peak signal-to-noise ratio.

use image::RgbImage;

/// Peak signal-to-noise ratio in dB of two 8-bit images, `10 log10(255^2 / MSE)` with
/// the squared error averaged over all pixels and the three channels together.
///
/// Infinity for equal images; NaN when the sizes differ or there are no pixels.
pub fn psnr(a: &RgbImage, b: &RgbImage) -> f64 {
    if a.dimensions() != b.dimensions() || a.as_raw().is_empty() {
        return f64::NAN;
    }
    let sum: u64 = a
        .as_raw()
        .iter()
        .zip(b.as_raw())
        .map(|(x, y)| {
            let d = u64::from(x.abs_diff(*y));
            d * d
        })
        .sum();
    let mse = sum as f64 / a.as_raw().len() as f64;
    if sum == 0 { f64::INFINITY } else { 10.0 * (255.0 * 255.0 / mse).log10() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::Rgb;

    #[test]
    fn an_error_of_one_step_everywhere_is_48_decibels() {
        let a = RgbImage::from_pixel(7, 5, Rgb([10, 20, 30]));
        let b = RgbImage::from_pixel(7, 5, Rgb([11, 19, 31]));
        assert!((psnr(&a, &b) - 48.130_803_608_679_1).abs() < 1e-9);
        assert_eq!(psnr(&a, &a), f64::INFINITY);
    }

    #[test]
    fn images_of_different_size_have_no_figure() {
        assert!(psnr(&RgbImage::new(3, 4), &RgbImage::new(4, 3)).is_nan());
        assert!(psnr(&RgbImage::new(0, 0), &RgbImage::new(0, 0)).is_nan());
    }
}

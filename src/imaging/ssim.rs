//! Structural similarity (Wang et al., "Image quality assessment", IEEE TIP 2004).

use image::RgbImage;

const TAPS: usize = 11;
const SIGMA: f64 = 1.5;
/// (0.01)^2 and (0.03)^2 for values scaled to 0..1.
const C1: f32 = 1e-4;
const C2: f32 = 9e-4;

/// Mean structural similarity of two 8-bit images, at most 1 (for equal images).
///
/// Gaussian window of 11 x 11 pixels with sigma 1.5, K1 = 0.01, K2 = 0.03, population
/// (not sample) covariance, only windows that lie inside the image, as in the original
/// paper. Red, green and blue are measured one by one and averaged, which is what
/// scikit-image does with `channel_axis`, `gaussian_weights=True, sigma=1.5,
/// use_sample_covariance=False`. An image narrower or lower than 11 pixels gets the
/// largest odd window that fits, in that direction.
///
/// NaN when the sizes differ or there are no pixels.
pub fn ssim(a: &RgbImage, b: &RgbImage) -> f64 {
    if a.dimensions() != b.dimensions() || a.as_raw().is_empty() {
        return f64::NAN;
    }
    let (w, h) = (a.width() as usize, a.height() as usize);
    let (row_kernel, column_kernel) = (gaussian(w), gaussian(h));
    let mut planes = Planes::new(w, row_kernel.len(), column_kernel.len());
    let mut sum = 0.0;
    for channel in 0..3 {
        sum += planes.mean_ssim(a, b, channel, &row_kernel, &column_kernel);
    }
    sum / 3.0
}

/// Normalised Gaussian taps: 11, or the largest odd number that fits into `size`.
fn gaussian(size: usize) -> Vec<f32> {
    let taps = TAPS.min(if size % 2 == 1 { size } else { size - 1 });
    let middle = (taps / 2) as f64;
    let raw: Vec<f64> =
        (0..taps).map(|i| (-(i as f64 - middle).powi(2) / (2.0 * SIGMA * SIGMA)).exp()).collect();
    let sum: f64 = raw.iter().sum();
    raw.iter().map(|v| (v / sum) as f32).collect()
}

/// The four moments that SSIM needs: a, b, a^2 + b^2, ab.
const MOMENTS: usize = 4;

/// Work space of one pass down an image: only the rows under the window are kept, so
/// that they stay in the first-level cache.
struct Planes {
    /// Moments of one image row, not filtered.
    row: [Vec<f32>; MOMENTS],
    /// The last rows filtered along x, one ring of rows for each moment.
    ring: [Vec<Vec<f32>>; MOMENTS],
    /// Moments filtered along both axes.
    out: [Vec<f32>; MOMENTS],
}

impl Planes {
    fn new(width: usize, row_taps: usize, column_taps: usize) -> Self {
        let valid = width + 1 - row_taps;
        Self {
            row: std::array::from_fn(|_| vec![0.0; width]),
            ring: std::array::from_fn(|_| vec![vec![0.0; valid]; column_taps]),
            out: std::array::from_fn(|_| vec![0.0; valid]),
        }
    }

    fn mean_ssim(&mut self, a: &RgbImage, b: &RgbImage, channel: usize, kx: &[f32], ky: &[f32]) -> f64 {
        let stride = a.width() as usize * 3;
        let (mut sum, mut count) = (0.0f64, 0usize);
        for (y, (a, b)) in a.as_raw().chunks_exact(stride).zip(b.as_raw().chunks_exact(stride)).enumerate() {
            self.take_row(a, b, channel);
            let slot = y % ky.len();
            for (ring, row) in self.ring.iter_mut().zip(&self.row) {
                if let Some(target) = ring.get_mut(slot) {
                    target.fill(0.0);
                    for (k, tap) in kx.iter().enumerate() {
                        for (t, v) in target.iter_mut().zip(row.iter().skip(k)) {
                            *t += tap * v;
                        }
                    }
                }
            }
            if y + 1 < ky.len() {
                continue;
            }
            for (out, ring) in self.out.iter_mut().zip(&self.ring) {
                out.fill(0.0);
                // Oldest row first, so that the sum does not depend on where the ring starts.
                let oldest = (y + 1) % ky.len();
                let in_order = ring.iter().cycle().skip(oldest);
                for (tap, row) in ky.iter().zip(in_order) {
                    for (t, v) in out.iter_mut().zip(row) {
                        *t += tap * v;
                    }
                }
            }
            let [ma, mb, squares, products] = &self.out;
            let row_sum: f32 = ma
                .iter()
                .zip(mb)
                .zip(squares.iter().zip(products))
                .map(|((a, b), (s, p))| index(*a, *b, *s, *p))
                .sum();
            sum += f64::from(row_sum);
            count += ma.len();
        }
        sum / count as f64
    }

    fn take_row(&mut self, a: &[u8], b: &[u8], channel: usize) {
        let [ra, rb, rs, rp] = &mut self.row;
        let values = a.iter().zip(b).skip(channel).step_by(3);
        let targets = ra.iter_mut().zip(rb).zip(rs.iter_mut().zip(rp));
        for ((a, b), ((ta, tb), (ts, tp))) in values.zip(targets) {
            let (a, b) = (f32::from(*a) / 255.0, f32::from(*b) / 255.0);
            (*ta, *tb, *ts, *tp) = (a, b, a * a + b * b, a * b);
        }
    }
}

/// SSIM of one window out of its filtered moments.
fn index(a: f32, b: f32, squares: f32, products: f32) -> f32 {
    let (ab, means) = (a * b, a * a + b * b);
    ((2.0 * ab + C1) * (2.0 * (products - ab) + C2)) / ((means + C1) * (squares - means + C2))
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::Rgb;
    use rand::{Rng, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    fn noisy(width: u32, height: u32, amplitude: u8, seed: u64) -> RgbImage {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        RgbImage::from_fn(width, height, |x, y| {
            let base = [x * 5 % 200, y * 7 % 200, (x + y) * 3 % 200];
            Rgb(base.map(|v| v as u8 + rng.random_range(0..=amplitude)))
        })
    }

    /// The definition, window by window in f64, no separation and no ring.
    fn by_definition(a: &RgbImage, b: &RgbImage) -> f64 {
        let half = 5i64;
        let weight = |dx: i64, dy: i64| (-((dx * dx + dy * dy) as f64) / 4.5).exp();
        let total: f64 = (-half..=half).flat_map(|y| (-half..=half).map(move |x| weight(x, y))).sum();
        let (mut sum, mut n) = (0.0, 0.0);
        for c in 0..3 {
            for y in half..i64::from(a.height()) - half {
                for x in half..i64::from(a.width()) - half {
                    let [mut ma, mut mb, mut aa, mut bb, mut ab] = [0.0; 5];
                    for dy in -half..=half {
                        for dx in -half..=half {
                            let w = weight(dx, dy) / total;
                            let at =
                                |i: &RgbImage| f64::from(i.get_pixel((x + dx) as u32, (y + dy) as u32).0[c]);
                            let (p, q) = (at(a), at(b));
                            ma += w * p;
                            mb += w * q;
                            aa += w * p * p;
                            bb += w * q * q;
                            ab += w * p * q;
                        }
                    }
                    let (c1, c2) = (2.55f64.powi(2), 7.65f64.powi(2));
                    let (va, vb, cov) = (aa - ma * ma, bb - mb * mb, ab - ma * mb);
                    sum +=
                        (2.0 * ma * mb + c1) * (2.0 * cov + c2) / ((ma * ma + mb * mb + c1) * (va + vb + c2));
                    n += 1.0;
                }
            }
        }
        sum / n
    }

    #[test]
    fn the_fast_figure_agrees_with_the_definition() {
        for (w, h) in [(11, 11), (30, 17), (13, 40)] {
            let (a, b) = (noisy(w, h, 8, 1), noisy(w, h, 55, 2));
            assert!((ssim(&a, &b) - by_definition(&a, &b)).abs() < 1e-5);
        }
    }

    #[test]
    fn equal_images_score_one_and_more_noise_scores_less() {
        let a = noisy(64, 48, 0, 1);
        assert!((ssim(&a, &a) - 1.0).abs() < 1e-6);
        let (little, much) = (ssim(&a, &noisy(64, 48, 10, 2)), ssim(&a, &noisy(64, 48, 55, 2)));
        assert!(much < little && little < 1.0);
    }

    #[test]
    fn images_smaller_than_the_window_still_have_a_figure() {
        for (w, h) in [(1, 1), (2, 30), (10, 4)] {
            let a = noisy(w, h, 20, 3);
            assert!((ssim(&a, &a) - 1.0).abs() < 1e-5);
        }
        assert!(ssim(&RgbImage::new(3, 4), &RgbImage::new(4, 3)).is_nan());
    }
}

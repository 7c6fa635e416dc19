//! Textures as the renderer reads them: linear, premultiplied, with mip levels.

use image::RgbaImage;

use super::srgb::LINEAR_OF_BYTE;

/// Larger textures are shrunk to this many texels a side when they are prepared.
const MAX_SIDE: usize = 2048;
/// The most taps along the longer side of a pixel's footprint.
const MAX_TAPS: f32 = 4.0;

/// One level: linear RGB times alpha, and alpha, as 16-bit fractions.
struct Level {
    width: usize,
    height: usize,
    texels: Vec<[u16; 4]>,
}

/// A texture with its mip levels, the finest first.
pub(super) struct MipTexture {
    levels: Vec<Level>,
    /// True when a texel is less than opaque.
    pub(super) has_alpha: bool,
}

impl MipTexture {
    pub(super) fn new(image: &RgbaImage) -> Self {
        let (mut width, mut height) = (image.width() as usize, image.height() as usize);
        let mut texels: Vec<[f32; 4]> = image
            .pixels()
            .map(|p| {
                let [r, g, b, a] = p.0;
                let alpha = f32::from(a) / 255.0;
                let linear = |c: u8| LINEAR_OF_BYTE[usize::from(c)] * alpha;
                [linear(r), linear(g), linear(b), alpha]
            })
            .collect();
        if texels.is_empty() {
            (width, height, texels) = (1, 1, vec![[1.0; 4]]);
        }
        let has_alpha = texels.iter().any(|t| t[3] < 1.0);
        let mut levels = Vec::new();
        loop {
            let (w, h) = (width.min(MAX_SIDE), height.min(MAX_SIDE));
            if (w, h) != (width, height) {
                texels = shrink(&texels, width, height, w, h);
                (width, height) = (w, h);
            }
            let fixed = texels.iter().map(|t| t.map(|v| (v * 65535.0 + 0.5) as u16)).collect();
            levels.push(Level { width, height, texels: fixed });
            if width == 1 && height == 1 {
                break;
            }
            let (w, h) = ((width / 2).max(1), (height / 2).max(1));
            texels = shrink(&texels, width, height, w, h);
            (width, height) = (w, h);
        }
        Self { levels, has_alpha }
    }

    /// Linear RGB times alpha, and alpha, averaged over a pixel's footprint, the texture
    /// repeating in both directions. `du` and `dv` are the steps of (u, v) from one pixel
    /// to its right and lower neighbour. `blend` mixes the two nearest levels; without it the
    /// nearer one is taken, at half the cost.
    #[inline]
    pub(super) fn over_footprint(&self, uv: [f32; 2], du: [f32; 2], dv: [f32; 2], blend: bool) -> [f32; 4] {
        let Some(finest) = self.levels.first() else { return [1.0; 4] };
        let (w, h) = (finest.width as f32, finest.height as f32);
        let texels = |d: [f32; 2]| ((d[0] * w).powi(2) + (d[1] * h).powi(2)).sqrt();
        let (a, b) = (texels(du), texels(dv));
        let (major, minor, along) = if a > b { (a, b, du) } else { (b, a, dv) };
        // At grazing angles the footprint is long and thin: several taps along it on a finer level.
        let taps = (major / minor.max(1e-9) + 0.25).clamp(1.0, MAX_TAPS) as u32 as f32;
        let level = log2_roughly((major / taps).max(1e-9));
        let level = if blend { level } else { floor(level + 0.5).0 as f32 };
        if !(taps > 1.0) || level <= 0.0 {
            return self.trilinear(uv, level);
        }
        let n = taps as u32;
        let mut sum = [0.0; 4];
        for i in 0..n {
            let s = (i as f32 + 0.5) / taps - 0.5;
            let tap = self.trilinear([uv[0] + along[0] * s, uv[1] + along[1] * s], level);
            for (s, t) in sum.iter_mut().zip(tap) {
                *s += t;
            }
        }
        sum.map(|v| v / taps)
    }

    /// The level for a pixel whose steps on the texture are `du` and `dv`: texels as large as its longer step.
    pub(super) fn level_for(&self, du: [f32; 2], dv: [f32; 2]) -> usize {
        let Some(finest) = self.levels.first() else { return 0 };
        let (w, h) = (finest.width as f32, finest.height as f32);
        let texels = |d: [f32; 2]| ((d[0] * w).powi(2) + (d[1] * h).powi(2)).sqrt();
        let level = log2_roughly(texels(du).max(texels(dv)).clamp(1.0, 1e9));
        ((level + 0.5) as usize).min(self.levels.len() - 1)
    }

    /// Alpha at a point, on one level.
    #[inline]
    pub(super) fn alpha(&self, uv: [f32; 2], level: usize) -> f32 {
        self.levels.get(level).map_or(1.0, |l| l.bilinear_alpha(uv))
    }

    #[inline]
    fn trilinear(&self, uv: [f32; 2], level: f32) -> [f32; 4] {
        let last = self.levels.len() - 1;
        let level = level.clamp(0.0, last as f32);
        let lower = level as usize;
        let part = level - lower as f32;
        let fine = self.levels[lower].bilinear(uv);
        if part < 0.05 || lower == last {
            return fine;
        }
        let coarse = self.levels[lower + 1].bilinear(uv);
        std::array::from_fn(|k| fine[k] + (coarse[k] - fine[k]) * part)
    }
}

/// log2 of a positive number, to 0.01: enough to choose a level, and several times as fast. The
/// exponent is exact; a parabola through the ends of an octave stands for the mantissa.
#[inline]
fn log2_roughly(value: f32) -> f32 {
    let bits = value.to_bits();
    let exponent = (bits >> 23) as i32 - 127;
    let mantissa = f32::from_bits((bits & 0x007f_ffff) | 0x3f80_0000);
    exponent as f32 + (mantissa - 1.0) * (1.0 + (2.0 - mantissa) * 0.346_6)
}

/// The whole number below `x` (or, for a whole `x`, perhaps the one before) and the rest, 0 to 1.
///
/// Adding 1.5 x 2^23 leaves the rounded number in the lowest bits: no library call and no check for
/// numbers out of range, which texture coordinates are not (see `Mesh::repair`).
#[inline]
fn floor(x: f32) -> (i32, f32) {
    const SHIFT: f32 = 12_582_912.0;
    let shifted = x - 0.5 + SHIFT;
    let whole = shifted.to_bits().wrapping_sub(SHIFT.to_bits()) as i32;
    (whole, x - (shifted - SHIFT))
}

impl Level {
    /// The four texels about a point, and their shares: top left, top right, bottom left, bottom right.
    #[inline]
    fn neighbours(&self, uv: [f32; 2]) -> ([usize; 4], [f32; 4]) {
        let axis = |v: f32, size: usize| {
            let (low, part) = floor(floor(v).1 * size as f32 - 0.5);
            // low is -1 to size - 1, or size by rounding: both neighbours may wrap around once.
            let a = if low < 0 { size - 1 } else { (low as usize).min(size - 1) };
            let b = if a + 1 == size { 0 } else { a + 1 };
            (a, b, part)
        };
        let (x0, x1, fx) = axis(uv[0], self.width);
        let (y0, y1, fy) = axis(uv[1], self.height);
        let (top, bottom) = (y0 * self.width, y1 * self.width);
        // Shares add up to 1 / 65535: the texels' unit goes with them.
        let (right, left) = (fx * (1.0 / 65535.0), (1.0 - fx) * (1.0 / 65535.0));
        let shares = [left * (1.0 - fy), right * (1.0 - fy), left * fy, right * fy];
        ([top + x0, top + x1, bottom + x0, bottom + x1], shares)
    }

    #[inline]
    fn bilinear(&self, uv: [f32; 2]) -> [f32; 4] {
        let (at, shares) = self.neighbours(uv);
        let [t00, t10, t01, t11] =
            [self.texels[at[0]], self.texels[at[1]], self.texels[at[2]], self.texels[at[3]]];
        let [s00, s10, s01, s11] = shares;
        let mut out = [0.0; 4];
        for k in 0..4 {
            out[k] = f32::from(t00[k]) * s00
                + f32::from(t10[k]) * s10
                + f32::from(t01[k]) * s01
                + f32::from(t11[k]) * s11;
        }
        out
    }

    #[inline]
    fn bilinear_alpha(&self, uv: [f32; 2]) -> f32 {
        let (at, shares) = self.neighbours(uv);
        (0..4).map(|k| f32::from(self.texels[at[k]][3]) * shares[k]).sum()
    }
}

/// Area-weighted shrinking, exact for any ratio, so that odd sizes do not shift the picture.
fn shrink(texels: &[[f32; 4]], width: usize, height: usize, w: usize, h: usize) -> Vec<[f32; 4]> {
    let mut narrow = vec![[0.0f32; 4]; w * height];
    for (to, from) in narrow.chunks_exact_mut(w).zip(texels.chunks_exact(width)) {
        shrink_line(from, to);
    }
    let mut out = vec![[0.0f32; 4]; w * h];
    let (mut column, mut short) = (vec![[0.0f32; 4]; height], vec![[0.0f32; 4]; h]);
    for x in 0..w {
        for (c, row) in column.iter_mut().zip(narrow.chunks_exact(w)) {
            *c = row[x];
        }
        shrink_line(&column, &mut short);
        for (row, s) in out.chunks_exact_mut(w).zip(&short) {
            row[x] = *s;
        }
    }
    out
}

fn shrink_line(from: &[[f32; 4]], to: &mut [[f32; 4]]) {
    let ratio = from.len() as f32 / to.len() as f32;
    for (i, out) in to.iter_mut().enumerate() {
        let (start, end) = (i as f32 * ratio, (i + 1) as f32 * ratio);
        let mut sum = [0.0f32; 4];
        for (j, texel) in from.iter().enumerate().skip(start as usize) {
            let overlap = end.min(j as f32 + 1.0) - start.max(j as f32);
            if overlap <= 0.0 {
                break;
            }
            for (s, t) in sum.iter_mut().zip(texel) {
                *s += t * overlap;
            }
        }
        *out = sum.map(|v| (v / ratio).min(1.0));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::Rgba;

    fn checks(size: u32) -> MipTexture {
        MipTexture::new(&RgbaImage::from_fn(size, size, |x, y| {
            Rgba(if (x + y) % 2 == 0 { [255, 255, 255, 255] } else { [0, 0, 0, 255] })
        }))
    }

    #[test]
    fn a_far_chequerboard_is_the_linear_mean() {
        let mean = checks(64).over_footprint([0.3, 0.7], [0.5, 0.0], [0.0, 0.5], true);
        assert!((mean[0] - 0.5).abs() < 1e-3 && mean[3] == 1.0, "{mean:?}");
    }

    #[test]
    fn a_texel_centre_near_by_is_that_texel_also_after_repeating() {
        let texture = checks(8);
        for shift in [-3.0, 0.0, 2.0] {
            let at = |x: f32, y: f32| {
                texture.over_footprint(
                    [(x + 0.5) / 8.0 + shift, (y + 0.5) / 8.0],
                    [1e-4, 0.0],
                    [0.0, 1e-4],
                    true,
                )[0]
            };
            assert!((at(2.0, 4.0) - 1.0).abs() < 1e-3 && at(3.0, 4.0) < 1e-3);
        }
    }

    #[test]
    fn clear_texels_do_not_bleed_their_colour() {
        let texture = MipTexture::new(&RgbaImage::from_fn(4, 4, |x, _| {
            Rgba(if x < 2 { [255, 0, 0, 255] } else { [0, 255, 0, 0] })
        }));
        let [r, g, _, a] = texture.over_footprint([0.5, 0.5], [1.0, 0.0], [0.0, 1.0], true);
        assert!(texture.has_alpha && g == 0.0 && (r / a - 1.0).abs() < 1e-3);
    }

    #[test]
    fn odd_sizes_keep_their_mean() {
        let line: Vec<[f32; 4]> = (0..7).map(|i| [i as f32 / 7.0; 4]).collect();
        let mut out = [[0.0; 4]; 3];
        shrink_line(&line, &mut out);
        let mean = |l: &[[f32; 4]]| l.iter().map(|t| t[0]).sum::<f32>() / l.len() as f32;
        assert!((mean(&line) - mean(&out)).abs() < 1e-6);
    }
}

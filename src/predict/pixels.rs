//! A part of a photo with premultiplied alpha, for averaging.

use image::RgbaImage;
use nalgebra::Vector2;

/// Rows of RGBA, colour premultiplied by alpha/255, values 0 to 255. Everything outside is transparent.
pub(super) struct Premultiplied {
    width: usize,
    height: usize,
    /// Where the region's corner lies in the photo, in photo pixels.
    origin: Vector2<f64>,
    /// Photo pixels a pixel.
    scale: f64,
    data: Vec<[f32; 4]>,
}

impl Premultiplied {
    /// The part of `image` between the pixel coordinates `low` and `high`, clipped to the image and
    /// halved in resolution `halvings` times.
    pub(super) fn from_region(
        image: &RgbaImage,
        low: Vector2<f64>,
        high: Vector2<f64>,
        halvings: u32,
    ) -> Self {
        // One pixel of the halved image more on each side, for bilinear sampling.
        let margin = 2.0_f64.powf(f64::from(halvings));
        // `as` saturates at 0 and the type's end.
        let clip = |value: f64, size: u32| (value as u32).min(size);
        let (left, top) =
            (clip(low.x.floor() - margin, image.width()), clip(low.y.floor() - margin, image.height()));
        let (right, bottom) =
            (clip(high.x.ceil() + margin, image.width()), clip(high.y.ceil() + margin, image.height()));
        let (width, height) = (right.saturating_sub(left) as usize, bottom.saturating_sub(top) as usize);
        let row = |y: u32| image.rows().nth(y as usize).into_iter().flatten().skip(left as usize).take(width);
        let data = (top..bottom).flat_map(row).map(|pixel| premultiply(pixel.0)).collect();
        let origin = Vector2::new(f64::from(left), f64::from(top));
        let region = Self { width, height, origin, scale: 1.0, data };
        (0..halvings).fold(region, |finer, _| finer.halved())
    }

    /// Half the resolution, each pixel the mean of four; an odd last row or column is averaged with transparency.
    fn halved(&self) -> Self {
        let (width, height) = (self.width.div_ceil(2), self.height.div_ceil(2));
        let mut data = Vec::with_capacity(width * height);
        for y in 0..height {
            for x in 0..width {
                let four = [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(i, j)| self.at(2 * x + i, 2 * y + j));
                data.push(std::array::from_fn(|c| four.iter().map(|pixel| pixel[c]).sum::<f32>() / 4.0));
            }
        }
        Self { width, height, origin: self.origin, scale: self.scale * 2.0, data }
    }

    /// Bilinear sample at a photo's pixel coordinates (pixel centres at half-integers).
    pub(super) fn sample(&self, photo_pixel: Vector2<f64>) -> [f32; 4] {
        let p = (photo_pixel - self.origin) / self.scale - Vector2::new(0.5, 0.5);
        if !(p.x > -1.0 && p.y > -1.0 && p.x < self.width as f64 && p.y < self.height as f64) {
            return [0.0; 4];
        }
        let floor = p.map(f64::floor);
        let (u, v) = ((p.x - floor.x) as f32, (p.y - floor.y) as f32);
        let (x, y) = (floor.x as isize, floor.y as isize);
        let at = |i: isize, j: isize| match (usize::try_from(x + i), usize::try_from(y + j)) {
            (Ok(x), Ok(y)) => self.at(x, y),
            _ => [0.0; 4],
        };
        let (a, b, c, d) = (at(0, 0), at(1, 0), at(0, 1), at(1, 1));
        std::array::from_fn(|i| {
            let top = a[i] + (b[i] - a[i]) * u;
            let bottom = c[i] + (d[i] - c[i]) * u;
            top + (bottom - top) * v
        })
    }

    fn at(&self, x: usize, y: usize) -> [f32; 4] {
        if x >= self.width {
            return [0.0; 4];
        }
        self.data.get(y * self.width + x).copied().unwrap_or([0.0; 4])
    }
}

fn premultiply([r, g, b, a]: [u8; 4]) -> [f32; 4] {
    let weight = f32::from(a) / 255.0;
    [f32::from(r) * weight, f32::from(g) * weight, f32::from(b) * weight, f32::from(a)]
}

//! Straight alpha over a plain background.

use image::{Rgb, RgbImage, RgbaImage};

/// Lays an image with straight (not premultiplied) alpha over a plain background:
/// `(a colour + (255 - a) background) / 255` for each 8-bit channel, rounded to nearest.
///
/// The blend is done on the sRGB values as they are, which is what NeRF data sets do.
pub fn composite(image: &RgbaImage, background: [u8; 3]) -> RgbImage {
    let mut out = RgbImage::new(image.width(), image.height());
    for (Rgb(to), from) in out.pixels_mut().zip(image.pixels()) {
        let [r, g, b, a] = from.0;
        let a = u32::from(a);
        let blend = |c: u8, under: u8| {
            // At most 255 after the division, so the cast cannot cut anything off.
            ((u32::from(c) * a + u32::from(under) * (255 - a) + 127) / 255) as u8
        };
        let [br, bg, bb] = background;
        *to = [blend(r, br), blend(g, bg), blend(b, bb)];
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::Rgba;

    #[test]
    fn opaque_pixels_stay_and_clear_ones_show_the_background() {
        let mut image = RgbaImage::new(3, 1);
        image.put_pixel(0, 0, Rgba([10, 20, 30, 255]));
        image.put_pixel(1, 0, Rgba([10, 20, 30, 0]));
        image.put_pixel(2, 0, Rgba([0, 255, 100, 51]));
        let out = composite(&image, [255, 255, 0]);
        assert_eq!(out.get_pixel(0, 0).0, [10, 20, 30]);
        assert_eq!(out.get_pixel(1, 0).0, [255, 255, 0]);
        assert_eq!(out.get_pixel(2, 0).0, [204, 255, 20]);
    }
}

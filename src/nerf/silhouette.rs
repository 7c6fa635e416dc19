//! Pixels on or near the object of an image with alpha.

use image::RgbaImage;

/// Pixels, counted row by row, within a margin of a pixel that is not fully
/// transparent. The margin is 1/64 of the image's width, at least two pixels.
pub(super) fn dilated_silhouette(image: &RgbaImage) -> Vec<u32> {
    let (width, height) = (image.width() as usize, image.height() as usize);
    let margin = (width / 64).max(2);
    let solid: Vec<bool> = image.pixels().map(|p| p.0[3] > 0).collect();
    let mut wide = vec![false; solid.len()];
    for (row, wide) in solid.chunks_exact(width).zip(wide.chunks_exact_mut(width)) {
        for x in (0..width).filter(|&x| row[x]) {
            wide[x.saturating_sub(margin)..(x + margin + 1).min(width)].fill(true);
        }
    }
    let mut near = vec![false; solid.len()];
    for y in 0..height {
        let from = y.saturating_sub(margin)..(y + margin + 1).min(height);
        for other in from {
            for x in 0..width {
                near[y * width + x] |= wide[other * width + x];
            }
        }
    }
    (0..near.len() as u32).filter(|&p| near[p as usize]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_single_pixel_grows_to_a_square_cut_at_the_border() {
        let mut image = RgbaImage::new(10, 8);
        image.put_pixel(0, 4, image::Rgba([0, 0, 0, 1]));
        let near = dilated_silhouette(&image);
        let expected: Vec<u32> = (2..=6).flat_map(|y| (0..=2).map(move |x| y * 10 + x)).collect();
        assert_eq!(near, expected);
    }
}

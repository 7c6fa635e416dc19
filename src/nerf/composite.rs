//! Volume rendering of kept samples (Max 1995, as in NeRF), and its gradient.

use super::field::{Block, DENSITY_SLOPE};

/// What the samples of a ray add up to.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pixel {
    /// Sum of weight times colour, without background.
    pub colour: [f32; 3],
    /// Light that passes every sample.
    pub transmittance: f32,
}

impl Pixel {
    pub const EMPTY: Pixel = Pixel { colour: [0.0; 3], transmittance: 1.0 };

    /// The colour over `background`.
    pub fn over(&self, background: [f32; 3]) -> [f32; 3] {
        std::array::from_fn(|c| self.colour[c] + self.transmittance * background[c])
    }
}

/// Adds the samples of `blocks`, front to back, to the pixels of their rays.
pub(super) fn composite(blocks: &[Block], pixels: &mut [Pixel]) {
    for block in blocks {
        for i in 0..block.used {
            let pixel = &mut pixels[block.ray[i] as usize];
            let alpha = block.alpha.0[i];
            let weight = pixel.transmittance * alpha;
            for (sum, colour) in pixel.colour.iter_mut().zip(&block.colour) {
                *sum += weight * colour.0[i];
            }
            pixel.transmittance *= 1.0 - alpha;
        }
    }
}

/// Gradient of the loss with respect to a ray's colour over its background.
#[derive(Clone, Copy, Debug)]
pub(super) struct PixelGradient {
    /// d loss / d composited colour.
    pub d_colour: [f32; 3],
    /// The composited colour, background included.
    pub colour: [f32; 3],
}

/// Writes the gradients before the sigmoid and of the raw density into `blocks`.
/// With T the light that reaches a sample and S the colour that comes from behind
/// it, d C / d colour = T alpha and d C / d depth = T (1 - alpha) colour - S.
pub(super) fn composite_backward(blocks: &mut [Block], gradients: &[PixelGradient], front: &mut [Pixel]) {
    front.fill(Pixel::EMPTY);
    for block in blocks {
        for i in 0..block.used {
            let ray = block.ray[i] as usize;
            let (gradient, front) = (&gradients[ray], &mut front[ray]);
            let alpha = block.alpha.0[i];
            let weight = front.transmittance * alpha;
            front.transmittance *= 1.0 - alpha;
            let mut d_depth = 0.0;
            for c in 0..3 {
                let colour = block.colour[c].0[i];
                front.colour[c] += weight * colour;
                let behind = gradient.colour[c] - front.colour[c];
                d_depth += gradient.d_colour[c] * (front.transmittance * colour - behind);
                block.d_colour[c].0[i] = gradient.d_colour[c] * weight * colour * (1.0 - colour);
            }
            block.d_middle[0].0[i] = d_depth * DENSITY_SLOPE * block.optical_depth.0[i];
        }
        for rows in [&mut block.d_colour[..3], &mut block.d_middle[..1]] {
            for row in rows {
                row.0[block.used..].fill(0.0);
            }
        }
    }
}

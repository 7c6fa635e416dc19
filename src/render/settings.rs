//! What a caller may choose about an image.

use super::Light;

/// Settings of one image.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RenderSettings {
    /// Coverage samples a pixel: 1, 4, 8 or 16; other numbers go up to the next of these,
    /// and more than 16 to 16. A triangle is shaded once a pixel whatever the number.
    pub samples_per_pixel: u32,
    /// The light.
    pub light: Light,
    /// Distance along the optical axis before which nothing is seen, metres.
    pub near_m: f64,
}

impl Default for RenderSettings {
    fn default() -> Self {
        Self { samples_per_pixel: 8, light: Light::default(), near_m: 1e-3 }
    }
}

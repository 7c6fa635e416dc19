//! Textures: functions from (u, v), both 0 to 1 and v down, to an sRGB colour.

mod aged;
mod atlas;
mod color;
mod glyphs;
mod material;
mod noise;
mod palette;
mod patches;
mod pattern;
mod printed;
mod woven;

pub(super) use aged::aged;
pub(super) use atlas::{atlas, bands};
pub(super) use color::{Color, mix, of_hue, scaled};
pub(super) use material::{brushed_metal, leather, ribbed, skin_of_fruit, wood};
pub(super) use noise::fractal;
pub(super) use palette::Palette;
pub(super) use patches::mosaic_skin;
pub(super) use pattern::{nearly_plain, pattern, plain_or_pattern};
pub(super) use printed::printed;

/// A texture: the colour at (u, v).
pub(super) type Painter = Box<dyn Fn(f32, f32) -> Color + Send + Sync>;

/// Texels for a surface of the given size (metres): about 0.2 mm each, within bounds.
pub(super) fn texels(size_m: [f64; 2]) -> (u32, u32) {
    let side = |s: f64| ((s / 2e-4) as u32).next_multiple_of(64).clamp(128, 1024);
    (side(size_m[0]), side(size_m[1]))
}

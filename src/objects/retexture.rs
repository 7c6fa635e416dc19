//! Other textures for a mesh.

use std::collections::HashMap;
use std::sync::Arc;

use image::{Rgba, RgbaImage};

use super::dice::Dice;
use super::paint::{Painter, Palette, aged, mix, pattern, plain_or_pattern, printed};
use super::shape::box_project;
use crate::render::{Material, Mesh, bounding_sphere};

/// Side of a new texture, texels.
const SIDE: u32 = 768;
/// As if every object had this radius when features get their size, metres: that of a labelled object.
const RADIUS_M: f64 = 0.095;
/// How often a texture may lie across the object for its coordinates to be kept.
const DENSITIES: std::ops::RangeInclusive<f64> = 0.35..=6.0;

/// The mesh with a procedural texture or colour for each of its materials, drawn by its key and a number. Texture
/// coordinates stay where they spread a texture over the surface in a sensible size; elsewhere textures are laid from
/// three sides. Textures with holes keep them and change their colours.
pub(super) fn retextured(mesh: &Mesh, key: &str, number: u64) -> Mesh {
    let mut mesh = mesh.clone();
    let radius = bounding_sphere(&mesh).radius.max(1e-9);
    let mut dice = Dice::of(key, number);
    let palette = Palette::draw(&mut dice);
    // Half of the variants are rich in detail, whatever the original was.
    let detail = if dice.chance(0.5) { dice.range(0.5, 1.0) } else { dice.range(0.0, 0.6) };
    let wear = dice.unit() * dice.unit();
    let tile_m = dice.log_range(0.08, 0.2);
    let tile = tile_m * radius / RADIUS_M;
    let mut project = vec![false; mesh.materials.len()];
    let densities = densities(&mesh, radius);
    // Materials that shared a texture share the new one.
    let mut by_image: HashMap<*const RgbaImage, (Arc<RgbaImage>, bool)> = HashMap::new();
    for (index, material) in mesh.materials.iter_mut().enumerate() {
        let colors = palette.turned(index as u32 % 5);
        let own = material.texture.clone();
        let clear = own.as_ref().is_some_and(|image| image.pixels().any(|p| p[3] < 255));
        let kept = own.is_some() && densities.get(index).is_some_and(|d| DENSITIES.contains(d));
        let known = own.as_ref().and_then(|image| by_image.get(&Arc::as_ptr(image)).cloned());
        let (texture, on_own) = match (&own, known) {
            (_, Some(known)) => known,
            (Some(image), None) if clear && material.alpha_cutoff > 0.0 => {
                (Arc::new(recoloured(image, &mut dice, &colors)), true)
            }
            _ => {
                let size = if kept { [2.0 * RADIUS_M; 2] } else { [tile_m; 2] };
                let painter = match dice.int(0, 5) {
                    0 if kept => printed(&mut dice, size, &colors, detail),
                    1..=3 => plain_or_pattern(&mut dice, size, &colors, detail),
                    _ => pattern(&mut dice, size, &colors, detail),
                };
                let painter = aged(&mut dice, size, wear, painter);
                (Arc::new(image_of(&painter)), kept)
            }
        };
        if let Some(image) = &own {
            by_image.insert(Arc::as_ptr(image), (Arc::clone(&texture), on_own));
        }
        project[index] = !on_own;
        *material = Material { color: [1.0; 3], texture: Some(texture), ..material.clone() };
    }
    let materials = mesh.triangle_materials.clone();
    let chosen = |t: usize| materials.get(t).is_some_and(|m| project.get(*m as usize) == Some(&true));
    box_project(&mut mesh, tile, chosen);
    mesh
}

fn image_of(painter: &Painter) -> RgbaImage {
    RgbaImage::from_fn(SIDE, SIDE, |x, y| {
        let at = |i: u32| (i as f32 + 0.5) / SIDE as f32;
        let [r, g, b] = painter(at(x), at(y)).map(|c| (c.clamp(0.0, 1.0) * 255.0 + 0.5) as u8);
        Rgba([r, g, b, 255])
    })
}

/// The picture's lightness in two other colours.
fn recoloured(image: &RgbaImage, dice: &mut Dice, palette: &Palette) -> RgbaImage {
    let (dark, light) = (palette.any(dice), palette.any(dice));
    let mut image = image.clone();
    for pixel in image.pixels_mut() {
        let [r, g, b, a] = pixel.0;
        let grey = (f32::from(r) + f32::from(g) + f32::from(b)) / 765.0;
        let [r, g, b] = mix(dark, light, grey).map(|c| (c * 255.0 + 0.5) as u8);
        *pixel = Rgba([r, g, b, a]);
    }
    image
}

/// For each material how often its texture lies along the object's diameter, by areas; 0 without coordinates.
fn densities(mesh: &Mesh, radius: f64) -> Vec<f64> {
    let mut areas = vec![[0.0f64; 2]; mesh.materials.len()];
    for (triangle, material) in mesh.triangles.iter().zip(&mesh.triangle_materials) {
        let Some(area) = areas.get_mut(*material as usize) else { continue };
        let [a, b, c] =
            triangle.map(|i| mesh.positions.get(i as usize).copied().unwrap_or_default().map(f64::from));
        let [p, q, r] =
            triangle.map(|i| mesh.uvs.get(i as usize).copied().unwrap_or_default().map(f64::from));
        let (d, e): ([f64; 3], [f64; 3]) =
            (std::array::from_fn(|k| b[k] - a[k]), std::array::from_fn(|k| c[k] - a[k]));
        let cross = [d[1] * e[2] - d[2] * e[1], d[2] * e[0] - d[0] * e[2], d[0] * e[1] - d[1] * e[0]];
        area[0] += cross.iter().map(|x| x * x).sum::<f64>().sqrt();
        area[1] += ((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])).abs();
    }
    areas
        .iter()
        .map(
            |[surface, texture]| if *surface > 0.0 { (texture / surface).sqrt() * 2.0 * radius } else { 0.0 },
        )
        .collect()
}

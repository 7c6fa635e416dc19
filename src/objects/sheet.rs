//! Contact sheets: many objects in one picture.

use image::RgbaImage;
use rayon::prelude::*;

use super::entry::ObjectEntry;
use crate::geometry::{Point, direction_from_azimuth_elevation, look_at};
use crate::imaging::{Camera, composite};
use crate::render::{MeshError, RenderSettings, Renderer};

/// How a contact sheet looks.
#[derive(Clone, Copy, Debug)]
pub struct SheetSettings {
    /// Side of one picture, pixels.
    pub cell_px: u32,
    /// Pictures in a row.
    pub columns: u32,
    /// Azimuth of the camera, radians from +x towards +y.
    pub azimuth_rad: f64,
    /// Elevation of the camera, radians.
    pub elevation_rad: f64,
    /// Background.
    pub background: [u8; 3],
}

impl Default for SheetSettings {
    fn default() -> Self {
        Self {
            cell_px: 192,
            columns: 8,
            azimuth_rad: (-60f64).to_radians(),
            elevation_rad: 25f64.to_radians(),
            background: [255; 3],
        }
    }
}

/// Radius to which every object is scaled, and the camera's distance, metres.
const RADIUS_M: f64 = 0.1;
const DISTANCE_M: f64 = 0.3;

/// The objects' pictures row by row, each scaled to the same sphere; what could not be loaded leaves its cell empty
/// and comes back beside the sheet. `drawn` is called after each.
pub fn contact_sheet(
    entries: &[ObjectEntry],
    settings: &SheetSettings,
    drawn: impl Fn() + Sync,
) -> (RgbaImage, Vec<(String, MeshError)>) {
    let pictures: Vec<Result<RgbaImage, MeshError>> = entries
        .par_iter()
        .map(|entry| {
            let picture = picture(entry, settings);
            drawn();
            picture
        })
        .collect();
    let (cell, columns) = (settings.cell_px, settings.columns.clamp(1, entries.len().max(1) as u32));
    let rows = (entries.len() as u32).div_ceil(columns).max(1);
    let [r, g, b] = settings.background;
    let mut sheet = RgbaImage::from_pixel(cell * columns, cell * rows, image::Rgba([r, g, b, 255]));
    let mut failures = Vec::new();
    for (index, (entry, picture)) in (0u32..).zip(entries.iter().zip(pictures)) {
        match picture {
            Ok(picture) => {
                let (x, y) = (index % columns * cell, index / columns * cell);
                image::imageops::replace(&mut sheet, &picture, i64::from(x), i64::from(y));
            }
            Err(error) => failures.push((entry.key.clone(), error)),
        }
    }
    (sheet, failures)
}

fn picture(entry: &ObjectEntry, settings: &SheetSettings) -> Result<RgbaImage, MeshError> {
    let renderer = Renderer::new(&entry.load()?.fitted(Point::origin(), RADIUS_M));
    let sine: f64 = RADIUS_M / DISTANCE_M;
    let camera = Camera::square(settings.cell_px, 1.03 * sine / (1.0 - sine * sine).sqrt());
    let towards = direction_from_azimuth_elevation(settings.azimuth_rad, settings.elevation_rad);
    let eye = Point::origin() + towards.into_inner() * DISTANCE_M;
    let image = renderer.render(&camera, &look_at(&eye, &Point::origin(), 0.0), &RenderSettings::default());
    let flat = composite(&image, settings.background);
    Ok(image::DynamicImage::ImageRgb8(flat).to_rgba8())
}

//! Draws training rays from the given views.

use image::RgbaImage;
use rand::RngCore;
use rand_chacha::ChaCha8Rng;

use super::ray::Ray;
use super::silhouette::dilated_silhouette;
use super::simd::prefetch;
use super::view_rays::ViewRays;
use super::{Bounds, NerfError};
use crate::imaging::PosedImage;

/// Part of the rays drawn near the object; the rest comes from anywhere.
const NEAR_OBJECT: f32 = 0.8;

struct View<'a> {
    rays: ViewRays,
    image: &'a RgbaImage,
    /// Pixels on or near the object with their colours: draws are random, so that each
    /// look-up elsewhere would be a cache miss more.
    near_object: Vec<(u32, [u8; 4])>,
}

/// The views, ready to draw from.
pub(super) struct TrainingViews<'a> {
    views: Vec<View<'a>>,
    /// The colour behind the object if no view has an alpha channel.
    pub background: Option<[u8; 3]>,
}

/// A ray with what it should show. Its colour is sRGB in 0..1.
pub(super) struct TrainingRay {
    /// `None` if it misses the cube.
    pub ray: Option<Ray>,
    pub background: [f32; 3],
    pub target: [f32; 3],
}

impl<'a> TrainingViews<'a> {
    /// # Errors
    /// If there is no view, or one has a bad camera, pose or size.
    pub fn new(views: &'a [PosedImage], bounds: &Bounds) -> Result<Self, NerfError> {
        if views.is_empty() {
            return Err(NerfError::NoViews);
        }
        for (view, posed) in views.iter().enumerate() {
            posed.camera.check().map_err(|source| NerfError::Camera { view, source })?;
            let (image, camera) = (posed.image.dimensions(), (posed.camera.width, posed.camera.height));
            if image != camera {
                return Err(NerfError::ImageSize { view, image, camera });
            }
            if !posed.world_from_camera.to_homogeneous().iter().all(|x| x.abs() < 1e6) {
                return Err(NerfError::Pose { view });
            }
        }
        let masked = views.iter().any(|v| v.image.pixels().any(|p| p.0[3] < 255));
        let prepared: Vec<View> = views
            .iter()
            .map(|v| View {
                rays: ViewRays::new(&v.camera, &v.world_from_camera, bounds),
                image: &v.image,
                near_object: if masked { with_colours(&v.image) } else { Vec::new() },
            })
            .collect();
        let seen = |v: &View| (0..v.rays.width * v.rays.height).any(|pixel| v.rays.ray(pixel, 0.5).is_some());
        if !prepared.iter().any(seen) {
            return Err(NerfError::BoundsUnseen { views: views.len() });
        }
        let background = (!masked).then(|| border_colour(views));
        Ok(TrainingViews { views: prepared, background })
    }

    /// `count` random rays. All are chosen before the first is looked up, so that their pixels, which lie
    /// anywhere in megabytes, are on their way at the same time: 6 to 10 % of a training.
    pub fn draw(&self, rng: &mut ChaCha8Rng, count: usize) -> Vec<TrainingRay> {
        let choices: Vec<Choice> = (0..count).map(|_| self.choose(rng)).collect();
        choices.iter().map(|choice| self.look_up(choice)).collect()
    }

    fn choose(&self, rng: &mut ChaCha8Rng) -> Choice {
        let number = below(rng, self.views.len() as u32);
        let view = &self.views[number as usize];
        let near = unit(rng) < NEAR_OBJECT && !view.near_object.is_empty();
        let at = if near {
            let at = below(rng, view.near_object.len() as u32);
            prefetch(&view.near_object[at as usize]);
            at
        } else {
            below(rng, view.rays.width * view.rays.height)
        };
        let phase = unit(rng);
        let background = match self.background {
            Some(colour) => colour.map(|c| f32::from(c) / 255.0),
            None => [unit(rng), unit(rng), unit(rng)],
        };
        Choice { view: number, near, at, phase, background }
    }

    fn look_up(&self, choice: &Choice) -> TrainingRay {
        let &Choice { view, near, at, phase, background } = choice;
        let view = &self.views[view as usize];
        let (pixel, rgba) = if near { view.near_object[at as usize] } else { (at, rgba_of(view.image, at)) };
        let ray = view.rays.ray(pixel, phase);
        let rgba = rgba.map(|c| f32::from(c) / 255.0);
        let target = std::array::from_fn(|c| rgba[c] * rgba[3] + background[c] * (1.0 - rgba[3]));
        TrainingRay { ray, background, target }
    }
}

/// What is random about a ray.
struct Choice {
    view: u32,
    /// Whether it is one of those near the object.
    near: bool,
    /// Its number among them, or its pixel.
    at: u32,
    phase: f32,
    background: [f32; 3],
}

fn with_colours(image: &RgbaImage) -> Vec<(u32, [u8; 4])> {
    dilated_silhouette(image).into_iter().map(|pixel| (pixel, rgba_of(image, pixel))).collect()
}

/// Pixels are counted row by row.
fn rgba_of(image: &RgbaImage, pixel: u32) -> [u8; 4] {
    image.get_pixel(pixel % image.width(), pixel / image.width()).0
}

/// Uniform in `0..n`; the bias is below n / 2^32.
fn below(rng: &mut ChaCha8Rng, n: u32) -> u32 {
    ((u64::from(rng.next_u32()) * u64::from(n)) >> 32) as u32
}

/// Uniform in [0, 1).
fn unit(rng: &mut ChaCha8Rng) -> f32 {
    (rng.next_u32() >> 8) as f32 / (1 << 24) as f32
}

/// The median colour of the images' borders, a channel at a time.
fn border_colour(views: &[PosedImage]) -> [u8; 3] {
    let mut counts = [[0u64; 256]; 3];
    for v in views {
        let (w, h) = v.image.dimensions();
        let rows = (0..w).flat_map(|x| [(x, 0), (x, h - 1)]);
        let columns = (0..h).flat_map(|y| [(0, y), (w - 1, y)]);
        for (x, y) in rows.chain(columns) {
            for (count, value) in counts.iter_mut().zip(v.image.get_pixel(x, y).0) {
                count[usize::from(value)] += 1;
            }
        }
    }
    counts.map(|count| {
        let half = count.iter().sum::<u64>() / 2;
        let mut sum = 0;
        let median = count.iter().position(|&n| {
            sum += n;
            sum > half
        });
        median.unwrap_or(0) as u8
    })
}

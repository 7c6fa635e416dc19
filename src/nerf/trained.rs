//! A trained NeRF: renders views and measures itself against given ones.

use image::{Rgba, RgbaImage};

use super::composite::{Pixel, composite};
use super::distance_map::DistanceMap;
use super::field::{Field, forward};
use super::ray::{Ray, STEP};
use super::trace::{Samples, Thresholds};
use super::view_rays::ViewRays;
use super::{Bounds, InstructionSet};
use crate::geometry::Pose;
use crate::imaging::{Camera, PosedImage, composite as over, psnr, ssim};

const THRESHOLDS: Thresholds = Thresholds { weight: 3e-3, transmittance: 3e-3 };
/// Rays traced together: their samples fill blocks and stay in the cache.
const GROUP: usize = 256;

/// A trained NeRF.
#[derive(Clone, Debug)]
pub struct Nerf {
    field: Field,
    map: DistanceMap,
    bounds: Bounds,
    background: Option<[u8; 3]>,
    instruction_set: InstructionSet,
}

/// Quality on given views, one figure a view.
#[derive(Clone, Debug, PartialEq)]
pub struct Evaluation {
    /// Peak signal-to-noise ratio, dB.
    pub psnr_db: Vec<f64>,
    /// Structural similarity.
    pub ssim: Vec<f64>,
}

impl Evaluation {
    /// Mean of the views' ratios, dB; NaN without views.
    pub fn mean_psnr_db(&self) -> f64 {
        self.psnr_db.iter().sum::<f64>() / self.psnr_db.len() as f64
    }

    /// Mean of the views' similarities; NaN without views.
    pub fn mean_ssim(&self) -> f64 {
        self.ssim.iter().sum::<f64>() / self.ssim.len() as f64
    }
}

impl Nerf {
    pub(super) fn new(
        field: Field,
        map: DistanceMap,
        bounds: Bounds,
        background: Option<[u8; 3]>,
        instruction_set: InstructionSet,
    ) -> Nerf {
        Nerf { field, map, bounds, background, instruction_set }
    }

    /// The cube it was trained in.
    pub fn bounds(&self) -> &Bounds {
        &self.bounds
    }

    /// The background that images are compared over: the colour found in training
    /// views without alpha, else black, as in the paper's labels.
    pub fn background(&self) -> [u8; 3] {
        self.background.unwrap_or([0; 3])
    }

    /// What `camera` sees from `world_from_camera`: sRGB with straight alpha, on
    /// this thread alone. A camera or pose with numbers that are not finite sees nothing.
    pub fn render(&self, camera: &Camera, world_from_camera: &Pose) -> RgbaImage {
        let view = ViewRays::new(camera, world_from_camera, &self.bounds);
        let mut image = RgbaImage::new(camera.width, camera.height);
        let mut samples = Samples::new();
        let (mut rays, mut places) = (Vec::with_capacity(GROUP), Vec::with_capacity(GROUP));
        let mut pixels = Vec::with_capacity(GROUP);
        let count = camera.width.saturating_mul(camera.height);
        for pixel in 0..count {
            if let Some(ray) = view.ray(pixel, 0.5) {
                rays.push(ray);
                places.push(pixel);
            }
            if rays.len() == GROUP || pixel + 1 == count {
                self.shade(&mut samples, &rays, &mut pixels);
                for (&place, pixel) in places.iter().zip(&pixels) {
                    image.put_pixel(place % camera.width, place / camera.width, straight(pixel));
                }
                rays.clear();
                places.clear();
            }
        }
        image
    }

    fn shade(&self, samples: &mut Samples, rays: &[Ray], pixels: &mut Vec<Pixel>) {
        samples.collect(self.instruction_set, &self.field, &self.map, rays, THRESHOLDS);
        let blocks = samples.blocks();
        forward(self.instruction_set, &self.field, STEP, blocks);
        pixels.clear();
        pixels.resize(rays.len(), Pixel::EMPTY);
        composite(blocks, pixels);
    }

    /// PSNR of each view over [`Self::background`], dB.
    pub fn psnr_db(&self, views: &[PosedImage]) -> Vec<f64> {
        let each = self.psnr_db_over([self.background()], views);
        each.into_iter().map(|[psnr_db]| psnr_db).collect()
    }

    /// PSNR of each view over each of `backgrounds`, dB.
    pub fn psnr_db_over<const N: usize>(
        &self,
        backgrounds: [[u8; 3]; N],
        views: &[PosedImage],
    ) -> Vec<[f64; N]> {
        let one = |v: &PosedImage| {
            let image = self.render(&v.camera, &v.world_from_camera);
            backgrounds.map(|background| psnr(&over(&image, background), &over(&v.image, background)))
        };
        views.iter().map(one).collect()
    }

    /// PSNR and SSIM of each view over [`Self::background`].
    pub fn evaluate(&self, views: &[PosedImage]) -> Evaluation {
        let background = self.background();
        let mut evaluation = Evaluation { psnr_db: Vec::new(), ssim: Vec::new() };
        for v in views {
            let image = over(&self.render(&v.camera, &v.world_from_camera), background);
            let truth = over(&v.image, background);
            evaluation.psnr_db.push(psnr(&image, &truth));
            evaluation.ssim.push(ssim(&image, &truth));
        }
        evaluation
    }
}

/// Straight alpha from colours that are multiplied by it.
fn straight(pixel: &Pixel) -> Rgba<u8> {
    let alpha = 1.0 - pixel.transmittance;
    if alpha < 0.5 / 255.0 {
        return Rgba([0; 4]);
    }
    let byte = |x: f32| (x * 255.0 + 0.5) as u8;
    let [r, g, b] = pixel.colour.map(|c| byte(c / alpha));
    Rgba([r, g, b, byte(alpha)])
}

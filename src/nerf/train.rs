//! Training: draw rays, find samples, composite, go back, step.

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

use super::composite::{Pixel, PixelGradient, composite, composite_backward};
use super::distance_map::CELLS;
use super::field::{Adam, Field, Gradients, Rate, backward, forward};
use super::occupancy::Occupancy;
use super::ray::{Ray, STEP};
use super::trace::{Samples, Thresholds};
use super::training_views::{TrainingRay, TrainingViews};
use super::visual_hull::visual_hull;
use super::{Bounds, Nerf, NerfError, NerfSettings};
use crate::imaging::PosedImage;

/// Rays that let less light through stop.
const OPAQUE: f32 = 1e-3;
/// Kept samples that a group of rays should have: enough to fill blocks, few
/// enough to stay in the second-level cache.
const GROUP_SAMPLES: usize = 1024;
/// Fewest and most rays in a group.
const GROUP: (usize, usize) = (24, 1024);
/// Steps between two updates of the occupancy grid; the step up to which an update
/// probes every cell, and the step up to which there are twice as many.
const UPDATE_EVERY: u32 = 32;
const PROBE_ALL_UNTIL: u32 = 112;
const PROBE_OFTEN_UNTIL: u32 = 256;

/// How far training has come.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TrainProgress {
    /// Steps done.
    pub step: u32,
    /// Steps to do.
    pub steps: u32,
    /// Mean squared error of a channel over the rays of the last step, sRGB in 0..1.
    pub loss: f64,
}

/// Trains a NeRF of what the cube `bounds` holds, on this thread alone.
///
/// Views with alpha are shown over a random background for each ray; if no view
/// has a pixel that is not opaque, the colours are taken as they are and the
/// median colour of the images' borders counts as background.
/// `progress` is called after every step.
///
/// # Errors
/// [`NerfError`] names the view, number or setting that cannot be used.
pub fn train(
    views: &[PosedImage],
    bounds: &Bounds,
    settings: &NerfSettings,
    progress: &mut dyn FnMut(TrainProgress),
) -> Result<Nerf, NerfError> {
    settings.check()?;
    bounds.check()?;
    let photos = views;
    let views = TrainingViews::new(photos, bounds)?;
    let carved = settings.carve && views.background.is_none();
    let hull = if carved { visual_hull(photos, bounds) } else { vec![true; CELLS * CELLS * CELLS] };
    let mut trainer = Trainer::new(settings, hull);
    for step in 0..settings.steps {
        let loss = trainer.step(&views, step);
        let every = if step < PROBE_OFTEN_UNTIL { UPDATE_EVERY / 2 } else { UPDATE_EVERY };
        if (step + 1) % every == 0 {
            let all = step < PROBE_ALL_UNTIL;
            let Trainer { occupancy, field, rng, .. } = &mut trainer;
            occupancy.update(settings.instruction_set, field, rng, all);
        }
        progress(TrainProgress { step: step + 1, steps: settings.steps, loss });
    }
    Ok(Nerf::new(trainer.field, trainer.occupancy.map, *bounds, views.background, settings.instruction_set))
}

struct Trainer {
    settings: NerfSettings,
    rng: ChaCha8Rng,
    field: Field,
    gradients: Gradients,
    adam: Adam,
    occupancy: Occupancy,
    samples: Samples,
    /// Rays in a group, so many that about [`GROUP_SAMPLES`] samples are kept.
    group: usize,
}

impl Trainer {
    fn new(settings: &NerfSettings, hull: Vec<bool>) -> Trainer {
        let mut rng = ChaCha8Rng::seed_from_u64(settings.seed);
        let field = Field::new(settings.table_bits, &mut rng);
        Trainer {
            settings: *settings,
            gradients: Gradients::new(&field),
            adam: Adam::new(&field, settings.square_decay),
            occupancy: Occupancy::full(hull),
            samples: Samples::new(),
            group: GROUP.0,
            rng,
            field,
        }
    }

    /// One optimiser step; returns the mean squared error of a channel.
    fn step(&mut self, views: &TrainingViews, step: u32) -> f64 {
        let wanted = self.settings.samples_per_step as usize;
        let (mut kept, mut drawn, mut loss) = (0, 0, 0.0);
        // Views that show nothing may keep no sample at all: the rays end such a step.
        while kept < wanted && drawn < wanted {
            let group = views.draw(&mut self.rng, self.group);
            drawn += group.len();
            loss += self.add_gradients(group);
            kept += self.samples.len();
            let per_ray = (self.samples.len() as f64 / self.group as f64).max(1.0);
            self.group = ((GROUP_SAMPLES as f64 / per_ray) as usize).clamp(GROUP.0, GROUP.1);
        }
        let decay = self.settings.decay(step);
        let rate = Rate {
            grid: self.settings.grid_rate * decay,
            networks: self.settings.network_rate * decay,
            scale: 1.0 / drawn as f32,
        };
        self.adam.step(self.settings.instruction_set, &mut self.field, &mut self.gradients, rate);
        loss / (3 * drawn) as f64
    }

    /// Adds the gradients of a group of rays; returns the sum of their squared errors.
    fn add_gradients(&mut self, group: Vec<TrainingRay>) -> f64 {
        let set = self.settings.instruction_set;
        let mut rays: Vec<Ray> = Vec::with_capacity(group.len());
        let mut sought = Vec::with_capacity(group.len());
        let mut loss = 0.0;
        for drawn in group {
            match drawn.ray {
                Some(ray) => {
                    rays.push(ray);
                    sought.push((drawn.background, drawn.target));
                }
                None => loss += squared_error(drawn.background, drawn.target),
            }
        }
        let thresholds = Thresholds { weight: self.settings.least_weight, transmittance: OPAQUE };
        self.samples.collect(set, &self.field, &self.occupancy.map, &rays, thresholds);
        let blocks = self.samples.blocks();
        forward(set, &self.field, STEP, blocks);
        let mut pixels = vec![Pixel::EMPTY; rays.len()];
        composite(blocks, &mut pixels);
        let mut gradients = Vec::with_capacity(rays.len());
        for (pixel, (background, target)) in pixels.iter().zip(sought) {
            let colour = pixel.over(background);
            loss += squared_error(colour, target);
            let d_colour = std::array::from_fn(|c| 2.0 * (colour[c] - target[c]));
            gradients.push(PixelGradient { d_colour, colour });
        }
        composite_backward(blocks, &gradients, &mut pixels);
        backward(set, &self.field, blocks, &mut self.gradients);
        loss
    }
}

fn squared_error(a: [f32; 3], b: [f32; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| f64::from(a - b) * f64::from(a - b)).sum()
}

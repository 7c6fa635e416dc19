//! Finds the samples along rays that are worth a colour.

use super::distance_map::DistanceMap;
use super::field::{Block, DensityBlock, Field, GEOMETRY, density};
use super::ray::{Ray, STEP};
use super::simd::{InstructionSet, LANES};

/// Samples a ray gets in a wave; after a wave, rays that are opaque stop.
const WAVE: usize = 4;

/// What a sample must contribute.
#[derive(Clone, Copy)]
pub(super) struct Thresholds {
    /// A sample of less weight gets no colour.
    pub weight: f32,
    /// A ray of less transmittance stops.
    pub transmittance: f32,
}

/// Samples kept so far, in blocks, with the buffers that finding them needs.
pub(super) struct Samples {
    blocks: Vec<Block>,
    kept: usize,
    wave: Vec<DensityBlock>,
    wave_rays: Vec<u32>,
    alive: Vec<u32>,
}

impl Samples {
    pub fn new() -> Samples {
        Samples { blocks: Vec::new(), kept: 0, wave: Vec::new(), wave_rays: Vec::new(), alive: Vec::new() }
    }

    /// How many samples are kept.
    pub fn len(&self) -> usize {
        self.kept
    }

    /// The kept samples, those of one ray in order of distance.
    pub fn blocks(&mut self) -> &mut [Block] {
        &mut self.blocks[..self.kept.div_ceil(LANES)]
    }

    /// Replaces what is kept by the samples of `rays`, wave by wave; a sample's
    /// `ray` is the index into `rays`.
    pub fn collect(
        &mut self,
        set: InstructionSet,
        field: &Field,
        map: &DistanceMap,
        rays: &mut [Ray],
        thresholds: Thresholds,
    ) {
        self.kept = 0;
        self.alive.clear();
        self.alive.extend(0..rays.len() as u32);
        while self.march(map, rays) {
            let used = self.wave_rays.len().div_ceil(LANES);
            density(set, field, STEP, &mut self.wave[..used]);
            self.keep(rays, thresholds);
            self.alive.retain(|&r| rays[r as usize].transmittance >= thresholds.transmittance);
        }
        let kept = self.kept;
        for (b, block) in self.blocks().iter_mut().enumerate() {
            block.used = (kept - b * LANES).min(LANES);
        }
    }

    /// Fills the wave with the next samples of the rays alive; false if there are none.
    fn march(&mut self, map: &DistanceMap, rays: &mut [Ray]) -> bool {
        self.wave_rays.clear();
        let wave_rays = &mut self.wave_rays;
        let wave = &mut self.wave;
        self.alive.retain(|&r| {
            let ray = &mut rays[r as usize];
            for _ in 0..WAVE {
                let Some(position) = ray.next_sample(map) else { return false };
                let (block, lane) = (wave_rays.len() / LANES, wave_rays.len() % LANES);
                if block == wave.len() {
                    wave.push(DensityBlock::EMPTY);
                }
                for (axis, p) in wave[block].position.iter_mut().zip(position) {
                    axis.0[lane] = p;
                }
                wave_rays.push(r);
            }
            true
        });
        !self.wave_rays.is_empty()
    }

    /// Walks the wave front to back and copies the samples that weigh enough.
    fn keep(&mut self, rays: &mut [Ray], thresholds: Thresholds) {
        for (i, &r) in self.wave_rays.iter().enumerate() {
            let (from, lane) = (&self.wave[i / LANES], i % LANES);
            let ray = &mut rays[r as usize];
            let alpha = from.alpha.0[lane];
            let weight = ray.transmittance * alpha;
            // A ray that became opaque within this wave has its samples behind that dropped.
            if weight < thresholds.weight || ray.transmittance < thresholds.transmittance {
                ray.transmittance *= 1.0 - alpha;
                continue;
            }
            ray.transmittance *= 1.0 - alpha;
            let (block, to) = (self.kept / LANES, self.kept % LANES);
            self.kept += 1;
            if block == self.blocks.len() {
                self.blocks.push(Block::EMPTY);
            }
            let block = &mut self.blocks[block];
            for (axis, from) in block.position.iter_mut().zip(&from.position) {
                axis.0[to] = from.0[lane];
            }
            for (feature, from) in block.features.iter_mut().zip(&from.features) {
                feature.0[to] = from.0[lane];
            }
            for (row, harmonic) in block.middle[GEOMETRY..].iter_mut().zip(ray.harmonics) {
                row.0[to] = harmonic;
            }
            block.ray[to] = r;
        }
    }
}

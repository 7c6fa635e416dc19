//! Finds the samples along rays that are worth a colour.

use super::distance_map::DistanceMap;
use super::field::{Block, Field, GEOMETRY, density};
use super::march::March;
use super::ray::{Ray, STEP};
use super::simd::{InstructionSet, LANES};

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
    march: March,
    /// Light that passes the samples seen so far, a ray.
    transmittance: Vec<f32>,
}

impl Samples {
    pub fn new() -> Samples {
        Samples { blocks: Vec::new(), kept: 0, march: March::new(), transmittance: Vec::new() }
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
        rays: &[Ray],
        thresholds: Thresholds,
    ) {
        self.kept = 0;
        self.march.start(rays);
        self.transmittance.clear();
        self.transmittance.resize(rays.len(), 1.0);
        loop {
            let wave = self.march.next_wave(set, map);
            if wave.rays.is_empty() {
                break;
            }
            density(set, field, STEP, &mut wave.blocks, wave.rays.len());
            self.keep(rays, thresholds);
        }
        let kept = self.kept;
        for (b, block) in self.blocks().iter_mut().enumerate() {
            block.used = (kept - b * LANES).min(LANES);
        }
    }

    /// Walks the wave front to back and copies the samples that weigh enough.
    fn keep(&mut self, rays: &[Ray], thresholds: Thresholds) {
        for i in 0..self.march.wave().rays.len() {
            let wave = self.march.wave();
            let (r, from, lane) = (wave.rays[i], &wave.blocks[i / LANES], i % LANES);
            let alpha = from.alpha.0[lane];
            let light = self.transmittance[r as usize];
            self.transmittance[r as usize] = light * (1.0 - alpha);
            // Samples of this wave behind the one that made the ray opaque are dropped.
            if light < thresholds.transmittance || light * alpha < thresholds.weight {
                continue;
            }
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
            for (row, harmonic) in block.middle[GEOMETRY..].iter_mut().zip(rays[r as usize].harmonics) {
                row.0[to] = harmonic;
            }
            block.ray[to] = r;
        }
        for (r, &light) in self.transmittance.iter().enumerate() {
            if light < thresholds.transmittance {
                self.march.stop(r as u32);
            }
        }
    }
}

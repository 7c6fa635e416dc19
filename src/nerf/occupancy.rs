//! Which cells hold anything: learnt from the density field itself.

use rand::Rng;
use rand_chacha::ChaCha8Rng;

use super::distance_map::{CELLS, DistanceMap};
use super::field::{DensityBlock, Field, density};
use super::ray::STEP;
use super::simd::{InstructionSet, LANES};

/// What a cell keeps of its opacity from one update to the next.
const DECAY: f32 = 0.9;
/// The same while every cell is probed: the field changes fast then, and empty
/// space that counts as occupied costs most of the time.
const EARLY_DECAY: f32 = 0.3;
/// Opacity of one step from which a cell counts as occupied: above the least weight
/// of a kept sample, below the 0.0104 of a field that has learnt nothing.
const OCCUPIED: f32 = 7e-3;
/// After the first updates one cell in so many is probed, besides every second occupied one.
const STRIDE: usize = 8;

/// Largest recent opacity of each cell, and the map that marching reads.
pub(super) struct Occupancy {
    opacity: Vec<f32>,
    /// Cells that may be occupied, in rising order.
    hull: Vec<u32>,
    pub map: DistanceMap,
    updates: usize,
    blocks: Vec<DensityBlock>,
}

impl Occupancy {
    /// Every cell of `hull` (one flag a cell, x fastest) occupied.
    pub fn full(hull: Vec<bool>) -> Occupancy {
        Occupancy {
            opacity: hull.iter().map(|&may| f32::from(u8::from(may))).collect(),
            map: DistanceMap::new(&hull),
            hull: (0..hull.len() as u32).filter(|&cell| hull[cell as usize]).collect(),
            updates: 0,
            blocks: vec![DensityBlock::EMPTY; 64],
        }
    }

    /// Probes the field at a random point of some cells (of all cells if `all`).
    pub fn update(&mut self, set: InstructionSet, field: &Field, rng: &mut ChaCha8Rng, all: bool) {
        let phase = self.updates;
        self.updates += 1;
        let probed: Vec<u32> = (self.hull.iter().copied())
            .filter(|&cell| {
                let cell = cell as usize;
                all || cell % STRIDE == phase % STRIDE
                    || (cell % 2 == phase % 2 && self.opacity[cell] > OCCUPIED)
            })
            .collect();
        // What `full` set is no observation: the first probe replaces it.
        let decay = match (phase, all) {
            (0, _) => 0.0,
            (_, true) => EARLY_DECAY,
            (_, false) => DECAY,
        };
        self.opacity.iter_mut().for_each(|o| *o *= decay);
        for cells in probed.chunks(self.blocks.len() * LANES) {
            let used = cells.len().div_ceil(LANES);
            let blocks = &mut self.blocks[..used];
            for (cells, block) in cells.chunks(LANES).zip(blocks.iter_mut()) {
                for (i, &cell) in cells.iter().enumerate() {
                    let cell = cell as usize;
                    let corner = [cell % CELLS, cell / CELLS % CELLS, cell / (CELLS * CELLS)];
                    for (axis, corner) in block.position.iter_mut().zip(corner) {
                        axis.0[i] = (corner as f32 + rng.random::<f32>()) * DistanceMap::CELL;
                    }
                }
            }
            density(set, field, STEP, blocks, cells.len());
            for (cells, block) in cells.chunks(LANES).zip(blocks.iter()) {
                for (&cell, &alpha) in cells.iter().zip(&block.alpha.0) {
                    let opacity = &mut self.opacity[cell as usize];
                    *opacity = opacity.max(alpha);
                }
            }
        }
        // Cells outside the hull begin with no opacity and are never probed.
        let occupied: Vec<bool> = self.opacity.iter().map(|&o| o > OCCUPIED).collect();
        self.map = DistanceMap::new(&occupied);
    }
}

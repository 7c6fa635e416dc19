//! Marches sixteen rays at once to their next samples in occupied cells.

use super::distance_map::{CELLS, DistanceMap};
use super::field::DensityBlock;
use super::ray::{Ray, STEP};
use super::simd::{LANES, Simd, kernel};

/// Rays in a packet.
const RAYS: usize = 16;
/// Samples a ray gets in a wave; after a wave, rays that are opaque stop.
const WAVE: i32 = 4;

/// Sixteen rays, a quantity a row. Counts are whole numbers in floats, as the
/// march computes with them.
#[derive(Clone)]
#[repr(C, align(64))]
pub(super) struct Packet {
    origin: [[f32; RAYS]; 3],
    direction: [[f32; RAYS]; 3],
    near: [f32; RAYS],
    samples_per_cell: [f32; RAYS],
    samples: [f32; RAYS],
    next: [f32; RAYS],
}

impl Packet {
    const EMPTY: Packet = Packet {
        origin: [[0.0; RAYS]; 3],
        direction: [[0.0; RAYS]; 3],
        near: [0.0; RAYS],
        samples_per_cell: [0.0; RAYS],
        samples: [0.0; RAYS],
        next: [0.0; RAYS],
    };
}

/// Rays under way and the samples of the current wave.
pub(super) struct March {
    packets: Vec<Packet>,
    wave: Wave,
}

/// Positions of samples, in blocks, and the rays they lie on.
pub(super) struct Wave {
    pub blocks: Vec<DensityBlock>,
    pub rays: Vec<u32>,
}

impl March {
    pub fn new() -> March {
        March { packets: Vec::new(), wave: Wave { blocks: Vec::new(), rays: Vec::new() } }
    }

    /// Puts `rays` at their start.
    pub fn start(&mut self, rays: &[Ray]) {
        self.packets.clear();
        for rays in rays.chunks(RAYS) {
            let mut packet = Packet::EMPTY;
            for (i, ray) in rays.iter().enumerate() {
                for a in 0..3 {
                    packet.origin[a][i] = ray.origin[a];
                    packet.direction[a][i] = ray.direction[a];
                }
                packet.near[i] = ray.near;
                packet.samples_per_cell[i] = ray.samples_per_cell;
                packet.samples[i] = ray.samples as f32;
            }
            self.packets.push(packet);
        }
        let most = rays.len() * WAVE as usize;
        if self.wave.blocks.len() * LANES < most {
            self.wave.blocks.resize(most.div_ceil(LANES), DensityBlock::EMPTY);
        }
    }

    /// Finds up to four more samples of each ray, those of one ray in order of
    /// distance. Empty when every ray has left the cube or was stopped.
    pub fn next_wave(&mut self, set: super::InstructionSet, map: &DistanceMap) -> &mut Wave {
        self.wave.rays.clear();
        march(set, &mut self.packets, map, &mut self.wave);
        &mut self.wave
    }

    /// The ray gets no more samples.
    pub fn stop(&mut self, ray: u32) {
        if let Some(packet) = self.packets.get_mut(ray as usize / RAYS) {
            packet.samples[ray as usize % RAYS] = 0.0;
        }
    }

    pub fn wave(&self) -> &Wave {
        &self.wave
    }
}

kernel! {
    /// Moves every packet on until each ray has its samples of this wave.
    fn march(packets: &mut [Packet], map: &DistanceMap, wave: &mut Wave) = march_body
}

// Plain loops over sixteen lanes, which compilers turn into vectors. Unlike `clamp`,
// `max` then `min` turns NaN into a number, as the casts need.
#[allow(clippy::manual_clamp)]
#[inline(always)]
fn march_body<S: Simd, const T: usize>(_: S, packets: &mut [Packet], map: &DistanceMap, wave: &mut Wave) {
    let cells = map.cells();
    for (p, packet) in packets.iter_mut().enumerate() {
        // Most packets are through while the last rays still graze the object.
        if packet.next.iter().zip(&packet.samples).all(|(next, samples)| next >= samples) {
            continue;
        }
        let mut quota = [WAVE; RAYS];
        loop {
            let mut position = [[0.0f32; RAYS]; 3];
            let mut index = [0u32; RAYS];
            for i in 0..RAYS {
                let t = packet.near[i] + packet.next[i] * STEP;
                let mut cell = [0; 3];
                for a in 0..3 {
                    let x = (packet.origin[a][i] + t * packet.direction[a][i]).max(0.0).min(1.0);
                    position[a][i] = x;
                    // SAFETY: `x` is in 0..=1 (NaN became 0), so the product is in 0..=64.
                    cell[a] = unsafe { (x * CELLS as f32).to_int_unchecked::<i32>() }.min(CELLS as i32 - 1);
                }
                index[i] = ((cell[2] * CELLS as i32 + cell[1]) * CELLS as i32 + cell[0]) as u32;
            }
            let mut distance = [0i32; RAYS];
            for i in 0..RAYS {
                distance[i] = i32::from(cells[index[i] as usize % (CELLS * CELLS * CELLS)]);
            }
            let mut open = 0u32;
            let mut hits = 0u32;
            for i in 0..RAYS {
                let here = packet.next[i] < packet.samples[i] && quota[i] > 0;
                let hit = here && distance[i] == 0;
                // Within `distance - 1` cells' width of here nothing is occupied.
                let free = (distance[i] - 1).max(0) as f32 * packet.samples_per_cell[i];
                // SAFETY: distance is a byte and samples_per_cell below 3.
                let free = unsafe { free.to_int_unchecked::<i32>() } as f32;
                packet.next[i] += if here { 1.0 + free } else { 0.0 };
                quota[i] -= i32::from(hit);
                open |= u32::from(here) << i;
                hits |= u32::from(hit) << i;
            }
            if open == 0 {
                break;
            }
            while hits != 0 {
                let i = hits.trailing_zeros() as usize;
                hits &= hits - 1;
                let (block, lane) = (wave.rays.len() / LANES, wave.rays.len() % LANES);
                let to = &mut wave.blocks[block].position;
                for a in 0..3 {
                    to[a].0[lane] = position[a][i];
                }
                wave.rays.push((p * RAYS + i) as u32);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::nerf::InstructionSet;
    use proptest::prelude::*;

    /// Every sample position along `ray` in an occupied cell, one by one.
    fn walk(ray: &Ray, map: &DistanceMap) -> Vec<[f32; 3]> {
        let positions = (0..ray.samples).map(|k| {
            let t = ray.near + k as f32 * STEP;
            std::array::from_fn(|a| (ray.origin[a] + t * ray.direction[a]).clamp(0.0, 1.0))
        });
        positions.filter(|&p| map.cells_to_occupied(p) == 0).collect()
    }

    proptest! {
        #[test]
        fn marching_by_distance_finds_the_samples_that_a_walk_over_all_finds(
            starts in prop::collection::vec(
                (prop::array::uniform3(-1.0..2.0f32), prop::array::uniform3(0.2..0.8f32), 0.0..1.0f32), 1..40),
            seeds in prop::collection::vec(0..CELLS * CELLS * CELLS, 1..30),
        ) {
            let mut occupied = vec![false; CELLS * CELLS * CELLS];
            for cell in seeds {
                for near in [cell, cell ^ 1, cell ^ 64, cell ^ 4096] {
                    occupied[near] = true;
                }
            }
            let map = DistanceMap::new(&occupied);
            let rays: Vec<Ray> = starts.iter().filter_map(|(origin, through, phase)| {
                let d: [f32; 3] = std::array::from_fn(|a| through[a] - origin[a]);
                let norm = d.iter().map(|x| x * x).sum::<f32>().sqrt();
                Ray::through_cube(*origin, d.map(|x| x / norm), *phase)
            }).collect();
            let mut march = March::new();
            for set in InstructionSet::available() {
                march.start(&rays);
                let mut found = vec![Vec::new(); rays.len()];
                loop {
                    let wave = march.next_wave(set, &map);
                    if wave.rays.is_empty() {
                        break;
                    }
                    for (i, &r) in wave.rays.iter().enumerate() {
                        found[r as usize].push([0, 1, 2].map(|a| wave.blocks[i / LANES].position[a].0[i % LANES]));
                    }
                }
                for (ray, found) in rays.iter().zip(found) {
                    let expected = walk(ray, &map);
                    // A fused multiply-add may put a sample on the other side of a cell's face.
                    let stray = |a: &[[f32; 3]], b: &[[f32; 3]]| a.iter().filter(|p| !b.iter().any(|q|
                        (0..3).all(|i| (p[i] - q[i]).abs() < 1e-6))).filter(|p| p.iter().all(|x| {
                            let f = x * CELLS as f32; (f - f.round()).abs() > 1e-4 })).count();
                    prop_assert_eq!(stray(&found, &expected), 0);
                    prop_assert_eq!(stray(&expected, &found), 0);
                }
            }
        }
    }
}

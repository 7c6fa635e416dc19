//! The multi-resolution hash grid (Müller et al. 2022, section 3) with an index
//! that keeps neighbours along x adjacent: `hash(y, z) + x`.

use rand::Rng;
use rand_chacha::ChaCha8Rng;

use crate::nerf::simd::{LANES, LINE, Lanes, Lines};

/// Levels, from 16 to 128 cells along an edge of the cube.
pub(in crate::nerf) const LEVELS: usize = 5;
/// Floats in an entry of the table.
pub(in crate::nerf) const ENTRY: usize = 4;
/// Cells along an edge, a level: 16 * (128 / 16)^(level / 4), rounded.
const CELLS: [u32; LEVELS] = [16, 27, 45, 76, 128];
/// The two large primes of Teschner et al. (2003).
const PRIMES: [u32; 2] = [2_654_435_761, 805_459_861];

/// Where a level lies in the table.
#[derive(Clone, Copy, Debug)]
pub(in crate::nerf) struct Level {
    first_entry: u32,
    cells: u32,
    /// Range of the hash less one; `None` where every vertex has its own entry.
    mask: Option<u32>,
}

/// The trainable grid over the unit cube.
#[derive(Clone, Debug)]
pub(in crate::nerf) struct HashGrid {
    pub levels: [Level; LEVELS],
    /// Entries of four floats, level after level.
    pub table: Lines,
}

/// For the samples of a block and one level: the four pairs of neighbours along x.
pub(in crate::nerf) struct Corners {
    /// Entry of the pair's first vertex; the second is the next entry.
    pub entry: [[u32; LANES]; 4],
    /// Weight of the pair, from y and z.
    pub weight: [Lanes; 4],
    /// Weight of the second vertex in its pair.
    pub along_x: Lanes,
}

impl HashGrid {
    /// A level whose vertices fit into `2^table_bits` entries is stored without hashing.
    pub fn new(table_bits: u32, rng: &mut ChaCha8Rng) -> HashGrid {
        let hashed = 1 << table_bits;
        let mut next = 0;
        let levels = CELLS.map(|cells| {
            let vertices = cells + 1;
            let dense = vertices.pow(3) <= hashed;
            // Room for x beyond the hash instead of wrapping round keeps every pair adjacent.
            let entries = if dense { vertices.pow(3) } else { hashed + vertices };
            let level = Level { first_entry: next, cells, mask: (!dense).then_some(hashed - 1) };
            next += entries.next_multiple_of((LINE / ENTRY) as u32);
            level
        });
        let mut table = Lines::new(next as usize * ENTRY / LINE);
        for x in table.iter_mut().flat_map(|line| &mut line.0) {
            *x = (rng.random::<f32>() - 0.5) * 2e-4;
        }
        HashGrid { levels, table }
    }
}

impl Corners {
    pub const EMPTY: Corners =
        Corners { entry: [[0; LANES]; 4], weight: [Lanes::ZERO; 4], along_x: Lanes::ZERO };

    /// Finds the corners of the cells that hold `position`. Positions are clamped
    /// to the cube (NaN to 0), so every entry and its successor lie in `level`.
    // Unlike `clamp`, `max` then `min` turns NaN into a number, as the casts need.
    #[allow(clippy::manual_clamp)]
    #[inline(always)]
    pub fn find(&mut self, level: &Level, position: &[Lanes; 3]) {
        let cells = level.cells as f32;
        let last = level.cells - 1;
        let vertices = level.cells + 1;
        for i in 0..LANES {
            let [x, y, z] =
                [position[0].0[i], position[1].0[i], position[2].0[i]].map(|p| p.max(0.0).min(1.0) * cells);
            // SAFETY: each number is finite, at least 0 and at most `cells`.
            let [xi, yi, zi] = [x, y, z].map(|p| unsafe { p.to_int_unchecked::<i32>() as u32 }.min(last));
            let (fx, fy, fz) = (x - xi as i32 as f32, y - yi as i32 as f32, z - zi as i32 as f32);
            self.along_x.0[i] = fx;
            let high = fy * fz;
            self.weight[0].0[i] = (1.0 - fy) - (fz - high);
            self.weight[1].0[i] = fy - high;
            self.weight[2].0[i] = fz - high;
            self.weight[3].0[i] = high;
            let base = level.first_entry + xi;
            let Some(mask) = level.mask else {
                let row = base + (zi * vertices + yi) * vertices;
                self.entry[0][i] = row;
                self.entry[1][i] = row + vertices;
                self.entry[2][i] = row + vertices * vertices;
                self.entry[3][i] = row + vertices * vertices + vertices;
                continue;
            };
            let (y0, z0) = (yi.wrapping_mul(PRIMES[0]), zi.wrapping_mul(PRIMES[1]));
            let (y1, z1) = (y0.wrapping_add(PRIMES[0]), z0.wrapping_add(PRIMES[1]));
            self.entry[0][i] = base + ((y0 ^ z0) & mask);
            self.entry[1][i] = base + ((y1 ^ z0) & mask);
            self.entry[2][i] = base + ((y0 ^ z1) & mask);
            self.entry[3][i] = base + ((y1 ^ z1) & mask);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::SeedableRng;

    #[test]
    fn every_corner_of_the_cube_and_worse_positions_stay_inside_their_level() {
        for table_bits in [10, 13, 15] {
            stay_inside(table_bits);
        }
    }

    fn stay_inside(table_bits: u32) {
        let grid = HashGrid::new(table_bits, &mut ChaCha8Rng::seed_from_u64(1));
        let mut position = [Lanes::ZERO; 3];
        let odd = [0.0, 1.0, 1.0 - f32::EPSILON / 2.0, -3.0, 7.0, f32::NAN, f32::INFINITY, 0.5];
        for i in 0..LANES {
            position[0].0[i] = odd[i % 8];
            position[1].0[i] = odd[i / 8];
            position[2].0[i] = odd[(i / 2) % 8];
        }
        let mut corners = Corners::EMPTY;
        for (l, level) in grid.levels.iter().enumerate() {
            let end = match grid.levels.get(l + 1) {
                Some(next) => next.first_entry as usize,
                None => grid.table.len() * LINE / ENTRY,
            };
            corners.find(level, &position);
            for i in 0..LANES {
                let mut weights = 0.0;
                for pair in 0..4 {
                    let entry = corners.entry[pair][i];
                    assert!(entry >= level.first_entry && (entry as usize) + 1 < end);
                    weights += corners.weight[pair].0[i];
                }
                assert!((weights - 1.0).abs() < 1e-5);
                assert!((0.0..=1.0).contains(&corners.along_x.0[i]));
            }
        }
    }
}

//! How far each cell is from the nearest occupied one.

/// Cells along an edge of the cube.
pub(super) const CELLS: usize = 64;
/// Distances beyond this are cut to it.
const FARTHEST: u8 = 16;

/// For each cell the Chebyshev distance in cells to the nearest occupied one,
/// x fastest; 0 in an occupied cell.
#[derive(Clone, Debug)]
pub(super) struct DistanceMap {
    distance: Box<[u8; CELLS * CELLS * CELLS]>,
}

impl DistanceMap {
    /// Width of a cell in units of the cube's edge.
    pub const CELL: f32 = 1.0 / CELLS as f32;

    /// `occupied` has one flag a cell, x fastest.
    pub fn new(occupied: &[bool]) -> DistanceMap {
        // One bit a cell: growing the set by a cell is three passes over 4,096 words.
        let mut rows: Vec<u64> = occupied
            .chunks_exact(CELLS)
            .map(|row| row.iter().rev().fold(0, |bits, &o| bits << 1 | u64::from(o)))
            .collect();
        let mut distance = Box::new([FARTHEST; CELLS * CELLS * CELLS]);
        let mut seen = vec![0u64; rows.len()];
        for d in 0..FARTHEST {
            let mut changed = false;
            for ((row, seen), cells) in rows.iter().zip(&mut seen).zip(distance.chunks_exact_mut(CELLS)) {
                let mut fresh = row & !*seen;
                *seen = *row;
                changed |= fresh != 0;
                while fresh != 0 {
                    cells[fresh.trailing_zeros() as usize] = d;
                    fresh &= fresh - 1;
                }
            }
            if !changed {
                break;
            }
            rows = grow(&rows);
        }
        DistanceMap { distance }
    }

    /// Distances of all cells, x fastest.
    #[inline(always)]
    pub fn cells(&self) -> &[u8; CELLS * CELLS * CELLS] {
        &self.distance
    }

    /// Distance of the cell that holds `position`; positions outside the cube count as on its rim.
    #[cfg(test)]
    pub fn cells_to_occupied(&self, position: [f32; 3]) -> u8 {
        // The cast saturates: negative and NaN to 0.
        let [x, y, z] = position.map(|p| ((p * CELLS as f32) as usize).min(CELLS - 1));
        self.distance[(z * CELLS + y) * CELLS + x]
    }
}

/// Sets every cell that touches a set one, corners included.
fn grow(rows: &[u64]) -> Vec<u64> {
    let along_x: Vec<u64> = rows.iter().map(|r| r | r << 1 | r >> 1).collect();
    let mut along_y = along_x.clone();
    for (grown, plane) in along_y.chunks_exact_mut(CELLS).zip(along_x.chunks_exact(CELLS)) {
        for y in 0..CELLS {
            grown[y] |= plane[y.saturating_sub(1)] | plane[(y + 1).min(CELLS - 1)];
        }
    }
    let mut along_z = along_y.clone();
    for z in 0..CELLS {
        let (below, above) = (z.saturating_sub(1) * CELLS, (z + 1).min(CELLS - 1) * CELLS);
        for y in 0..CELLS {
            along_z[z * CELLS + y] |= along_y[below + y] | along_y[above + y];
        }
    }
    along_z
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances_are_chebyshev_and_cut() {
        let mut occupied = vec![false; CELLS * CELLS * CELLS];
        let at = |x: usize, y: usize, z: usize| (z * CELLS + y) * CELLS + x;
        occupied[at(5, 20, 63)] = true;
        occupied[at(40, 20, 30)] = true;
        let map = DistanceMap::new(&occupied);
        for [x, y, z] in [[5usize, 20, 63], [0; 3], [63; 3], [38, 27, 29], [20, 20, 50], [5, 30, 60]] {
            let to = |a: usize, b: usize, c: usize| x.abs_diff(a).max(y.abs_diff(b)).max(z.abs_diff(c));
            let expected = to(5, 20, 63).min(to(40, 20, 30)).min(usize::from(FARTHEST));
            let centre = [x, y, z].map(|c| (c as f32 + 0.5) * DistanceMap::CELL);
            assert_eq!(usize::from(map.cells_to_occupied(centre)), expected, "at {x} {y} {z}");
        }
    }

    #[test]
    fn positions_outside_the_cube_do_no_harm() {
        let map = DistanceMap::new(&vec![true; CELLS * CELLS * CELLS]);
        for p in [f32::NAN, f32::INFINITY, -1.0, 2.0] {
            assert_eq!(map.cells_to_occupied([p; 3]), 0);
        }
    }
}

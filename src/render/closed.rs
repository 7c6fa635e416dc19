//! Which triangles bound a solid, so that those facing away are hidden by others.

use std::collections::HashMap;

/// The side of a triangle that can be seen from outside a solid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Visible {
    /// Both: the surface has an end somewhere, or its corners do not all run the same way round.
    Both,
    /// The side from which the corners run anticlockwise.
    Front,
    /// The other one: the solid's corners run the wrong way round.
    Back,
}

/// For each triangle the side that can be seen from outside.
///
/// A connected part of the surface bounds a solid if every edge belongs to two triangles that run
/// along it in opposite directions. Corners at one place are one: seams of a texture do not open a
/// solid. `solid` says whether a triangle may be relied on to hide what is behind it.
pub(super) fn visible_sides(
    positions: &[[f32; 3]],
    triangles: &[[u32; 3]],
    solid: impl Fn(usize) -> bool,
) -> Vec<Visible> {
    let places = places(positions);
    let place = |i: u32| places.get(i as usize).copied().unwrap_or(u32::MAX);
    let welded: Vec<[u32; 3]> = triangles.iter().map(|t| t.map(place)).collect();
    // How often an edge is run along, forwards counted up and backwards down, and how often at all.
    let mut edges: HashMap<(u32, u32), (i32, u32)> = HashMap::with_capacity(2 * welded.len());
    let mut parts = Parts::new(positions.len());
    for corners in &welded {
        for (from, to) in sides(corners) {
            let (balance, count) = edges.entry((from.min(to), from.max(to))).or_default();
            *balance += if from < to { 1 } else { -1 };
            *count += 1;
            parts.join(from, to);
        }
    }
    let mut open = vec![false; positions.len()];
    let mut six_volumes = vec![0.0f64; positions.len()];
    for (index, corners) in welded.iter().enumerate() {
        let Some(part) = parts.of(corners[0]) else { continue };
        let closed = sides(corners).all(|(a, b)| edges.get(&(a.min(b), a.max(b))) == Some(&(0, 2)));
        open[part] |= !closed || !solid(index);
        six_volumes[part] += six_volume(positions, corners);
    }
    let side = |corners: &[u32; 3]| match parts.of(corners[0]) {
        Some(part) if open[part] => Visible::Both,
        Some(part) if six_volumes[part] > 0.0 => Visible::Front,
        Some(part) if six_volumes[part] < 0.0 => Visible::Back,
        _ => Visible::Both,
    };
    welded.iter().map(side).collect()
}

fn sides(corners: &[u32; 3]) -> impl Iterator<Item = (u32, u32)> {
    let [a, b, c] = *corners;
    [(a, b), (b, c), (c, a)].into_iter()
}

/// For each position the first index with the same one.
fn places(positions: &[[f32; 3]]) -> Vec<u32> {
    let mut first: HashMap<[u32; 3], u32> = HashMap::with_capacity(positions.len());
    // Adding 0 makes -0 and 0 the same bits.
    let bits = |p: &[f32; 3]| p.map(|v| (v + 0.0).to_bits());
    positions.iter().zip(0..).map(|(p, i)| *first.entry(bits(p)).or_insert(i)).collect()
}

/// Six times the volume under a triangle as seen from the first position.
fn six_volume(positions: &[[f32; 3]], corners: &[u32; 3]) -> f64 {
    let at = |i: u32| positions.get(i as usize).map_or([0.0; 3], |p| p.map(f64::from));
    let origin = at(0);
    let [a, b, c] = corners.map(|i| {
        let p = at(i);
        [p[0] - origin[0], p[1] - origin[1], p[2] - origin[2]]
    });
    a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
        + a[2] * (b[0] * c[1] - b[1] * c[0])
}

/// Connected corners (a forest of disjoint sets).
struct Parts(Vec<u32>);

impl Parts {
    fn new(corners: usize) -> Self {
        Self((0..corners as u32).collect())
    }

    fn root(&mut self, mut at: u32) -> Option<u32> {
        loop {
            let parent = *self.0.get(at as usize)?;
            let grandparent = *self.0.get(parent as usize)?;
            if parent == at {
                return Some(at);
            }
            self.0[at as usize] = grandparent;
            at = grandparent;
        }
    }

    fn join(&mut self, a: u32, b: u32) {
        if let (Some(a), Some(b)) = (self.root(a), self.root(b)) {
            self.0[a.max(b) as usize] = a.min(b);
        }
    }

    /// The part of a corner, an index below the number of corners.
    fn of(&self, corner: u32) -> Option<usize> {
        let mut at = *self.0.get(corner as usize)?;
        while self.0[at as usize] != at {
            at = self.0[at as usize];
        }
        Some(at as usize)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TETRAHEDRON: [[f32; 3]; 4] = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    const OUTWARD: [[u32; 3]; 4] = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];

    #[test]
    fn a_solid_shows_the_side_that_is_outside() {
        assert_eq!(visible_sides(&TETRAHEDRON, &OUTWARD, |_| true), [Visible::Front; 4]);
        let inward = OUTWARD.map(|[a, b, c]| [a, c, b]);
        assert_eq!(visible_sides(&TETRAHEDRON, &inward, |_| true), [Visible::Back; 4]);
    }

    #[test]
    fn a_surface_with_an_end_a_hole_or_a_turned_triangle_shows_both_sides() {
        assert_eq!(visible_sides(&TETRAHEDRON, &OUTWARD[..3], |_| true), [Visible::Both; 3]);
        assert_eq!(visible_sides(&TETRAHEDRON, &OUTWARD, |i| i != 2), [Visible::Both; 4]);
        let mut turned = OUTWARD;
        turned[3] = [1, 3, 2];
        assert_eq!(visible_sides(&TETRAHEDRON, &turned, |_| true), [Visible::Both; 4]);
    }

    #[test]
    fn corners_at_one_place_are_one_and_parts_are_judged_by_themselves() {
        let mut positions: Vec<[f32; 3]> = Vec::new();
        let mut triangles: Vec<[u32; 3]> = Vec::new();
        for triangle in OUTWARD {
            let first = positions.len() as u32;
            positions.extend(triangle.map(|i| TETRAHEDRON[i as usize]));
            triangles.push([first, first + 1, first + 2]);
        }
        let first = positions.len() as u32;
        positions.extend([[5.0, 0.0, 0.0], [6.0, 0.0, 0.0], [5.0, 1.0, 0.0]]);
        triangles.push([first, first + 1, first + 2]);
        let sides = visible_sides(&positions, &triangles, |_| true);
        assert_eq!(sides[..4], [Visible::Front; 4]);
        assert_eq!(sides[4], Visible::Both);
    }
}

//! The surface where a field is zero, by marching tetrahedra: always a closed surface without branches.

use std::collections::HashMap;

use crate::objects::frame::{V, v};

/// Triangles, corners anticlockwise as seen from where the field is positive.
pub(super) struct Surface {
    pub(super) points: Vec<V>,
    pub(super) triangles: Vec<[u32; 3]>,
}

/// Six tetrahedra of a cube, all about the diagonal from corner 0 to corner 7 (bits are x, y, z).
const TETRAHEDRA: [[usize; 4]; 6] =
    [[0, 1, 3, 7], [0, 3, 2, 7], [0, 2, 6, 7], [0, 6, 4, 7], [0, 4, 5, 7], [0, 5, 1, 7]];

/// The zero surface of `field` (negative inside) in a box, which must lie wholly outside at its faces; cells of
/// size `cell`.
pub(super) fn march(low: V, high: V, cell: f64, field: impl Fn(V) -> f64) -> Surface {
    let count = (high - low).map(|s| ((s / cell).floor() as usize + 2).min(160));
    let (nx, ny, nz) = (count.x + 1, count.y + 1, count.z + 1);
    let at = |x: usize, y: usize, z: usize| low + v(x as f64, y as f64, z as f64) * cell;
    let index = |x: usize, y: usize, z: usize| (z * ny + y) * nx + x;
    let mut values = Vec::with_capacity(nx * ny * nz);
    for z in 0..nz {
        for y in 0..ny {
            for x in 0..nx {
                values.push(field(at(x, y, z)));
            }
        }
    }
    let (mut points, mut triangles) = (Vec::new(), Vec::new());
    // Looked up only, never walked: its order cannot show.
    let mut on_edge: HashMap<(usize, usize), u32> = HashMap::new();
    for z in 0..count.z {
        for y in 0..count.y {
            for x in 0..count.x {
                let corner = |k: usize| (x + (k & 1), y + (k >> 1 & 1), z + (k >> 2));
                let ids: [usize; 8] = std::array::from_fn(|k| {
                    let (x, y, z) = corner(k);
                    index(x, y, z)
                });
                let inside = ids.iter().filter(|i| values[**i] < 0.0).count();
                if inside == 0 || inside == 8 {
                    continue;
                }
                for tetrahedron in TETRAHEDRA {
                    let mut crossing = |a: usize, b: usize| {
                        let (a, b) = if ids[a] < ids[b] { (a, b) } else { (b, a) };
                        *on_edge.entry((ids[a], ids[b])).or_insert_with(|| {
                            let (p, q) = (values[ids[a]], values[ids[b]]);
                            // Away from the corners, or neighbouring points could become one.
                            let t = (p / (p - q)).clamp(0.04, 0.96);
                            let ((x, y, z), (i, j, k)) = (corner(a), corner(b));
                            points.push(at(x, y, z) * (1.0 - t) + at(i, j, k) * t);
                            points.len() as u32 - 1
                        })
                    };
                    let negative = tetrahedron.map(|k| values[ids[k]] < 0.0);
                    cut(tetrahedron, negative, &mut crossing, &mut triangles);
                }
            }
        }
    }
    largest_part(Surface { points, triangles })
}

/// Leaves out what hangs in the air beside the part with the most triangles.
fn largest_part(mut surface: Surface) -> Surface {
    // Each point's root: the least index of its part, in the end.
    let mut roots: Vec<u32> = (0..surface.points.len() as u32).collect();
    let root = |roots: &mut Vec<u32>, mut i: u32| {
        while roots[i as usize] != i {
            roots[i as usize] = roots[roots[i as usize] as usize];
            i = roots[i as usize];
        }
        i
    };
    for [a, b, c] in &surface.triangles {
        for (a, b) in [(*a, *b), (*b, *c)] {
            let (a, b) = (root(&mut roots, a), root(&mut roots, b));
            roots[a.max(b) as usize] = a.min(b);
        }
    }
    let mut sizes = vec![0u32; roots.len()];
    for [a, ..] in &surface.triangles {
        sizes[root(&mut roots, *a) as usize] += 1;
    }
    let Some(most) = sizes.iter().max().filter(|most| **most > 0) else { return surface };
    let kept = sizes.iter().position(|size| size == most).unwrap_or(0) as u32;
    surface.triangles.retain(|[a, ..]| root(&mut roots, *a) == kept);
    surface
}

/// The triangles of one tetrahedron.
fn cut(
    [a, b, c, d]: [usize; 4],
    negative: [bool; 4],
    crossing: &mut impl FnMut(usize, usize) -> u32,
    triangles: &mut Vec<[u32; 3]>,
) {
    // An even permutation keeps a tetrahedron's handedness; the first corners become the negative ones.
    let [a, b, c, d] = match negative {
        [true, false, false, false] | [true, true, false, false] | [true, true, true, false] => [a, b, c, d],
        [false, true, false, false] | [false, true, true, false] => [b, c, a, d],
        [false, false, true, false] => [c, a, b, d],
        [false, false, false, true] => [d, c, b, a],
        [true, false, true, false] => [c, a, b, d],
        [true, false, false, true] => [a, d, b, c],
        [false, true, false, true] => [d, b, a, c],
        [false, false, true, true] => [c, d, a, b],
        [true, true, false, true] => [b, a, d, c],
        [true, false, true, true] => [a, c, d, b],
        [false, true, true, true] => [d, c, b, a],
        _ => return,
    };
    match negative.iter().filter(|n| **n).count() {
        1 => triangles.push([crossing(a, b), crossing(a, c), crossing(a, d)]),
        2 => {
            let [p, q, r, s] = [crossing(a, c), crossing(a, d), crossing(b, d), crossing(b, c)];
            triangles.push([p, q, r]);
            triangles.push([p, r, s]);
        }
        _ => triangles.push([crossing(d, a), crossing(d, b), crossing(d, c)]),
    }
}

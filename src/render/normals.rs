//! Vertex normals for meshes that have none.

use std::collections::HashMap;

use nalgebra::Vector3;

use super::Mesh;

/// Faces that meet at less than this angle are shaded as one smooth surface.
const CREASE_COSINE: f32 = 0.766; // 40 degrees

/// Gives every vertex a unit normal: those the mesh has are normalised; if some used vertex
/// has none, all are made from the faces, smooth below the crease angle (which splits vertices).
pub(super) fn complete(mesh: &mut Mesh) {
    mesh.normals.resize(mesh.positions.len(), [0.0; 3]);
    for n in &mut mesh.normals {
        *n = Vector3::from(*n)
            .try_normalize(1e-12)
            .filter(|n| n.iter().all(|v| v.is_finite()))
            .unwrap_or_default()
            .into();
    }
    let missing = |i: &u32| mesh.normals.get(*i as usize).is_none_or(|n| *n == [0.0; 3]);
    let lacking: Vec<usize> = (0..mesh.triangles.len())
        .filter(|t| mesh.triangles.get(*t).is_some_and(|t| t.iter().any(missing)))
        .collect();
    if !lacking.is_empty() {
        make(mesh, &lacking);
    }
}

/// Normal of each triangle times twice its area; zero for a degenerate one.
fn face_normals(mesh: &Mesh) -> Vec<Vector3<f32>> {
    let corner = |i: u32| Vector3::from(mesh.positions.get(i as usize).copied().unwrap_or_default());
    mesh.triangles
        .iter()
        .map(|[a, b, c]| {
            let a = corner(*a);
            (corner(*b) - a).cross(&(corner(*c) - a))
        })
        .collect()
}

fn make(mesh: &mut Mesh, lacking: &[usize]) {
    let faces = face_normals(mesh);
    let key = |mesh: &Mesh, i: u32| mesh.positions.get(i as usize).map(|p| p.map(|v| (v + 0.0).to_bits()));
    let mut around: HashMap<Option<[u32; 3]>, Vec<usize>> = HashMap::new();
    for (t, corners) in mesh.triangles.iter().enumerate() {
        for i in corners {
            around.entry(key(mesh, *i)).or_default().push(t);
        }
    }
    let unit = |v: &Vector3<f32>| v.try_normalize(0.0).unwrap_or_default();
    // A vertex may serve corners on both sides of a crease: one copy for each normal.
    let mut copies: HashMap<(u32, [u32; 3]), u32> = HashMap::new();
    for t in lacking {
        let Some(own) = faces.get(*t).map(unit) else { continue };
        for k in 0..3 {
            let Some(i) = mesh.triangles.get(*t).and_then(|c| c.get(k)).copied() else { continue };
            let neighbours = around.get(&key(mesh, i)).map_or(&[][..], Vec::as_slice);
            let sum: Vector3<f32> = neighbours
                .iter()
                .filter_map(|n| faces.get(*n))
                .filter(|n| unit(n).dot(&own) > CREASE_COSINE)
                .sum();
            let normal: [f32; 3] = sum.try_normalize(0.0).unwrap_or(own).into();
            let at = *copies.entry((i, normal.map(f32::to_bits))).or_insert_with(|| {
                if mesh.normals.get(i as usize).is_some_and(|n| *n == [0.0; 3]) && normal != [0.0; 3] {
                    mesh.normals[i as usize] = normal;
                    return i;
                }
                mesh.positions.push(mesh.positions.get(i as usize).copied().unwrap_or_default());
                mesh.normals.push(normal);
                if let Some(uv) = mesh.uvs.get(i as usize).copied() {
                    mesh.uvs.push(uv);
                }
                mesh.positions.len() as u32 - 1
            });
            if let Some(corner) = mesh.triangles.get_mut(*t).and_then(|c| c.get_mut(k)) {
                *corner = at;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ridge_stays_sharp_and_a_gentle_bend_becomes_smooth() {
        for (height, smooth) in [(1.0, false), (0.1, true)] {
            let mut mesh = Mesh {
                positions: vec![[0.0, 0.0, height], [0.0, 1.0, height], [-1.0, 0.0, 0.0], [1.0, 0.0, 0.0]],
                triangles: vec![[0, 1, 2], [1, 0, 3]],
                ..Mesh::default()
            };
            mesh.repair();
            let at = |t: usize, k: usize| mesh.normals[mesh.triangles[t][k] as usize];
            assert_eq!(at(0, 0) == at(1, 1), smooth);
            assert_eq!(mesh.positions.len(), mesh.normals.len());
        }
    }
}

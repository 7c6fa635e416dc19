//! Texture coordinates from three sides, for surfaces that have none of their own.

use crate::objects::frame::V;
use crate::render::Mesh;

/// Coordinates of a point on a texture laid along the axis `side`, in tiles of `tile` metres; upright on sides.
pub(super) fn box_uv(p: V, side: usize, tile: f64) -> [f64; 2] {
    let [u, v] = match side {
        0 => [p.y, -p.z],
        1 => [p.x, -p.z],
        _ => [p.x, -p.y],
    };
    [u / tile, v / tile]
}

/// Lays textures from three sides over the triangles that `chosen` names by index, one copy of a vertex a side.
pub(in crate::objects) fn box_project(mesh: &mut Mesh, tile: f64, chosen: impl Fn(usize) -> bool) {
    mesh.uvs.resize(mesh.positions.len(), [0.0; 2]);
    let mut copies: Vec<[Option<u32>; 3]> = vec![[None; 3]; mesh.positions.len()];
    for index in 0..mesh.triangles.len() {
        if !chosen(index) {
            continue;
        }
        let triangle = mesh.triangles[index];
        let point = |i: u32| V::from(mesh.positions[i as usize].map(f64::from));
        let [a, b, c] = triangle.map(point);
        let side = (b - a).cross(&(c - a)).abs().imax();
        let places = [a, b, c];
        for k in 0..3 {
            let i = triangle[k] as usize;
            let id = match copies[i][side] {
                Some(id) => id,
                None => {
                    mesh.positions.push(mesh.positions[i]);
                    mesh.normals.push(mesh.normals.get(i).copied().unwrap_or_default());
                    mesh.uvs.push(box_uv(places[k], side, tile).map(|c| c as f32));
                    let id = mesh.positions.len() as u32 - 1;
                    copies[i][side] = Some(id);
                    id
                }
            };
            mesh.triangles[index][k] = id;
        }
    }
}

//! A tight bounding sphere.

use nalgebra::Vector3;

use super::Mesh;
use crate::geometry::Point;

/// A sphere about all corners of a mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoundingSphere {
    /// Centre, in the mesh's frame.
    pub center: Point,
    /// Radius, in the mesh's unit.
    pub radius: f64,
}

/// The smallest sphere about the corners of `mesh`'s triangles, to about a thousandth of
/// its radius; never smaller than needed. Radius 0 for a mesh without triangles.
///
/// The farthest corner is added to a small set until the set's sphere holds all corners;
/// the set's sphere is found by stepping towards its farthest point (Bădoiu and Clarkson,
/// "Smaller core-sets for balls", 2003).
pub fn bounding_sphere(mesh: &Mesh) -> BoundingSphere {
    let mut used = vec![false; mesh.positions.len()];
    for i in mesh.triangles.iter().flatten() {
        if let Some(flag) = used.get_mut(*i as usize) {
            *flag = true;
        }
    }
    let points: Vec<Point> = mesh
        .positions
        .iter()
        .zip(&used)
        .filter(|(_, used)| **used)
        .map(|(p, _)| Point::from(p.map(f64::from)))
        .collect();
    let Some(first) = points.first() else {
        return BoundingSphere { center: Point::origin(), radius: 0.0 };
    };
    let mut core = vec![*first];
    let mut sphere = BoundingSphere { center: *first, radius: 0.0 };
    for _ in 0..64 {
        let (far, distance) = farthest(&points, sphere.center);
        if distance <= sphere.radius * (1.0 + 1e-4) {
            break;
        }
        core.push(far);
        sphere = of_few(&core);
    }
    BoundingSphere { center: sphere.center, radius: farthest(&points, sphere.center).1 }
}

fn farthest(points: &[Point], from: Point) -> (Point, f64) {
    let mut best = (from, 0.0);
    for p in points {
        let d = (p - from).norm_squared();
        if d > best.1 {
            best = (*p, d);
        }
    }
    (best.0, best.1.sqrt())
}

fn of_few(points: &[Point]) -> BoundingSphere {
    let sum = points.iter().fold(Vector3::zeros(), |s, p| s + p.coords);
    let mut center = Point::from(sum / points.len() as f64);
    for i in 0..2000 {
        let (far, _) = farthest(points, center);
        center += (far - center) / f64::from(i + 2);
    }
    BoundingSphere { center, radius: farthest(points, center).1 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_box_gets_half_its_diagonal() {
        let positions =
            (0..8).map(|i| [(i & 1) as f32, (i >> 1 & 1) as f32 * 2.0, (i >> 2) as f32 * 3.0]).collect();
        let triangles = vec![[0, 1, 2], [3, 4, 5], [6, 7, 0]];
        let sphere = bounding_sphere(&Mesh { positions, triangles, ..Mesh::default() });
        assert!((sphere.radius - 14f64.sqrt() / 2.0).abs() < 2e-3 * sphere.radius, "{sphere:?}");
        assert!((sphere.center - Point::new(0.5, 1.0, 1.5)).norm() < 0.05);
    }

    #[test]
    fn vertices_that_no_triangle_uses_do_not_count() {
        let positions = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [99.0; 3]];
        let sphere = bounding_sphere(&Mesh { positions, triangles: vec![[0, 1, 2]], ..Mesh::default() });
        assert!(sphere.radius < 0.72);
        assert_eq!(bounding_sphere(&Mesh::default()).radius, 0.0);
    }
}

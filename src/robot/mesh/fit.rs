//! One convex shape that holds all points: the smallest of a few.

use nalgebra::{Matrix3, Rotation3, SymmetricEigen, Translation3, UnitQuaternion};

use crate::geometry::{Point, Pose, Vector};
use crate::robot::LinkShape;

/// Least half edge and radius, metres: flat meshes still are bodies.
const THINNEST_M: f64 = 5e-4;

/// The box or capsule of least volume among four candidates: a box along the mesh's
/// axes, one along its principal axes, a capsule along each of the two sets' longest axis.
/// It holds every point. `None` without points.
pub fn fit(points: &[Point]) -> Option<LinkShape> {
    let centre = points.iter().fold(Vector::zeros(), |sum, p| sum + p.coords) / points.len().max(1) as f64;
    let spread = points.iter().fold(Matrix3::zeros(), |sum, p| {
        let v = p.coords - centre;
        sum + v * v.transpose()
    });
    let principal = principal_axes(&spread);
    let frames = [UnitQuaternion::identity(), principal];
    let candidates = frames.iter().flat_map(|axes| candidates(points, axes));
    candidates.min_by(|a, b| volume(a).total_cmp(&volume(b)))
}

fn principal_axes(spread: &Matrix3<f64>) -> UnitQuaternion<f64> {
    // Bounded, since spread of finite points can be infinite.
    let Some(eigen) = SymmetricEigen::try_new(*spread, f64::EPSILON, 100) else {
        return UnitQuaternion::identity();
    };
    let mut axes = eigen.eigenvectors;
    if axes.determinant() < 0.0 {
        axes.column_mut(0).neg_mut();
    }
    UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(axes))
}

/// The box along `axes` and the capsule along the box's longest edge.
fn candidates(points: &[Point], axes: &UnitQuaternion<f64>) -> Vec<LinkShape> {
    let local: Vec<Vector> = points.iter().map(|p| axes.inverse() * p.coords).collect();
    let Some(first) = local.first().copied() else { return Vec::new() };
    let (least, most) = local.iter().fold((first, first), |(a, b), p| (a.inf(p), b.sup(p)));
    let centre = 0.5 * (least + most);
    let half = 0.5 * (most - least);
    let cuboid = LinkShape::Cuboid {
        link_from_box: Pose::from_parts(Translation3::from(axes * centre), *axes),
        half_extents_m: half.map(|h| h.max(THINNEST_M)),
    };
    let long = half.imax();
    // The radius that holds all points beside the axis; then the ends as near as they hold the rest.
    let beside = |p: &Vector| {
        let mut away = p - centre;
        away[long] = 0.0;
        away.norm()
    };
    let radius_m = local.iter().map(beside).fold(THINNEST_M, f64::max);
    let (mut low, mut high) = (0.0f64, 0.0f64);
    for p in &local {
        let cap = (radius_m * radius_m - beside(p).powi(2)).max(0.0).sqrt();
        let along = p[long] - centre[long];
        (low, high) = (low.min(along + cap), high.max(along - cap));
    }
    let end = |along: f64| {
        let mut at = centre;
        at[long] += along;
        Point::from(axes * at)
    };
    vec![cuboid, LinkShape::Capsule { from_in_link: end(low), to_in_link: end(high), radius_m }]
}

fn volume(shape: &LinkShape) -> f64 {
    use std::f64::consts::PI;
    match shape {
        LinkShape::Capsule { from_in_link, to_in_link, radius_m: r } => {
            PI * r * r * ((to_in_link - from_in_link).norm() + 4.0 / 3.0 * r)
        }
        LinkShape::Cuboid { half_extents_m, .. } => 8.0 * half_extents_m.product(),
        LinkShape::Cylinder { half_length_m, radius_m, .. } => 2.0 * PI * radius_m * radius_m * half_length_m,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn holds(shape: &LinkShape, point: &Point) -> bool {
        match shape {
            LinkShape::Capsule { from_in_link, to_in_link, radius_m } => {
                let along = to_in_link - from_in_link;
                let share = (point - from_in_link).dot(&along) / along.norm_squared().max(1e-300);
                let nearest = from_in_link + along * share.clamp(0.0, 1.0);
                (point - nearest).norm() <= radius_m + 1e-9
            }
            LinkShape::Cuboid { link_from_box, half_extents_m } => {
                let local = link_from_box.inverse() * point;
                local.coords.abs().iter().zip(half_extents_m.iter()).all(|(x, h)| *x <= h + 1e-9)
            }
            LinkShape::Cylinder { .. } => false,
        }
    }

    proptest! {
        #[test]
        fn every_point_is_inside(points in proptest::collection::vec(proptest::array::uniform3(-1.0..1.0f64), 1..60), stretch in 0.0..3.0f64) {
            let points: Vec<Point> = points.into_iter().map(|[x, y, z]| Point::new(x + y, y, z * stretch)).collect();
            let shape = fit(&points).unwrap();
            prop_assert!(points.iter().all(|p| holds(&shape, p)), "{shape:?}");
        }
    }

    #[test]
    fn a_slanted_rod_is_a_thin_shape() {
        let turn = UnitQuaternion::from_euler_angles(0.3, 0.8, -0.4);
        let ring = |i: i32| {
            let (sin, cos) = (f64::from(i) * 0.3).sin_cos();
            Point::from(turn * Vector::new(0.03 * cos, 0.03 * sin, 0.01 * f64::from(i)))
        };
        let points: Vec<Point> = (0..60).map(ring).collect();
        let exact = std::f64::consts::PI * 0.03 * 0.03 * 0.6;
        assert!(volume(&fit(&points).unwrap()) < 1.5 * exact);
    }

    #[test]
    fn no_points_have_no_shape() {
        assert_eq!(fit(&[]), None);
    }
}

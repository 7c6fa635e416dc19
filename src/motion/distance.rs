//! Signed distances between shapes, a sphere and a half-space.
//!
//! The planner asks for them a million times a plan: capsules against capsules,
//! spheres and planes are closed formulas, capsules against boxes and cylinders
//! a search along their segment; two shapes without a capsule go to parry.

use parry3d_f64::math::{Pose3, Rot3, Vec3};
use parry3d_f64::query;
use parry3d_f64::shape::{Cuboid, Cylinder, Segment, Shape};

use crate::geometry::{Point, Pose, Vector};
use crate::robot::LinkShape;

/// Squared length below which a segment counts as a point.
const POINT: f64 = 1e-18;

/// Distance between the segments `a0 a1` and `b0 b1`, metres.
///
/// Closest points of two lines, clamped to the segments one after the other.
pub(crate) fn segment_segment(a0: &Point, a1: &Point, b0: &Point, b1: &Point) -> f64 {
    let (u, v, w) = (a1 - a0, b1 - b0, a0 - b0);
    let (uu, vv, uv) = (u.norm_squared(), v.norm_squared(), u.dot(&v));
    let (uw, vw) = (u.dot(&w), v.dot(&w));
    if uu <= POINT {
        return segment_point(b0, b1, a0);
    }
    if vv <= POINT {
        return segment_point(a0, a1, b0);
    }
    let denominator = uu * vv - uv * uv;
    let parallel = denominator <= 1e-12 * uu * vv;
    let s = if parallel { 0.0 } else { ((uv * vw - vv * uw) / denominator).clamp(0.0, 1.0) };
    let t = (uv * s + vw) / vv;
    let (s, t) = if t < 0.0 {
        ((-uw / uu).clamp(0.0, 1.0), 0.0)
    } else if t > 1.0 {
        (((uv - uw) / uu).clamp(0.0, 1.0), 1.0)
    } else {
        (s, t)
    };
    (w + u * s - v * t).norm()
}

/// Distance between the segment `a0 a1` and the point `p`, metres.
pub(crate) fn segment_point(a0: &Point, a1: &Point, p: &Point) -> f64 {
    let (u, w) = (a1 - a0, p - a0);
    let uu = u.norm_squared();
    let s = if uu > POINT { (u.dot(&w) / uu).clamp(0.0, 1.0) } else { 0.0 };
    (w - u * s).norm()
}

/// Signed distance of `p` (box frame) from the box around the origin, metres.
pub(crate) fn box_point(half_extents: &Vector, p: &Point) -> f64 {
    let outside = p.coords.abs() - half_extents;
    let beyond = outside.map(|v| v.max(0.0)).norm();
    if beyond > 0.0 { beyond } else { outside.max() }
}

/// Signed distance of `p` (cylinder frame) from the cylinder about z, metres.
fn cylinder_point(half_length: f64, radius: f64, p: &Point) -> f64 {
    let (side, end) = ((p.x * p.x + p.y * p.y).sqrt() - radius, p.z.abs() - half_length);
    if side > 0.0 || end > 0.0 {
        let (side, end) = (side.max(0.0), end.max(0.0));
        (side * side + end * end).sqrt()
    } else {
        side.max(end)
    }
}

/// Signed distance of a placed shape from a point, metres.
pub(crate) fn shape_point(frame_from_link: &Pose, shape: &LinkShape, p: &Point) -> f64 {
    match shape {
        LinkShape::Capsule { from_in_link, to_in_link, radius_m } => {
            segment_point(&(frame_from_link * from_in_link), &(frame_from_link * to_in_link), p) - radius_m
        }
        LinkShape::Cuboid { link_from_box, half_extents_m } => {
            box_point(half_extents_m, &(frame_from_link * link_from_box).inverse_transform_point(p))
        }
        LinkShape::Cylinder { link_from_cylinder, half_length_m, radius_m } => {
            let p = (frame_from_link * link_from_cylinder).inverse_transform_point(p);
            cylinder_point(*half_length_m, *radius_m, &p)
        }
    }
}

/// The lowest z of a placed shape, metres.
pub(crate) fn shape_bottom(frame_from_link: &Pose, shape: &LinkShape) -> f64 {
    match shape {
        LinkShape::Capsule { from_in_link, to_in_link, radius_m } => {
            (frame_from_link * from_in_link).z.min((frame_from_link * to_in_link).z) - radius_m
        }
        LinkShape::Cuboid { link_from_box, half_extents_m } => {
            let frame_from_box = frame_from_link * link_from_box;
            let up = frame_from_box.rotation.inverse_transform_vector(&Vector::z());
            frame_from_box.translation.vector.z - up.abs().dot(half_extents_m)
        }
        LinkShape::Cylinder { link_from_cylinder, half_length_m, radius_m } => {
            let frame_from_cylinder = frame_from_link * link_from_cylinder;
            let up = frame_from_cylinder.rotation.inverse_transform_vector(&Vector::z());
            frame_from_cylinder.translation.vector.z
                - up.z.abs() * half_length_m
                - up.x.hypot(up.y) * radius_m
        }
    }
}

/// Signed distance of two placed shapes, metres; negative is the penetration depth.
pub(crate) fn shape_shape(frame_from_a: &Pose, a: &LinkShape, frame_from_b: &Pose, b: &LinkShape) -> f64 {
    shape_shape_up_to(frame_from_a, a, frame_from_b, b, f64::INFINITY)
}

/// [`shape_shape`], or any lower bound of it that is at least `enough_m`.
pub(crate) fn shape_shape_up_to(
    frame_from_a: &Pose,
    a: &LinkShape,
    frame_from_b: &Pose,
    b: &LinkShape,
    enough_m: f64,
) -> f64 {
    if let (
        LinkShape::Capsule { from_in_link: a0, to_in_link: a1, radius_m: ra },
        LinkShape::Capsule { from_in_link: b0, to_in_link: b1, radius_m: rb },
    ) = (a, b)
    {
        let (fa, fb) = (frame_from_a, frame_from_b);
        return segment_segment(&(fa * a0), &(fa * a1), &(fb * b0), &(fb * b1)) - ra - rb;
    }
    match (a, b) {
        (LinkShape::Capsule { from_in_link, to_in_link, radius_m }, solid) => {
            let ends = [frame_from_a * from_in_link, frame_from_a * to_in_link];
            return segment_solid(&ends, frame_from_b, solid, enough_m + radius_m) - radius_m;
        }
        (solid, LinkShape::Capsule { from_in_link, to_in_link, radius_m }) => {
            let ends = [frame_from_b * from_in_link, frame_from_b * to_in_link];
            return segment_solid(&ends, frame_from_a, solid, enough_m + radius_m) - radius_m;
        }
        _ => {}
    }
    let (pose_a, solid_a, round_a) = parry_shape(frame_from_a, a);
    let (pose_b, solid_b, round_b) = parry_shape(frame_from_b, b);
    let (solid_a, solid_b) = (solid_a.as_ref(), solid_b.as_ref());
    let apart = match query::distance(&pose_a, solid_a, &pose_b, solid_b) {
        Ok(found) if found.distance > 0.0 => found.distance,
        _ => query::contact(&pose_a, solid_a, &pose_b, solid_b, 0.0)
            .ok()
            .flatten()
            .map_or(0.0, |contact| contact.dist.min(0.0)),
    };
    apart - round_a - round_b
}

/// Length of the piece of a segment that is left to the search for its nearest point, metres.
const SEARCH_M: f64 = 1e-6;
/// Golden section.
const SECTION: f64 = 0.618_033_988_749_894_9;

/// Signed distance of the nearest (or deepest) point of a segment to a placed solid, metres, short
/// by at most a micrometre.
///
/// The signed distance to a convex solid is a convex function, along a segment too, and changes by
/// no more than the way along it: a golden section search closes in on its least value. It ends
/// early where that is seen to be at least `enough_m`, with a bound that says so.
fn segment_solid(ends: &[Point; 2], frame_from_link: &Pose, solid: &LinkShape, enough_m: f64) -> f64 {
    let [a, b] = ends.map(|end| frame_from_link.inverse_transform_point(&end));
    let identity = Pose::identity();
    let (pose, half_extents, cylinder) = match solid {
        LinkShape::Cuboid { link_from_box, half_extents_m } => (link_from_box, Some(half_extents_m), None),
        LinkShape::Cylinder { link_from_cylinder, half_length_m, radius_m } => {
            (link_from_cylinder, None, Some((*half_length_m, *radius_m)))
        }
        LinkShape::Capsule { .. } => (&identity, None, None),
    };
    let (a, b) = (pose.inverse_transform_point(&a), pose.inverse_transform_point(&b));
    let at = |share: f64| {
        let p = a + (b - a) * share;
        match (half_extents, cylinder) {
            (Some(half_extents), _) => box_point(half_extents, &p),
            (None, Some((half_length, radius))) => cylinder_point(half_length, radius, &p),
            (None, None) => shape_point(&identity, solid, &p),
        }
    };
    let length = (b - a).norm();
    let (mut low, mut high) = (0.0, 1.0);
    let (mut left, mut right) = (1.0 - SECTION, SECTION);
    let (mut at_left, mut at_right) = (at(left), at(right));
    let mut least = at_left.min(at_right);
    while (high - low) * length > SEARCH_M {
        if least - (high - low) * length >= enough_m {
            break;
        }
        if at_left <= at_right {
            (high, right, at_right) = (right, left, at_left);
            left = high - SECTION * (high - low);
            at_left = at(left);
            least = least.min(at_left);
        } else {
            (low, left, at_left) = (left, right, at_right);
            right = low + SECTION * (high - low);
            at_right = at(right);
            least = least.min(at_right);
        }
    }
    least - (high - low) * length
}

/// A shape for parry: its pose, its solid, and the radius still to add around the solid.
fn parry_shape(frame_from_link: &Pose, shape: &LinkShape) -> (Pose3, Box<dyn Shape>, f64) {
    match shape {
        LinkShape::Capsule { from_in_link, to_in_link, radius_m } => {
            let (a, b) = (parry_vector(&from_in_link.coords), parry_vector(&to_in_link.coords));
            // A segment without a direction is a tiny one: GJK needs two points.
            let b = if (b - a).length() < 1e-9 { a + Vec3::new(1e-6, 0.0, 0.0) } else { b };
            (parry_pose(frame_from_link), Box::new(Segment::new(a, b)), *radius_m)
        }
        LinkShape::Cuboid { link_from_box, half_extents_m } => {
            let solid = Cuboid::new(parry_vector(half_extents_m));
            (parry_pose(&(frame_from_link * link_from_box)), Box::new(solid), 0.0)
        }
        LinkShape::Cylinder { link_from_cylinder, half_length_m, radius_m } => {
            // parry's cylinder stands along y.
            let z_from_y = Rot3::from_rotation_x(std::f64::consts::FRAC_PI_2);
            let pose = parry_pose(&(frame_from_link * link_from_cylinder));
            let pose = Pose3::from_parts(pose.translation, pose.rotation * z_from_y);
            (pose, Box::new(Cylinder::new(*half_length_m, *radius_m)), 0.0)
        }
    }
}

fn parry_vector(v: &Vector) -> Vec3 {
    Vec3::new(v.x, v.y, v.z)
}

fn parry_pose(pose: &Pose) -> Pose3 {
    let q = pose.rotation.coords;
    Pose3::from_parts(parry_vector(&pose.translation.vector), Rot3::from_xyzw(q.x, q.y, q.z, q.w))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn point() -> impl Strategy<Value = Point> {
        (-1.0..1.0f64, -1.0..1.0f64, -1.0..1.0f64).prop_map(|(x, y, z)| Point::new(x, y, z))
    }

    fn nearest_sample(a: &Point, b: &Point, distance: impl Fn(&Point) -> f64) -> f64 {
        (0..=400).map(|i| distance(&(a + (b - a) * (f64::from(i) / 400.0)))).fold(f64::INFINITY, f64::min)
    }

    proptest! {
        #[test]
        fn two_segments_are_as_far_apart_as_their_nearest_samples(a in point(), b in point(), c in point(), d in point()) {
            let found = segment_segment(&a, &b, &c, &d);
            let sampled = nearest_sample(&a, &b, |p| segment_point(&c, &d, p));
            prop_assert!(found <= sampled + 1e-12 && found >= sampled - 0.01);
        }

        #[test]
        fn a_capsule_is_as_far_from_a_box_or_cylinder_as_its_nearest_sample(a in point(), b in point(), x in 0.05..0.4f64, y in 0.05..0.4f64, turn in point()) {
            let pose = Pose::new(Vector::new(0.1, 0.0, -0.1), turn.coords * 3.0);
            let capsule = LinkShape::Capsule { from_in_link: a, to_in_link: b, radius_m: 0.02 };
            for solid in [
                LinkShape::Cuboid { link_from_box: pose, half_extents_m: Vector::new(x, y, 0.2) },
                LinkShape::Cylinder { link_from_cylinder: pose, half_length_m: x, radius_m: y },
            ] {
                let found = shape_shape(&Pose::identity(), &capsule, &Pose::identity(), &solid) + 0.02;
                let enough_m = 0.1;
                let at_least = shape_shape_up_to(&Pose::identity(), &capsule, &Pose::identity(), &solid, enough_m) + 0.02;
                prop_assert!(at_least <= found + 1e-5);
                prop_assert!(at_least - 0.02 >= enough_m || (at_least - found).abs() < 1e-12);
                let sampled = nearest_sample(&a, &b, |p| shape_point(&Pose::identity(), &solid, p));
                if sampled > 1e-3 {
                    prop_assert!(found <= sampled + 1e-5 && found >= sampled - 0.01, "{found} {sampled}");
                } else if sampled < -1e-3 {
                    prop_assert!(found < 1e-6, "{found} {sampled}");
                }
            }
        }

        #[test]
        fn the_bottom_of_a_shape_is_where_it_first_meets_a_plane(turn in point(), half in point()) {
            let pose = Pose::new(Vector::new(0.1, 0.2, 0.3), turn.coords * 3.0);
            let half = half.coords.abs();
            let cuboid = LinkShape::Cuboid { link_from_box: pose, half_extents_m: half };
            let corners = (0..8).map(|i| Vector::from_fn(|r, _| if i >> r & 1 == 1 { half[r] } else { -half[r] }));
            let lowest = corners.map(|c| (pose * Point::from(c)).z).fold(f64::INFINITY, f64::min);
            prop_assert!((shape_bottom(&Pose::identity(), &cuboid) - lowest).abs() < 1e-12);
        }
    }

    #[test]
    fn parallel_and_degenerate_segments_have_a_distance() {
        let p = |x: f64, y: f64| Point::new(x, y, 0.0);
        let apart = segment_segment(&p(0.0, 0.0), &p(1.0, 0.0), &p(2.0, 1.0), &p(3.0, 1.0));
        assert!((apart - 2f64.sqrt()).abs() < 1e-12);
        let beside = segment_segment(&p(0.0, 0.0), &p(1.0, 0.0), &p(-1.0, 1.0), &p(3.0, 1.0));
        assert!((beside - 1.0).abs() < 1e-12);
        let from_point = segment_segment(&p(0.5, 2.0), &p(0.5, 2.0), &p(0.0, 0.0), &p(1.0, 0.0));
        assert!((from_point - 2.0).abs() < 1e-12);
    }
}

//! Keep-out regions that are hardly meant.

use super::Warning;
use crate::geometry::Point;
use crate::motion::{CellObject, KeepOut};
use crate::robot::LinkShape;

/// Points a side of the lattice on which two solids are compared.
const SIDE: i32 = 17;
/// Share of the object in a region from which on the region is suspicious.
const SUSPICIOUS: f64 = 0.1;

/// Warns of regions that hold the object.
pub(super) fn check(regions: &[KeepOut], object: &CellObject) -> Vec<Warning> {
    regions.iter().filter_map(|region| holds_object(region, object)).collect()
}

fn holds_object(region: &KeepOut, object: &CellObject) -> Option<Warning> {
    let share = share_within(object, &region.shape_in_base);
    let holds_center = contains(&region.shape_in_base, &object.center_in_base);
    (holds_center || share >= SUSPICIOUS).then(|| {
        let center = if holds_center { ", its centre included" } else { "" };
        Warning::new(
            "object_in_keep_out",
            format!(
                "the keep-out region {} holds {:.0} % of the object{center}: is it where it should be?",
                region.name,
                100.0 * share
            ),
        )
    })
}

/// Share of the object's volume within `region`, from points of a lattice.
fn share_within(object: &CellObject, region: &LinkShape) -> f64 {
    let solid = object.solid_in_base();
    let step_m = 2.0 * object.radius_m / f64::from(SIDE);
    let at = |i: i32| step_m * (f64::from(i) + 0.5) - object.radius_m;
    let (mut of_object, mut of_both) = (0u32, 0u32);
    for (i, j, k) in (0..SIDE).flat_map(|i| (0..SIDE).flat_map(move |j| (0..SIDE).map(move |k| (i, j, k)))) {
        let point = object.center_in_base + crate::geometry::Vector::new(at(i), at(j), at(k));
        if contains(&solid, &point) {
            of_object += 1;
            of_both += u32::from(contains(region, &point));
        }
    }
    // A shape too thin for the lattice is known by its centre alone.
    f64::from(of_both) / f64::from(of_object.max(1))
}

/// Whether `point` is in `shape`, both in one frame.
fn contains(shape: &LinkShape, point: &Point) -> bool {
    match shape {
        LinkShape::Capsule { from_in_link, to_in_link, radius_m } => {
            let along = to_in_link - from_in_link;
            let share = (point - from_in_link).dot(&along) / along.norm_squared().max(f64::MIN_POSITIVE);
            (point - (from_in_link + along * share.clamp(0.0, 1.0))).norm() <= *radius_m
        }
        LinkShape::Cuboid { link_from_box, half_extents_m } => {
            let local = link_from_box.inverse_transform_point(point);
            local.iter().zip(half_extents_m.iter()).all(|(x, half)| x.abs() <= *half)
        }
        LinkShape::Cylinder { link_from_cylinder, half_length_m, radius_m } => {
            let local = link_from_cylinder.inverse_transform_point(point);
            local.z.abs() <= *half_length_m && local.x.hypot(local.y) <= *radius_m
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Pose, Vector};

    fn object() -> CellObject {
        CellObject::sphere(Point::new(0.4, 0.0, 0.1), 0.1)
    }

    fn block(name: &str, center: [f64; 3], half_m: f64) -> KeepOut {
        let [x, y, z] = center;
        let shape_in_base = LinkShape::Cuboid {
            link_from_box: Pose::translation(x, y, z),
            half_extents_m: Vector::repeat(half_m),
        };
        KeepOut { name: name.to_owned(), shape_in_base }
    }

    #[test]
    fn a_region_over_the_object_is_told_with_its_share() {
        let told = |center, half_m| {
            let warnings = check(&[block("post", center, half_m)], &object());
            warnings.into_iter().map(|warning| warning.message).next()
        };
        assert!(
            told([0.4, 0.0, 0.1], 0.5)
                .unwrap()
                .contains("post holds 100 % of the object, its centre included")
        );
        // Half of the sphere, the plane through its centre not in the region.
        let half = told([0.601, 0.0, 0.1], 0.2).unwrap();
        assert!(half.contains("holds 4") && !half.contains("centre"), "{half}");
        assert_eq!(told([0.4, 0.0, 0.5], 0.2), None);
        // A post that only grazes it.
        assert_eq!(told([0.4, 0.0, 0.29], 0.1), None);
        // A thin needle through the centre.
        assert!(told([0.4, 0.0, 0.1], 1e-3).is_some());
    }
}

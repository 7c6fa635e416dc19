//! The largest hole that a set of views leaves in its band.

use super::Band;
use super::view_set::angle;
use crate::geometry::{Direction, Vector};

/// Largest angle, radians, from any direction in `band` to the nearest of `directions`: no part of
/// the band is further from a view. Pi if there are no directions.
///
/// Exact up to rounding: the farthest direction is equally far from three views, or from two on
/// the rim, or lies on the rim straight across from one; all these are looked at.
pub fn covering_radius_rad(directions: &[Direction], band: Band) -> f64 {
    if directions.is_empty() {
        return std::f64::consts::PI;
    }
    let (low, high) = band.heights();
    let mut worst = 0.0f64;
    let mut consider = |candidate: Vector| {
        if candidate.z < low - 1e-9 || candidate.z > high + 1e-9 {
            return;
        }
        // Most candidates lie near some view: they are out as soon as it is met.
        let near = worst.cos() + 1e-12;
        if directions.iter().all(|d| d.dot(&candidate) < near) {
            let radius = directions.iter().map(|d| angle(d, &candidate)).fold(f64::INFINITY, f64::min);
            worst = worst.max(radius);
        }
    };
    for rim in [low, high] {
        let radius = (1.0 - rim * rim).max(0.0).sqrt();
        consider(Vector::new(radius, 0.0, rim));
        for (i, a) in directions.iter().enumerate() {
            // On a circle of constant height the point farthest from `a` is opposite in azimuth.
            let horizontal = a.x.hypot(a.y);
            if horizontal > 1e-12 {
                consider(Vector::new(-a.x / horizontal * radius, -a.y / horizontal * radius, rim));
            }
            for b in &directions[..i] {
                for point in equally_far_at_height(a, b, rim) {
                    consider(point);
                }
            }
        }
    }
    for (i, a) in directions.iter().enumerate() {
        for (j, b) in directions[..i].iter().enumerate() {
            let chord = b.into_inner() - a.into_inner();
            for c in &directions[..j] {
                let normal = chord.cross(&(c.into_inner() - a.into_inner()));
                let length = normal.norm();
                if length > 1e-12 {
                    consider(normal / length);
                    consider(-normal / length);
                }
            }
        }
    }
    worst
}

/// Unit vectors of height `z` with the same angle to `a` and `b`.
fn equally_far_at_height(a: &Vector, b: &Vector, z: f64) -> Vec<Vector> {
    // difference . (x, y) = -difference.z * z, x^2 + y^2 = 1 - z^2.
    let difference = a - b;
    let square = difference.x * difference.x + difference.y * difference.y;
    if square < 1e-24 {
        return Vec::new();
    }
    let right = -difference.z * z;
    let rest = (1.0 - z * z) - right * right / square;
    if rest < 0.0 {
        return Vec::new();
    }
    let (foot_x, foot_y) = (difference.x * right / square, difference.y * right / square);
    let along = (rest / square).sqrt();
    [1.0, -1.0]
        .map(|sign| {
            Vector::new(foot_x - sign * along * difference.y, foot_y + sign * along * difference.x, z)
        })
        .to_vec()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::direction_from_azimuth_elevation;
    use proptest::prelude::*;

    #[test]
    fn the_top_view_alone_leaves_the_rim_farthest() {
        let band = Band::from_degrees(10.0, 90.0).unwrap();
        let radius = covering_radius_rad(&[Vector::z_axis()], band);
        assert!((radius.to_degrees() - 80.0).abs() < 1e-9);
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(40))]

        #[test]
        fn no_sampled_direction_is_farther_and_one_comes_close(
            views in prop::collection::vec((-3.1..3.1f64, 0.1..1.5f64), 1..12),
        ) {
            let band = Band::from_degrees(5.0, 88.0).unwrap();
            let views: Vec<Direction> =
                views.iter().map(|&(az, el)| direction_from_azimuth_elevation(az, el)).collect();
            let radius = covering_radius_rad(&views, band);
            let mut sampled = 0.0f64;
            for i in 0..=60 {
                let elevation = band.min_elevation_rad
                    + (band.max_elevation_rad - band.min_elevation_rad) * i as f64 / 60.0;
                for k in 0..240 {
                    let probe = direction_from_azimuth_elevation(k as f64 * std::f64::consts::TAU / 240.0, elevation);
                    let nearest = views.iter().map(|v| angle(v, &probe)).fold(f64::INFINITY, f64::min);
                    sampled = sampled.max(nearest);
                }
            }
            prop_assert!(sampled <= radius + 1e-9, "{sampled} {radius}");
            prop_assert!(radius <= sampled + 0.04, "{sampled} {radius}");
        }
    }
}

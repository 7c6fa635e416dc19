//! The small problems that closed forms are put together from (Paden 1985,
//! Kahan 1983; numbering of Murray, Li and Sastry 1994 and Elias and Wen 2022).

use crate::geometry::Vector;

/// Share of the largest possible value under which an angle has no effect.
const NO_EFFECT: f64 = 1e-12;

/// `vector` turned by `angle_rad` about the unit vector `axis` (Rodrigues).
pub(super) fn turned(axis: &Vector, angle_rad: f64, vector: &Vector) -> Vector {
    let (sin, cos) = angle_rad.sin_cos();
    vector * cos + axis.cross(vector) * sin + axis * (axis.dot(vector) * (1.0 - cos))
}

/// Subproblem 1: the angle about `axis` that turns `from` nearest to `to`,
/// radians; `free_rad` where either lies along the axis.
pub(super) fn angle_between(axis: &Vector, from: &Vector, to: &Vector, free_rad: f64) -> f64 {
    let sine = axis.dot(&from.cross(to));
    let cosine = from.dot(to) - axis.dot(from) * axis.dot(to);
    if sine.hypot(cosine) <= NO_EFFECT * from.norm() * to.norm() { free_rad } else { sine.atan2(cosine) }
}

/// The angles that solve a subproblem 4.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Angles {
    /// Two angles, radians; equal where there is but one.
    pub angles_rad: [f64; 2],
    /// By how much the value asked for is out of range: above 0 for too large,
    /// below for too small, 0 where it is met. The angles come nearest to it.
    pub beyond: f64,
    /// Sine of half the angle between the two: 0 where they fall together or apart by a turn.
    pub room: f64,
}

/// Subproblem 4: the angles about `axis` for which `toward . turned(from) = value`;
/// `free_rad` where turning has no effect.
pub(super) fn angles_to_level(
    toward: &Vector,
    axis: &Vector,
    from: &Vector,
    value: f64,
    free_rad: f64,
) -> Angles {
    let level = toward.dot(axis) * axis.dot(from);
    let (a, b) = (toward.dot(from) - level, toward.dot(&axis.cross(from)));
    let radius = a.hypot(b);
    let wanted = value - level;
    let beyond = if wanted.abs() <= radius { 0.0 } else { (wanted.abs() - radius) * wanted.signum() };
    if radius <= NO_EFFECT * toward.norm() * from.norm() {
        return Angles { angles_rad: [free_rad; 2], beyond, room: 0.0 };
    }
    // At the end of the range the root is 0 and the angle the nearest one.
    let along = wanted.clamp(-radius, radius);
    let across = ((radius - along) * (radius + along)).sqrt();
    let angle = |across: f64| (b * along + a * across).atan2(a * along - b * across);
    Angles { angles_rad: [angle(across), angle(-across)], beyond, room: across / radius }
}

/// Subproblem 2, first half: the angles about `axis` (a unit vector) that lean `from`
/// against the unit vector `pole` as `wanted` leans; `free_rad` where turning has no effect.
///
/// As accurate where `wanted` lies almost along `pole`, where its cosine loses half the
/// digits: the triple product of the three directions comes from the angles between them.
pub(super) fn angles_to_lean(
    pole: &Vector,
    axis: &Vector,
    from: &Vector,
    wanted: &Vector,
    free_rad: f64,
) -> Angles {
    let (alpha, beta, gamma) = (angle(pole, axis), angle(axis, from), angle(pole, wanted));
    let half = 0.5 * (alpha + beta + gamma);
    // Gram's determinant of three unit vectors, as in the half-angle formulas of spherical triangles.
    let squared = 4.0 * half.sin() * (half - alpha).sin() * (half - beta).sin() * (half - gamma).sin();
    let level = pole.dot(axis) * axis.dot(from);
    let (a, b) = (pole.dot(from) - level, pole.dot(&axis.cross(from)));
    let radius = a.hypot(b);
    let length = from.norm();
    let lean = gamma.cos() * length - level;
    // Also for a NaN.
    let beyond =
        if squared >= 0.0 || lean.abs() <= radius { 0.0 } else { (lean.abs() - radius) * lean.signum() };
    if radius <= NO_EFFECT * length {
        return Angles { angles_rad: [free_rad; 2], beyond, room: 0.0 };
    }
    let across = length * squared.max(0.0).sqrt();
    let along = lean.clamp(-radius, radius);
    let angle = |across: f64| (b * along + a * across).atan2(a * along - b * across);
    Angles { angles_rad: [angle(across), angle(-across)], beyond, room: across / radius }
}

/// The angle between two directions, radians; accurate for small ones too.
fn angle(a: &Vector, b: &Vector) -> f64 {
    a.cross(b).norm().atan2(a.dot(b))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn vector() -> impl Strategy<Value = Vector> {
        proptest::array::uniform3(-1.0..1.0f64)
            .prop_map(Vector::from)
            .prop_filter("long enough", |v| v.norm() > 0.1)
    }

    proptest! {
        #[test]
        fn the_angle_between_turns_one_onto_the_other(axis in vector(), from in vector(), angle in -3.1..3.1f64) {
            let axis = axis.normalize();
            prop_assume!(axis.cross(&from).norm() > 1e-3);
            let to = turned(&axis, angle, &from);
            prop_assert!((angle_between(&axis, &from, &to, 9.0) - angle).abs() < 1e-9);
        }

        #[test]
        fn both_angles_reach_the_level_and_what_is_out_of_range_says_so(
            axis in vector(), from in vector(), toward in vector(), value in -2.0..2.0f64
        ) {
            let axis = axis.normalize();
            let found = angles_to_level(&toward, &axis, &from, value, 0.0);
            for angle in found.angles_rad {
                let level = toward.dot(&turned(&axis, angle, &from));
                prop_assert!((level + found.beyond - value).abs() < 1e-9);
            }
            // Nothing comes nearer.
            let nearest = (0..360).map(|i| (toward.dot(&turned(&axis, f64::from(i).to_radians(), &from)) - value).abs());
            prop_assert!(nearest.fold(f64::INFINITY, f64::min) >= found.beyond.abs() - 1e-9);
        }
    }

    proptest! {
        #[test]
        fn the_lean_is_met_even_where_it_is_tiny(
            axis in vector(), pole in vector(), angle in -3.1..3.1f64, lean in prop_oneof![0.0..3.0f64, 0.0..1e-7f64], other in vector()
        ) {
            let (axis, pole) = (axis.normalize(), pole.normalize());
            prop_assume!(axis.cross(&pole).norm() > 0.1 && pole.cross(&other).norm() > 0.1);
            // What leans as wanted after a turn by `angle`.
            let wanted = turned(&pole.cross(&other).normalize(), lean, &pole) * 0.3;
            let from = turned(&axis, -angle, &wanted);
            let found = angles_to_lean(&pole, &axis, &from, &wanted, 0.0);
            prop_assert!(found.beyond.abs() < 1e-12);
            for angle in found.angles_rad {
                let reached = super::angle(&pole, &turned(&axis, angle, &from));
                prop_assert!((reached - lean).abs() < 1e-13 / lean.sin().abs().max(1e-3) + 1e-12, "{reached} {lean}");
            }
        }
    }

    #[test]
    fn an_angle_without_effect_is_the_free_one() {
        let (x, z) = (Vector::x(), Vector::z());
        assert_eq!(angle_between(&z, &(z * 2.0), &z, 0.7), 0.7);
        assert_eq!(
            angles_to_level(&z, &z, &x, 0.0, 0.7),
            Angles { angles_rad: [0.7; 2], beyond: 0.0, room: 0.0 }
        );
        assert_eq!(angles_to_level(&z, &z, &x, 0.5, 0.7).beyond, 0.5);
    }
}

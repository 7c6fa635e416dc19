//! Three axes that meet in a point: the angles that turn everything behind them as wanted.

use nalgebra::UnitQuaternion;

use super::subproblems::{angle_between, angles_to_lean, turned};
use crate::geometry::{Point, Vector};
use crate::robot::axis::Axis;

/// Sine under which neighbouring wrist axes count as parallel.
const LEAST_SINE: f64 = 0.1;

/// Sine of the angle between the outer axes below which they count as one.
const SINGULAR: f64 = 1e-10;

/// A spherical wrist: the directions of its axes in the zero posture.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Wrist {
    along: [Vector; 3],
    /// A direction square to the last axis.
    beside_last: Vector,
}

impl Wrist {
    /// The wrist of three axes that meet up to `tolerance_m`, the point where they do,
    /// and by how much they miss it, metres.
    pub fn of(axes: [Axis; 3], tolerance_m: f64) -> Option<(Self, Point, f64)> {
        let [a4, a5, a6] = &axes;
        if !(a4.sine(a5) >= LEAST_SINE && a5.sine(a6) >= LEAST_SINE) {
            return None;
        }
        let (here, there) = a4.nearest(a5)?;
        let centre = nalgebra::center(&here, &there);
        let gap_m = (here - there).norm().max(a6.distance_m(&centre));
        let along = [a4.along, a5.along, a6.along];
        let beside_last = a6.along.cross(&a5.along).normalize();
        (gap_m <= tolerance_m).then_some((Self { along, beside_last }, centre, gap_m))
    }

    /// The two ways to reach `rotation`; where the outer axes fall together the
    /// first takes `free_rad`.
    pub fn turn(&self, rotation: &UnitQuaternion<f64>, free_rad: f64) -> [[f64; 3]; 2] {
        let [k4, k5, k6] = &self.along;
        let wanted = rotation * k6;
        angles_to_lean(k4, k5, k6, &wanted, 0.0).angles_rad.map(|q5| {
            let bent = turned(k5, q5, k6);
            // Where the last axis lies along the first one, rounding would choose the angle.
            let singular = k4.cross(&bent).norm() < SINGULAR && k4.cross(&wanted).norm() < SINGULAR;
            let q4 = if singular { free_rad } else { angle_between(k4, &bent, &wanted, free_rad) };
            let beside = turned(k4, -q4, &(rotation * self.beside_last));
            let q6 = angle_between(k6, &self.beside_last, &turned(k5, -q5, &beside), 0.0);
            [q4, q5, q6]
        })
    }
}

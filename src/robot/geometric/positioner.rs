//! Three axes that carry a point: the angles that put it where it is wanted.
//!
//! Two structures have a closed form without a quartic (Pieper 1968):
//!
//! - axes 2 and 3 parallel, as in the ordinary industrial arm (Brandstoetter,
//!   Angerer and Hofbaur 2014): the point's level along them depends on axis 1
//!   alone, its distance from axis 2 on axis 3 alone;
//! - axes 1 and 2 meet: the point's distance from there depends on axis 3 alone.

use super::subproblems::{angle_between, angles_to_lean, angles_to_level, turned};
use crate::geometry::{Point, Vector};
use crate::robot::ReachBound;
use crate::robot::axis::Axis;

/// Sine under which two axes are too near to parallel to place a point by both.
const LEAST_SINE: f64 = 0.1;

/// How the three axes lie.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Layout {
    /// Axes 2 and 3 are parallel.
    Parallel,
    /// Axes 1 and 2 meet here.
    Meeting(Point),
}

/// Three axes and the point they carry, all in the zero posture.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Positioner {
    axes: [Axis; 3],
    carried: Point,
    layout: Layout,
}

/// One way to put the point where it is wanted, or as near as this way gets.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Placement {
    /// The three angles, radians.
    pub angles_rad: [f64; 3],
    /// The bound that keeps the point away, if one does.
    pub held_by: Option<ReachBound>,
    /// By how much that bound is broken, 0 or more: metres at the shoulder, square metres at the elbow.
    pub beyond: f64,
    /// How far it is from falling together with another way, 0 to 1.
    pub room: f64,
}

impl Positioner {
    /// The positioner of three axes if they have one of the structures up to `tolerance`
    /// (metres and sine), and how far they are from it.
    pub fn of(axes: [Axis; 3], carried: Point, tolerance: f64) -> Option<(Self, f64)> {
        let [a1, a2, a3] = &axes;
        if !(a1.sine(a2) >= LEAST_SINE) {
            return None;
        }
        let slant = a2.sine(a3);
        if slant <= tolerance {
            // Without lever at the elbow or behind it the last angle moves nothing.
            let levers = a2.distance_m(&a3.point).min(a3.distance_m(&carried));
            return (levers > 1e-3).then_some((Self { axes, carried, layout: Layout::Parallel }, slant));
        }
        let (here, there) = a1.nearest(a2)?;
        let gap = (here - there).norm();
        let centre = nalgebra::center(&here, &there);
        let levers = a3.distance_m(&centre).min(a3.distance_m(&carried));
        (gap <= tolerance && levers > 1e-3)
            .then_some((Self { axes, carried, layout: Layout::Meeting(centre) }, gap))
    }

    /// The four ways to carry the point to `wanted`; free angles take `seed_rad`'s.
    pub fn place(&self, wanted: &Point, seed_rad: [f64; 3]) -> [Placement; 4] {
        self.place_some(wanted, seed_rad, None)
    }

    /// As [`Self::place`], but only way number `only` is worked out.
    pub fn place_some(&self, wanted: &Point, seed_rad: [f64; 3], only: Option<usize>) -> [Placement; 4] {
        match self.layout {
            Layout::Parallel => self.place_parallel(wanted, seed_rad, only),
            Layout::Meeting(centre) => self.place_meeting(&centre, wanted, seed_rad, only),
        }
    }

    fn place_parallel(&self, wanted: &Point, seed_rad: [f64; 3], only: Option<usize>) -> [Placement; 4] {
        let [a1, a2, a3] = &self.axes;
        let level = a2.along.dot(&(self.carried - a1.point));
        // Turning the point back by q1 is turning by -q1.
        let from_first = wanted - a1.point;
        let shoulders = angles_to_level(&a2.along, &a1.along, &from_first, level, -seed_rad[0]);
        let flat = |v: Vector| v - a2.along * a2.along.dot(&v);
        let (upper, fore) = (flat(a3.point - a2.point), flat(self.carried - a3.point));
        let mut placements = [EMPTY; 4];
        for (slots, back) in
            placements.chunks_exact_mut(2).zip(shoulders.angles_rad).skip(first(only)).take(count(only))
        {
            let seen = a1.point + turned(&a1.along, back, &from_first);
            let reach = flat(seen - a2.point);
            let value = 0.5 * (reach.norm_squared() - upper.norm_squared() - fore.norm_squared());
            let elbows = angles_to_level(&upper, &a3.along, &fore, value, seed_rad[2]);
            for (slot, q3) in slots.iter_mut().zip(elbows.angles_rad) {
                let arm = upper + turned(&a3.along, q3, &fore);
                let q2 = angle_between(&a2.along, &arm, &reach, seed_rad[1]);
                let (held_by, beyond) = if shoulders.beyond != 0.0 {
                    (Some(ReachBound::InsideShoulderColumn), shoulders.beyond.abs())
                } else {
                    (beyond_elbow(elbows.beyond), elbows.beyond.abs())
                };
                let room = shoulders.room.min(elbows.room);
                *slot = Placement { angles_rad: [-back, q2, q3], held_by, beyond, room };
            }
        }
        placements
    }

    fn place_meeting(
        &self,
        centre: &Point,
        wanted: &Point,
        seed_rad: [f64; 3],
        only: Option<usize>,
    ) -> [Placement; 4] {
        let [a1, a2, a3] = &self.axes;
        let (upper, fore) = (a3.point - centre, self.carried - a3.point);
        let reach = wanted - centre;
        let value = 0.5 * (reach.norm_squared() - upper.norm_squared() - fore.norm_squared());
        let elbows = angles_to_level(&upper, &a3.along, &fore, value, seed_rad[2]);
        let mut placements = [EMPTY; 4];
        for (slots, q3) in
            placements.chunks_exact_mut(2).zip(elbows.angles_rad).skip(first(only)).take(count(only))
        {
            let arm = upper + turned(&a3.along, q3, &fore);
            let lifts = angles_to_lean(&a1.along, &a2.along, &arm, &reach, seed_rad[1]);
            for (slot, q2) in slots.iter_mut().zip(lifts.angles_rad) {
                let lifted = turned(&a2.along, q2, &arm);
                let q1 = angle_between(&a1.along, &lifted, &reach, seed_rad[0]);
                let (held_by, beyond) = match beyond_elbow(elbows.beyond) {
                    Some(bound) => (Some(bound), elbows.beyond.abs()),
                    None if lifts.beyond != 0.0 => {
                        (Some(ReachBound::InsideShoulderColumn), lifts.beyond.abs())
                    }
                    None => (None, 0.0),
                };
                let room = elbows.room.min(lifts.room);
                *slot = Placement { angles_rad: [q1, q2, q3], held_by, beyond, room };
            }
        }
        placements
    }
}

const EMPTY: Placement = Placement { angles_rad: [0.0; 3], held_by: None, beyond: 0.0, room: 0.0 };

fn beyond_elbow(beyond: f64) -> Option<ReachBound> {
    if beyond > 0.0 {
        Some(ReachBound::TooFar)
    } else if beyond < 0.0 {
        Some(ReachBound::TooClose)
    } else {
        None
    }
}

/// Ways come in two pairs: the first pair to work out, and how many.
fn first(only: Option<usize>) -> usize {
    only.map_or(0, |way| way / 2)
}

fn count(only: Option<usize>) -> usize {
    if only.is_some() { 1 } else { 2 }
}

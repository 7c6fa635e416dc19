//! Where the object would be served better.

use std::f64::consts::TAU;

use rayon::prelude::*;

use super::Place;
use crate::geometry::Point;
use crate::motion::{Reach, farthest_reach_m, object_stands_clear};
use crate::plan::{Arm, ObjectSphere, PlanRequest, cell};
use crate::views::Lattice;

/// Rings about the base and places on each, first asked for.
const RINGS: (usize, usize) = (8, 16);
/// Directions asked for at a place: at first, and to judge the best.
const DIRECTIONS: (usize, usize) = (40, 200);
/// Places that are moved about, and how often their step is halved.
const REFINED: (usize, u32) = (6, 2);
/// Suggestions given.
const GIVEN: usize = 3;
/// Least distance between two suggestions, metres.
const APART_M: f64 = 0.05;
/// A suggestion serves at least this much more of the band than the given place.
const WORTH: f64 = 0.01;

/// The given place.
pub(super) fn given(request: &PlanRequest, arm: &Arm, reach: &Reach) -> Place {
    let directions = if reach.is_quick() { DIRECTIONS.1 } else { DIRECTIONS.0 };
    let center_in_base = request.object().center_in_base;
    Place { center_in_base, fraction: fraction(request, arm, center_in_base, directions) }
}

/// The best places found for the object at its height: rings about the base, the best of their
/// places moved about.
pub(super) fn suggest(request: &PlanRequest, arm: &Arm, given: &Place) -> Vec<Place> {
    let center = given.center_in_base;
    let farthest_m = farthest_reach_m(&cell(request, arm));
    let (rings, around) = RINGS;
    let spacing_m = farthest_m / rings as f64;
    let at = |index: usize| {
        let (ring, step) = (index / around, index % around);
        let radius_m = spacing_m * (ring as f64 + 1.0);
        // Every other ring is turned by half a step.
        let turn = (step as f64 + 0.5 * (ring % 2) as f64) / around as f64;
        let (sin, cos) = (turn * TAU).sin_cos();
        Point::new(radius_m * cos, radius_m * sin, center.z)
    };
    let judged = |place: Point, directions: usize| Place {
        center_in_base: place,
        fraction: fraction(request, arm, place, directions),
    };
    let mut places: Vec<Place> =
        (0..rings * around).into_par_iter().map(|index| judged(at(index), DIRECTIONS.0)).collect();
    sort(&mut places, &center);
    places.truncate(REFINED.0);
    let mut places: Vec<Place> = places
        .into_par_iter()
        .map(|place| {
            let mut best = judged(place.center_in_base, DIRECTIONS.1);
            let mut step_m = 0.5 * spacing_m;
            for _ in 0..REFINED.1 {
                let moves = [(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)].map(|(x, y)| {
                    judged(best.center_in_base + nalgebra::vector![x * step_m, y * step_m, 0.0], DIRECTIONS.1)
                });
                let better = moves.into_iter().filter(|moved| moved.fraction > best.fraction);
                if let Some(moved) = better.max_by(|a, b| a.fraction.total_cmp(&b.fraction)) {
                    best = moved;
                }
                step_m *= 0.5;
            }
            best
        })
        .collect();
    sort(&mut places, &center);
    let mut suggestions: Vec<Place> = Vec::with_capacity(GIVEN);
    for place in places {
        let apart = |other: &Place| (other.center_in_base - place.center_in_base).norm() >= APART_M;
        let worth = place.fraction >= given.fraction + WORTH;
        if worth && suggestions.len() < GIVEN && suggestions.iter().all(apart) {
            suggestions.push(place);
        }
    }
    suggestions
}

/// Best first; of equals the nearest to `center`.
fn sort(places: &mut [Place], center: &Point) {
    let away_m = |place: &Place| (place.center_in_base - center).norm();
    places.sort_by(|a, b| b.fraction.total_cmp(&a.fraction).then(away_m(a).total_cmp(&away_m(b))));
}

/// Reachable part of the band with the object at `place`; 0 where it cannot stand.
fn fraction(request: &PlanRequest, arm: &Arm, place: Point, directions: usize) -> f64 {
    let object = ObjectSphere { center_in_base: place, ..request.object() };
    let moved = PlanRequest { object: Some(object), arm: None, ..request.clone() };
    let cell = cell(&moved, arm);
    if !object_stands_clear(&cell) {
        return 0.0;
    }
    let Ok(reach) = Reach::new(&cell, arm.roll, arm.start_rad.as_deref()) else { return 0.0 };
    let space = moved.view_space();
    let lattice = Lattice::new(space.band, directions);
    let mut probe = reach.probe();
    let reached = |direction: &&crate::geometry::Direction| probe.reaches(&space.pose(direction, 0.0));
    let asked = lattice.directions.iter().skip(1).take(lattice.equal_areas);
    asked.filter(reached).count() as f64 / lattice.equal_areas as f64
}

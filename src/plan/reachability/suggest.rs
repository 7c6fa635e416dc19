//! Where the object would be served better.

use std::f64::consts::TAU;

use rayon::prelude::*;

use super::Place;
use crate::geometry::Point;
use crate::motion::{Allowance, Reach, farthest_reach_m, object_stands_clear};
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
pub(super) fn given(judge: &mut Judge) -> Place {
    let directions = if judge.reach.is_quick() { DIRECTIONS.1 } else { DIRECTIONS.0 };
    let center_in_base = judge.request.object().center_in_base;
    judge
        .judge(&[center_in_base], directions)
        .first()
        .copied()
        .unwrap_or(Place { center_in_base, fraction: 0.0 })
}

/// The best places found for the object at its height: rings about the base, the best of their
/// places moved about.
pub(super) fn suggest(judge: &mut Judge, given: &Place) -> Vec<Place> {
    let center = given.center_in_base;
    let farthest_m = farthest_reach_m(&cell(judge.request, judge.arm));
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
    let rings: Vec<Point> = (0..rings * around).map(at).collect();
    let mut places = judge.judge(&rings, DIRECTIONS.0);
    sort(&mut places, &center);
    places.truncate(REFINED.0);
    let best: Vec<Point> = places.iter().map(|place| place.center_in_base).collect();
    let mut places = judge.judge(&best, DIRECTIONS.1);
    let mut step_m = 0.5 * spacing_m;
    for _ in 0..REFINED.1 {
        let around = |place: &Place| {
            let from = place.center_in_base;
            [(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)]
                .map(|(x, y)| from + nalgebra::vector![x * step_m, y * step_m, 0.0])
        };
        let moves: Vec<Point> = places.iter().flat_map(around).collect();
        let moved = judge.judge(&moves, DIRECTIONS.1);
        for (place, moves) in places.iter_mut().zip(moved.chunks(4)) {
            let better = moves.iter().filter(|moved| moved.fraction > place.fraction);
            if let Some(moved) = better.max_by(|a, b| a.fraction.total_cmp(&b.fraction)) {
                *place = *moved;
            }
        }
        step_m *= 0.5;
    }
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

/// Judges places for the object until the work ends.
pub(super) struct Judge<'a> {
    pub(super) request: &'a PlanRequest,
    pub(super) arm: &'a Arm,
    pub(super) reach: &'a Reach<'a>,
    pub(super) left: Allowance,
}

/// Places judged at the same time.
const AT_A_TIME: usize = 8;

impl Judge<'_> {
    /// The places with the reachable part of the band about each, from `directions` directions; 0
    /// where the object cannot stand and where the work has ended.
    fn judge(&mut self, places: &[Point], directions: usize) -> Vec<Place> {
        let mut judged = Vec::with_capacity(places.len());
        for block in places.chunks(AT_A_TIME) {
            let most = Allowance { most: self.left.most / AT_A_TIME as u64, stop: self.left.stop.clone() };
            let found: Vec<(f64, u64)> = match self.left.is_over() {
                true => vec![(0.0, 0); block.len()],
                false => block.par_iter().map(|place| self.fraction(*place, directions, &most)).collect(),
            };
            for (place, (fraction, spent)) in block.iter().zip(found) {
                self.left = self.left.less(spent);
                judged.push(Place { center_in_base: *place, fraction });
            }
        }
        judged
    }

    /// Reachable part of the band with the object at `place`, and the work that took.
    fn fraction(&self, place: Point, directions: usize, most: &Allowance) -> (f64, u64) {
        let object = ObjectSphere { center_in_base: place, ..self.request.object() };
        let moved = PlanRequest { object: Some(object), arm: None, ..self.request.clone() };
        let cell = cell(&moved, self.arm);
        if !object_stands_clear(&cell) {
            return (0.0, 0);
        }
        let Ok(reach) = self.reach.with_object_of(&cell) else { return (0.0, 0) };
        let space = moved.view_space();
        let lattice = Lattice::new(space.band, directions);
        let mut probe = reach.probe(most);
        let reached = |direction: &&crate::geometry::Direction| probe.reaches(&space.pose(direction, 0.0));
        let asked = lattice.directions.iter().skip(1).take(lattice.equal_areas);
        let fraction = asked.filter(reached).count() as f64 / lattice.equal_areas as f64;
        (fraction, probe.spent())
    }
}

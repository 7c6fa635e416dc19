//! Off the lattice: short moves in all directions, each asked for before it is made.

use std::f64::consts::TAU;

use super::Lattice;
use super::asker::Asker;
use super::repulsion::{least_squared_distance, repulsion};
use crate::geometry::Vector;

/// Binary logarithms of the exponents of the squared distance, one pass each.
const PASSES: [u32; 2] = [6, 9];
/// Directions tried from a place.
const COMPASS: usize = 8;
/// Moves of one view tried against the predicate before it stays.
const TRIES: usize = 2;
/// Shortest step, radians.
const FINEST_RAD: f64 = 2e-4;
/// Most rounds through all views with one length of step.
const ROUNDS: usize = 5;

/// Moves all points but the first to where they are locally farthest apart and usable.
pub(super) fn polish(points: Vec<Vector>, lattice: &Lattice, asker: &mut Asker) -> Vec<Vector> {
    let found = polished(points.clone(), lattice, &mut |place| asker.is_likely(place));
    // Points of the lattice have been asked before.
    let mut moved = found.iter().zip(&points).filter(|(after, before)| after != before);
    if moved.all(|(after, _)| asker.is_usable(after)) {
        return found;
    }
    polished(points, lattice, &mut |place| asker.may_move_to(place))
}

fn polished(
    mut points: Vec<Vector>,
    lattice: &Lattice,
    usable_at: &mut dyn FnMut(&Vector) -> bool,
) -> Vec<Vector> {
    let (low, high) = lattice.band.heights();
    let mut best = points.clone();
    let mut best_square = least_squared_distance(&points);
    let mut turn = 0.0f64;
    for doublings in PASSES {
        let mut step_rad = 0.4 * lattice.spacing_rad;
        while step_rad > FINEST_RAD {
            for _ in 0..ROUNDS {
                // Another compass each round: moves along a slanting border need their direction.
                turn = (turn + 0.381_966 / COMPASS as f64).fract();
                if !round(&mut points, step_rad, turn, doublings, (low, high), usable_at) {
                    break;
                }
                let square = least_squared_distance(&points);
                if square > best_square {
                    best_square = square;
                    best.clone_from(&points);
                }
            }
            step_rad *= 0.5;
        }
        points.clone_from(&best);
    }
    best
}

/// Moves each point once, if that helps; whether one moved.
fn round(
    points: &mut [Vector],
    step_rad: f64,
    turn: f64,
    doublings: u32,
    heights: (f64, f64),
    usable_at: &mut dyn FnMut(&Vector) -> bool,
) -> bool {
    let reference = least_squared_distance(points).max(1e-12);
    let mut moved = false;
    for view in 1..points.len() {
        let here = points[view];
        let feel = |place: &Vector, enough| repulsion(place, points, view, reference, doublings, enough);
        let now = feel(&here, f64::INFINITY);
        // A view that nothing presses may stay.
        if now < 1e-6 {
            continue;
        }
        let mut places: Vec<(f64, Vector)> = (0..COMPASS)
            .map(|k| at(&here, step_rad, turn + k as f64 / COMPASS as f64, heights))
            .map(|place| (feel(&place, now), place))
            .filter(|(there, _)| *there < now * (1.0 - 1e-6))
            .collect();
        places.sort_by(|a, b| a.0.total_cmp(&b.0));
        let free = places.iter().take(TRIES).find(|(_, place)| usable_at(place));
        if let Some((_, place)) = free {
            points[view] = *place;
            moved = true;
        }
    }
    moved
}

/// The point a step from `here`, `turn` of a whole turn from east, kept within the heights.
fn at(here: &Vector, step_rad: f64, turn: f64, (low, high): (f64, f64)) -> Vector {
    let horizontal = here.x.hypot(here.y);
    let east = if horizontal < 1e-9 { Vector::x() } else { Vector::new(-here.y, here.x, 0.0) / horizontal };
    let north = here.cross(&east);
    let (sin, cos) = (turn * TAU).sin_cos();
    let target = (here + (east * cos + north * sin) * step_rad).normalize();
    let z = target.z.clamp(low, high);
    let scale = (1.0 - z * z).max(0.0).sqrt() / target.x.hypot(target.y).max(1e-12);
    Vector::new(target.x * scale, target.y * scale, z)
}

//! Views that hop from spot to neighbouring spot until none gains by it.

use super::repulsion::repulsion;
use crate::geometry::Vector;

/// Binary logarithms of the exponents, one stage each, of the squared distance.
const STAGES: [u32; 4] = [1, 2, 4, 6];
/// Of them, those that a set nearly in order needs: softer ones would undo the order.
const LATE_STAGES: usize = 2;
/// Most rounds through all views in a stage.
const ROUNDS: usize = 40;
/// Spots this many spacings away are neighbours.
const NEAR: f64 = 1.8;

/// The spots views may stand on, and which are near each other.
pub(super) struct Ground {
    pub(super) spots: Vec<Vector>,
    neighbours: Vec<Vec<u32>>,
    /// Repulsions between pairs computed so far, about.
    pub(super) work: u64,
}

impl Ground {
    pub(super) fn new(spots: Vec<Vector>, spacing_rad: f64) -> Ground {
        let near = (NEAR * spacing_rad).powi(2);
        let neighbours_of = |a: &Vector| {
            let is_near = |b: &Vector| {
                let square = (a - b).norm_squared();
                square > 0.0 && square < near
            };
            (0u32..).zip(&spots).filter(|(_, b)| is_near(b)).map(|(index, _)| index).collect()
        };
        let neighbours = spots.iter().map(neighbours_of).collect();
        Ground { spots, neighbours, work: 0 }
    }
}

/// Moves all views but the first, given as spots, to where the repulsion between them is least nearby.
pub(super) fn settle(ground: &mut Ground, mut set: Vec<usize>, nearly_ordered: bool) -> Vec<usize> {
    let mut points: Vec<Vector> = set.iter().map(|spot| ground.spots[*spot]).collect();
    let stages = if nearly_ordered { &STAGES[STAGES.len() - LATE_STAGES..] } else { &STAGES[..] };
    for &doublings in stages {
        for _ in 0..ROUNDS {
            let reference = super::repulsion::least_squared_distance(&points).max(1e-12);
            let mut moved = false;
            for view in 1..set.len() {
                let feel =
                    |place: &Vector, enough| repulsion(place, &points, view, reference, doublings, enough);
                let mut least = feel(&points[view], f64::INFINITY) * (1.0 - 1e-9);
                let mut to = None;
                ground.work += (ground.neighbours[set[view]].len() * set.len()) as u64;
                for neighbour in &ground.neighbours[set[view]] {
                    let there = feel(&ground.spots[*neighbour as usize], least);
                    if there < least {
                        (least, to) = (there, Some(*neighbour as usize));
                    }
                }
                if let Some(spot) = to {
                    set[view] = spot;
                    points[view] = ground.spots[spot];
                    moved = true;
                }
            }
            if !moved {
                break;
            }
        }
    }
    set
}

//! Large neighbourhood search for the generalised travelling salesman problem.
//!
//! Views are taken out and put back at their cheapest place and state, as in
//! GLNS (Smith and Imeson 2017); a repaired tour is kept by simulated
//! annealing. Tours that would be the best so far are first improved by
//! reversing stretches and by choosing all states anew for the order.

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::best_states::choose_best_states;
use super::collisions::Collisions;
use super::insertion::Inserter;
use super::removal::remove_some;
use super::reversal::reverse_while_it_gains;
use super::states::StateTable;

/// Work of a search.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Effort {
    /// Leg times that may be computed in all, and other work in its terms.
    pub(super) leg_times: usize,
    /// Whether legs are S-curves.
    pub(super) jerk_limited: bool,
    /// Seed of all draws.
    pub(super) seed: u64,
}

/// Leg times that one search may compute.
const LEG_TIMES: usize = 8_000_000;

impl Effort {
    /// The usual one.
    pub fn new(jerk_limited: bool, seed: u64) -> Self {
        Self { leg_times: LEG_TIMES, jerk_limited, seed }
    }
}

/// Most views taken out together.
const MOST_REMOVED: usize = 10;
/// Share of a mean leg's time that a worse tour may cost, at the beginning and at the end.
const TEMPERATURES: (f32, f32) = (0.3, 0.01);
/// What a repair costs beside leg times, in leg times.
const REPAIR_COST: usize = 500;
/// A repaired tour is improved if it is at most so many times as slow as the best.
const PROMISING: f32 = 1.04;

/// A tour faster than `first` (a state of every cluster; its first entry stays in place).
pub(super) fn search(
    table: &StateTable,
    collisions: &mut Collisions,
    first: Vec<usize>,
    effort: Effort,
) -> Vec<usize> {
    let mut rng = ChaCha8Rng::seed_from_u64(effort.seed);
    let mut inserter = Inserter::default();
    let mut best = first;
    let states = table.range(table.clusters() - 1).end;
    collisions.spend(states * states / best.len().max(1));
    improve(table, &mut best);
    let mut best_s = time_s(table, &best) + collisions.extra_s(table, &best);
    let (mut current, mut current_s) = (best.clone(), best_s);
    let leg_s = best_s / best.len() as f32;
    let views = best.len().saturating_sub(1);
    if views < 2 {
        return best;
    }
    let mut removed = Vec::new();
    let mut spent = 0;
    let mut counted = 0;
    while spent < effort.leg_times {
        if collisions.spend(spent - counted) {
            break;
        }
        counted = spent;
        let progress = spent as f32 / effort.leg_times as f32;
        let temperature = leg_s * TEMPERATURES.0 * (TEMPERATURES.1 / TEMPERATURES.0).powf(progress);
        let mut tour = current.clone();
        remove_some(table, &mut tour, &mut removed, MOST_REMOVED.min(1 + views / 2), &mut rng);
        spent += removed.len() * (states + 16 * tour.len()) + REPAIR_COST;
        let noisy = rng.random::<f32>() < 0.5;
        inserter.insert_all(table, &mut tour, &mut removed, noisy, &mut rng);
        let mut tour_s = time_s(table, &tour) + collisions.known_extra_s(&tour);
        if tour_s < best_s * PROMISING && tour != current {
            let before = tour.clone();
            improve(table, &mut tour);
            spent += states * states / views.max(1) + views * views;
            tour_s = time_s(table, &tour) + collisions.known_extra_s(&tour);
            if tour_s < best_s {
                tour_s = time_s(table, &tour) + collisions.extra_s(table, &tour);
            }
            let before_s = time_s(table, &before) + collisions.known_extra_s(&before);
            if before_s < tour_s {
                (tour, tour_s) = (before, before_s);
                if tour_s < best_s {
                    tour_s = time_s(table, &tour) + collisions.extra_s(table, &tour);
                }
            }
        }
        if tour_s < best_s - 1e-4 {
            best.clone_from(&tour);
            best_s = tour_s;
        }
        let worse = tour_s - current_s;
        if worse <= 0.0 || rng.random::<f32>() < (-worse / temperature).exp() {
            current = tour;
            current_s = tour_s;
        }
    }
    best
}

fn improve(table: &StateTable, tour: &mut [usize]) {
    choose_best_states(table, tour);
    reverse_while_it_gains(table, tour);
}

/// Seconds of a tour's legs.
pub(super) fn time_s(table: &StateTable, tour: &[usize]) -> f32 {
    tour.windows(2).map(|pair| if let [a, b] = pair { table.time(*a, *b) } else { 0.0 }).sum()
}

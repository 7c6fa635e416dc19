//! What is known about legs that collide: looked at only when a tour wants to become the best.

use std::collections::HashMap;

use super::states::StateTable;
use crate::motion::scene::Scene;
use crate::motion::sweep::Sweeper;
use crate::motion::work::cost;

/// What a colliding leg costs: so many times its time, and seconds on top, for the way around.
const DETOUR_GUESS: (f32, f32) = (1.5, 0.6);

/// Extra seconds of legs whose straight move collides.
pub(super) struct Collisions<'a> {
    scene: &'a Scene<'a>,
    sweeper: &'a mut Sweeper,
    extra_s: HashMap<(usize, usize), f32>,
    /// Margins of legs from here are less by so many metres (the start state's).
    relief: (usize, f64),
}

impl<'a> Collisions<'a> {
    /// Nothing looked at. Legs from state `start` may undercut margins by `relief_m`.
    pub fn new(scene: &'a Scene<'a>, sweeper: &'a mut Sweeper, start: usize, relief_m: f64) -> Self {
        Self { scene, sweeper, extra_s: HashMap::new(), relief: (start, relief_m) }
    }

    /// Counts leg times; whether the work is over.
    pub fn spend(&mut self, leg_times: usize) -> bool {
        self.sweeper.work().spend(cost::LEG * leg_times as u64);
        self.sweeper.work().is_over()
    }

    /// Extra seconds of `tour`, as far as its legs have been looked at.
    pub fn known_extra_s(&self, tour: &[usize]) -> f32 {
        let of_leg = |pair: &[usize]| match pair {
            [a, b] => self.extra_s.get(&key(*a, *b)).copied().unwrap_or(0.0),
            _ => 0.0,
        };
        if self.extra_s.is_empty() { 0.0 } else { tour.windows(2).map(of_leg).sum() }
    }

    /// Extra seconds of `tour` with every leg looked at.
    pub fn extra_s(&mut self, table: &StateTable, tour: &[usize]) -> f32 {
        let mut sum = 0.0;
        for pair in tour.windows(2) {
            let [a, b] = pair else { continue };
            if let Some(extra) = self.extra_s.get(&key(*a, *b)) {
                sum += extra;
                continue;
            }
            let (from, to) = table.leg(*a, *b);
            let relief_m = if *a == self.relief.0 { self.relief.1 } else { 0.0 };
            let free = self.sweeper.is_free(self.scene, &from, &to, &[0.0; 8], relief_m);
            let extra = if free { 0.0 } else { (DETOUR_GUESS.0 - 1.0) * table.time(*a, *b) + DETOUR_GUESS.1 };
            self.extra_s.insert(key(*a, *b), extra);
            sum += extra;
        }
        sum
    }
}

/// A leg and its way back are one.
fn key(a: usize, b: usize) -> (usize, usize) {
    (a.min(b), a.max(b))
}

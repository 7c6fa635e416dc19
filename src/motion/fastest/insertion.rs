//! Takes views out of a tour and puts them back where, and in the state in which, they cost least.

use rand::Rng;
use rand_chacha::ChaCha8Rng;

use super::states::StateTable;

/// Relative noise on insertion costs: what makes repairs differ from one another.
const NOISE: f32 = 0.08;

/// Where a cluster fits best.
#[derive(Clone, Copy)]
struct Place {
    /// Position in the tour before which it goes.
    position: usize,
    state: usize,
    /// Seconds it adds.
    added: f32,
}

/// Buffers of repairs.
#[derive(Default)]
pub(super) struct Inserter {
    before: Vec<f32>,
    after: Vec<f32>,
}

impl Inserter {
    /// Puts `removed` clusters back into `tour` one by one in random order, each at its cheapest
    /// place. The first entry of a tour never moves.
    pub fn insert_all(
        &mut self,
        table: &StateTable,
        tour: &mut Vec<usize>,
        removed: &mut Vec<usize>,
        noisy: bool,
        rng: &mut ChaCha8Rng,
    ) {
        while !removed.is_empty() {
            let cluster = removed.swap_remove(rng.random_range(0..removed.len()));
            let noise = if noisy { NOISE } else { 0.0 };
            if let Some(place) = self.cheapest(table, tour, cluster, noise, rng) {
                tour.insert(place.position, place.state);
            }
        }
    }

    fn cheapest(
        &mut self,
        table: &StateTable,
        tour: &[usize],
        cluster: usize,
        noise: f32,
        rng: &mut ChaCha8Rng,
    ) -> Option<Place> {
        let range = table.range(cluster);
        let mut best: Option<Place> = None;
        let mut offer = |position: usize, index: usize, added: f32, rng: &mut ChaCha8Rng| {
            let added = if noise > 0.0 { added * (1.0 + noise * rng.random::<f32>()) } else { added };
            if best.is_none_or(|b| added < b.added) {
                best = Some(Place { position, state: range.start + index, added });
            }
        };
        table.times_into(*tour.first()?, range.clone(), &mut self.before);
        for (position, pair) in tour.windows(2).enumerate() {
            let [a, b] = pair else { continue };
            table.times_into(*b, range.clone(), &mut self.after);
            let sums = self.before.iter().zip(&self.after).map(|(x, y)| x + y);
            if let Some((index, sum)) = smallest(sums) {
                offer(position + 1, index, sum - table.time(*a, *b), rng);
            }
            std::mem::swap(&mut self.before, &mut self.after);
        }
        if let Some((index, added)) = smallest(self.before.iter().copied()) {
            offer(tour.len(), index, added, rng);
        }
        best
    }
}

fn smallest(values: impl Iterator<Item = f32>) -> Option<(usize, f32)> {
    let mut best: Option<(usize, f32)> = None;
    for (index, value) in values.enumerate() {
        if best.is_none_or(|b| value < b.1) {
            best = Some((index, value));
        }
    }
    best
}

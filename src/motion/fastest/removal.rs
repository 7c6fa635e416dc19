//! Which views are taken out of a tour together.

use rand::Rng;
use rand_chacha::ChaCha8Rng;

use super::states::StateTable;

/// Takes some clusters out of `tour` (never its first entry) and lists them in `removed`.
pub(super) fn remove_some(
    table: &StateTable,
    tour: &mut Vec<usize>,
    removed: &mut Vec<usize>,
    most: usize,
    rng: &mut ChaCha8Rng,
) {
    removed.clear();
    let movable = tour.len().saturating_sub(1);
    if movable == 0 {
        return;
    }
    let count = rng.random_range(1..=most.clamp(1, movable));
    match rng.random_range(0..3) {
        0 => {
            // Neighbours on the way.
            let first = 1 + rng.random_range(0..=movable - count);
            removed.extend(tour.drain(first..first + count).map(|state| table.cluster_of(state)));
        }
        1 => {
            // Neighbours in joint space, wherever they are on the way.
            let near = tour[1 + rng.random_range(0..movable)];
            let mut by_time: Vec<(f32, usize)> =
                (1..tour.len()).map(|i| (table.time(near, tour[i]), i)).collect();
            by_time.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
            let mut positions: Vec<usize> = by_time.iter().take(count).map(|(_, i)| *i).collect();
            positions.sort_unstable_by(|a, b| b.cmp(a));
            removed.extend(positions.into_iter().map(|i| table.cluster_of(tour.remove(i))));
        }
        _ => {
            for _ in 0..count {
                let position = 1 + rng.random_range(0..tour.len() - 1);
                removed.push(table.cluster_of(tour.remove(position)));
            }
        }
    }
}

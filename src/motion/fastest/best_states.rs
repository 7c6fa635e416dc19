//! The best state of every cluster for a given order: dynamic programming over its layers.

use super::states::StateTable;

/// Sets each entry of `tour` to the state of its cluster on the fastest path that
/// visits the clusters in this order.
pub(super) fn choose_best_states(table: &StateTable, tour: &mut [usize]) {
    let clusters: Vec<usize> = tour.iter().map(|state| table.cluster_of(*state)).collect();
    let Some(first) = clusters.first() else { return };
    let mut cost = vec![0.0f32; table.range(*first).len()];
    let mut parents: Vec<Vec<u32>> = Vec::with_capacity(clusters.len());
    let mut times = Vec::new();
    for pair in clusters.windows(2) {
        let [before, now] = pair else { continue };
        let (from, to) = (table.range(*before), table.range(*now));
        let mut next = vec![f32::INFINITY; to.len()];
        let mut parent = vec![0u32; to.len()];
        // States that cost more than the cheapest plus the way from it to anywhere lead nowhere
        // cheaper; the way to the farthest is only known to the times, so all are looked at.
        for (index, state) in from.enumerate() {
            table.times_into(state, to.clone(), &mut times);
            let so_far = cost[index];
            for ((slot, best), time) in parent.iter_mut().zip(next.iter_mut()).zip(&times) {
                let total = so_far + time;
                if total < *best {
                    *best = total;
                    *slot = index as u32;
                }
            }
        }
        parents.push(parent);
        cost = next;
    }
    let best = cost.iter().enumerate().min_by(|a, b| a.1.total_cmp(b.1));
    let Some((mut at, _)) = best else { return };
    for (position, cluster) in clusters.iter().enumerate().rev() {
        tour[position] = table.range(*cluster).start + at;
        if let Some(parent) = position.checked_sub(1).and_then(|i| parents.get(i)) {
            at = parent[at] as usize;
        }
    }
}

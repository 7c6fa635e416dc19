//! The order of the views, and their states with it, that the arm runs through in the least time.

mod best_states;
mod collisions;
mod insertion;
mod lower_bound;
mod removal;
mod reversal;
mod search;
mod states;

use super::candidates::Candidate;
use super::choice::Layer;
use super::resolve::StartState;
use super::scene::Scene;
use super::sweep::Sweeper;
use collisions::Collisions;
use lower_bound::lower_bound_s;
pub(crate) use search::Effort;
use search::search;
use states::StateTable;

/// A fast order of the views, and what no order can beat.
pub(crate) struct FastestOrder {
    /// Indices into the layers.
    pub order: Vec<usize>,
    /// Seconds that the legs through all layers take at least at full speed, whatever the order
    /// and the choice among the layers' candidates; `None` where there are too many to say.
    pub lower_bound_s: Option<f64>,
}

/// The order that the arm runs through fastest. The first layer stays first unless there is a
/// start state. The order the layers come in is where the search begins.
pub(crate) fn fastest_order(
    scene: &Scene,
    sweeper: &mut Sweeper,
    layers: &[Layer],
    start: Option<&StartState>,
    effort: Effort,
) -> FastestOrder {
    if layers.is_empty() {
        return FastestOrder { order: Vec::new(), lower_bound_s: None };
    }
    let from_start = start.map(|s| [Candidate { joints: s.joints, roll_rad: 0.0 }]);
    let clusters =
        from_start.iter().map(|s| s.as_slice()).chain(layers.iter().map(|l| l.candidates.as_slice()));
    let table = StateTable::new(&scene.cell.robot.joints, effort.jerk_limited, clusters);
    let first_tour: Vec<usize> = (0..table.clusters()).map(|c| table.range(c).start).collect();
    let relief_m = start.map_or(0.0, |s| s.relief_m);
    let start_state = if start.is_some() { 0 } else { usize::MAX };
    let mut collisions = Collisions::new(scene, sweeper, start_state, relief_m);
    let tour = search(&table, &mut collisions, first_tour, effort);
    let skip = usize::from(start.is_some());
    let order = tour.iter().filter_map(|state| table.cluster_of(*state).checked_sub(skip)).collect();
    FastestOrder { order, lower_bound_s: lower_bound_s(&table) }
}

#[cfg(test)]
mod tests;

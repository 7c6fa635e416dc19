//! The part of a band that an arm can reach, direction by direction.

use super::asks::Asks;
use crate::geometry::{Direction, Pose};
use crate::motion::{KnownState, Probe, Reach};
use crate::views::{Lattice, ViewSpace};

/// Directions asked for, beside the top and the rims.
const DIRECTIONS: usize = 1200;
/// Of arms whose inverse kinematics are searched for: directions a view, and at least.
const DIRECTIONS_A_VIEW: usize = 12;
const FEWEST: usize = 150;
/// Part of the work left that full searches may take there.
const SEARCHES: f64 = 0.25;
/// Reached directions nearby whose states are tried for one more.
const NEIGHBOURS: usize = 3;
/// Directions whose neighbours are looked for among those before.
const BLOCK: usize = 48;

/// The band, asked direction by direction.
pub(super) struct Survey {
    pub(super) lattice: Lattice,
    pub(super) usable: Vec<bool>,
    /// Reachable part of the band's area.
    pub(super) fraction: f64,
    /// Of arms whose inverse kinematics are searched for: the states found, by direction.
    pub(super) states: Vec<(Direction, KnownState)>,
}

impl Survey {
    /// Asks for a lattice fine enough for `views` views.
    pub(super) fn ask(reach: &Reach, space: &ViewSpace, views: usize, asks: &mut Asks) -> Survey {
        if reach.is_quick() {
            let lattice = Lattice::new(space.band, DIRECTIONS);
            let answers = asks.ask(&poses(space, &lattice.directions), |probe, pose| probe.reaches(pose));
            let usable = answers.into_iter().map(|answer| answer == Some(true)).collect();
            return Survey::new(lattice, usable, Vec::new());
        }
        let lattice = Lattice::new(space.band, (DIRECTIONS_A_VIEW * views).clamp(FEWEST, DIRECTIONS));
        let order = farthest_first(&lattice.directions);
        let searches = SEARCHES * asks.left.most as f64 / reach.usual_work().max(1) as f64;
        let searched = (searches as usize).max(FEWEST).min(order.len());
        let (first, rest) = order.split_at(searched);
        let mut usable = vec![false; lattice.directions.len()];
        let mut states: Vec<(Direction, KnownState)> = Vec::new();
        let mut learn = |indices: &[usize], found: Vec<Option<KnownState>>, states: &mut Vec<_>| {
            for (index, state) in indices.iter().zip(found) {
                let direction = lattice.directions.get(*index);
                if let (Some(slot), Some(direction), Some(state)) = (usable.get_mut(*index), direction, state)
                {
                    *slot = true;
                    states.push((*direction, state));
                }
            }
        };
        let poses_of = |indices: &[usize]| -> Vec<Pose> {
            let at = indices.iter().filter_map(|index| lattice.directions.get(*index));
            at.map(|direction| space.pose(direction, 0.0)).collect()
        };
        // Neighbours first: most directions between those that were searched for follow from them.
        for block in first.chunks(BLOCK) {
            let found = asks.ask(&poses_of(block), |probe, pose| {
                from_neighbours(probe, space, pose, &states).or_else(|| probe.state(pose))
            });
            learn(block, found.into_iter().map(Option::flatten).collect(), &mut states);
        }
        for block in rest.chunks(BLOCK) {
            let found =
                asks.ask(&poses_of(block), |probe, pose| from_neighbours(probe, space, pose, &states));
            learn(block, found.into_iter().map(Option::flatten).collect(), &mut states);
        }
        Survey::new(lattice, usable, states)
    }

    fn new(lattice: Lattice, usable: Vec<bool>, states: Vec<(Direction, KnownState)>) -> Survey {
        let fraction = lattice.usable_share(&usable);
        Survey { lattice, usable, fraction, states }
    }

    /// The state known for exactly this direction.
    pub(super) fn state(&self, direction: &Direction) -> Option<&KnownState> {
        self.states.iter().find(|(known, _)| known == direction).map(|(_, state)| state)
    }
}

/// A state for `pose` next to one of those known nearby.
pub(super) fn from_neighbours(
    probe: &mut Probe,
    space: &ViewSpace,
    pose: &Pose,
    states: &[(Direction, KnownState)],
) -> Option<KnownState> {
    let toward = (pose.translation.vector - space.center_in_base.coords).normalize();
    let mut nearest: Vec<(f64, usize)> =
        states.iter().enumerate().map(|(index, (at, _))| (-at.dot(&toward), index)).collect();
    let nearer = |a: &(f64, usize), b: &(f64, usize)| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1));
    if nearest.len() > NEIGHBOURS {
        nearest.select_nth_unstable_by(NEIGHBOURS, nearer);
        nearest.truncate(NEIGHBOURS);
    }
    nearest.sort_by(nearer);
    nearest
        .iter()
        .filter_map(|(_, index)| states.get(*index))
        .find_map(|(_, known)| probe.state_from(pose, known))
}

fn poses(space: &ViewSpace, directions: &[Direction]) -> Vec<Pose> {
    directions.iter().map(|direction| space.pose(direction, 0.0)).collect()
}

/// Indices of `directions` in an order whose beginnings are spread evenly: each is farthest from
/// those before it.
fn farthest_first(directions: &[Direction]) -> Vec<usize> {
    let mut nearest = vec![f64::INFINITY; directions.len()];
    let mut order = Vec::with_capacity(directions.len());
    let mut next = 0;
    while let (Some(at), true) = (directions.get(next), order.len() < directions.len()) {
        order.push(next);
        let (mut farthest, mut index) = (-1.0, usize::MAX);
        for (i, (slot, direction)) in nearest.iter_mut().zip(directions).enumerate() {
            *slot = slot.min((direction.into_inner() - at.into_inner()).norm_squared());
            if i == next {
                // Taken: farther from everything than anything is, but never again.
                *slot = -2.0;
            }
            if *slot > farthest {
                (farthest, index) = (*slot, i);
            }
        }
        next = index;
    }
    order
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::views::Band;

    #[test]
    fn every_direction_comes_once_and_the_first_ones_cover_the_band() {
        let lattice = Lattice::new(Band::DEFAULT, 400);
        let order = farthest_first(&lattice.directions);
        let mut sorted = order.clone();
        sorted.sort_unstable();
        assert_eq!(sorted, (0..lattice.directions.len()).collect::<Vec<_>>());
        let first: Vec<Direction> = order[..100].iter().map(|i| lattice.directions[*i]).collect();
        let hole_rad = crate::views::covering_radius_rad(&first, Band::DEFAULT);
        assert!(hole_rad < 2.5 * lattice.spacing_rad, "{hole_rad} {}", lattice.spacing_rad);
    }
}

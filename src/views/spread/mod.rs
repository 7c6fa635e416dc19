//! Views on the part of a band that can be used: packing under a predicate.
//!
//! A dense lattice of the band is asked once, direction by direction. Sets of usable lattice
//! directions are ordered under a repulsion of growing exponent ([`settle`]), their tightest views
//! moved to the largest holes ([`exchange`]), and the best few sets moved off the lattice, each
//! move asking anew ([`polish`]).

mod asker;
mod exchange;
mod lattice;
mod polish;
mod repulsion;
mod settle;

pub use lattice::Lattice;

use rand::Rng;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

use crate::geometry::{Direction, Vector};

/// Least and largest number of sets ordered on the lattice.
const STARTS: std::ops::Range<u64> = 3..24;
/// Views are not packed closer than this many spacings of the lattice.
const CLOSEST: f64 = 0.5;
/// Repulsions between pairs after which no further set is begun.
const WORK: u64 = 12_000_000;
/// The best of them that are moved off it.
const POLISHED: usize = 3;

/// `count` directions of the lattice's band as far apart as we can place them where `usable_at`
/// holds; fewer where the usable directions have no room for them at half the lattice's spacing.
///
/// `usable` is the predicate on the lattice, direction by direction. The first direction is the
/// band's top where it is usable, else the highest usable direction of the lattice. Every other
/// one that is returned is a direction of the lattice or has been asked for through `usable_at`.
/// `most_asked` bounds how often the moves off the lattice ask, beside a last time for each view
/// that moved: with little of it, views stay nearer to the lattice. Deterministic, as far as the
/// predicate is.
pub fn spread(
    count: usize,
    lattice: &Lattice,
    usable: &[bool],
    most_asked: usize,
    usable_at: &mut dyn FnMut(&Direction) -> bool,
) -> Vec<Direction> {
    let spots: Vec<Vector> = lattice
        .directions
        .iter()
        .zip(usable)
        .filter(|(_, usable)| **usable)
        .map(|(d, _)| d.into_inner())
        .collect();
    // The lattice begins with the top.
    let fixed = match usable.first() {
        Some(true) => 0,
        _ => highest(&spots),
    };
    let directions = |points: &[Vector]| -> Vec<Direction> {
        points.iter().map(|point| Direction::new_normalize(*point)).collect()
    };
    if spots.is_empty() || count == 0 {
        return Vec::new();
    }
    let least = (CLOSEST * lattice.spacing_rad).powi(2);
    let first = begin(&spots, fixed, count, 0, least, &mut ChaCha8Rng::seed_from_u64(0));
    if first.len() < count {
        return directions(&first.iter().map(|spot| spots[*spot]).collect::<Vec<_>>());
    }
    let mut ground = settle::Ground::new(spots, lattice.spacing_rad);
    let mut sets: Vec<(f64, Vec<usize>)> = Vec::new();
    for start in 0..STARTS.end {
        if start >= STARTS.start && ground.work > WORK {
            break;
        }
        let mut rng = ChaCha8Rng::seed_from_u64(start);
        let begin = begin(&ground.spots, fixed, count, start, 0.0, &mut rng);
        let mut set = settle::settle(&mut ground, begin, false);
        exchange::exchange(&mut ground, &mut set);
        let square = exchange::least_square(&ground.spots, &set);
        if sets.iter().all(|(known, _)| (known - square).abs() > 1e-12) {
            sets.push((square, set));
        }
    }
    sets.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut asker = asker::Asker::new(lattice, usable, most_asked, usable_at);
    let mut best: Option<(f64, Vec<Vector>)> = None;
    for (_, set) in sets.iter().take(POLISHED) {
        let spots: Vec<Vector> = set.iter().filter_map(|spot| ground.spots.get(*spot).copied()).collect();
        let found = polish::polish(spots, lattice, &mut asker);
        let square = repulsion::least_squared_distance(&found);
        if best.as_ref().is_none_or(|(known, _)| square > *known) {
            best = Some((square, found));
        }
    }
    let mut found = directions(&best.map(|(_, found)| found).unwrap_or_default());
    // A view may have moved above the highest spot.
    if let Some(free) = found.get_mut(usize::from(usable.first() == Some(&true))..) {
        free.sort_by(|a, b| b.z.total_cmp(&a.z).then(a.x.total_cmp(&b.x)).then(a.y.total_cmp(&b.y)));
    }
    found
}

fn highest(spots: &[Vector]) -> usize {
    let by_height = spots.iter().enumerate().max_by(|a, b| a.1.z.total_cmp(&b.1.z).then(b.0.cmp(&a.0)));
    by_height.map_or(0, |(index, _)| index)
}

/// A set to start from: each spot farthest from those before it, until there is none farther than
/// the root of `least`; in all but the first start some are drawn instead.
fn begin(
    spots: &[Vector],
    fixed: usize,
    count: usize,
    start: u64,
    least: f64,
    rng: &mut impl Rng,
) -> Vec<usize> {
    let drawn = match start {
        0 => 0,
        _ if start.is_multiple_of(2) => count,
        _ => 1 + start as usize / 2,
    };
    let mut set = vec![fixed];
    let mut nearest: Vec<f64> = spots.iter().map(|spot| (spot - spots[fixed]).norm_squared()).collect();
    while set.len() < count {
        let farthest = exchange::farthest(&nearest);
        if !(nearest[farthest] > least) {
            break;
        }
        let draw = rng.random_range(0..spots.len());
        // Two views on one spot repel each other without end.
        let next = if set.len() <= drawn && nearest[draw] > 0.0 { draw } else { farthest };
        set.push(next);
        for (square, spot) in nearest.iter_mut().zip(spots) {
            *square = square.min((spot - spots[next]).norm_squared());
        }
    }
    set
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::views::{Band, separation_rad, tammes};
    use proptest::prelude::*;

    fn asked(lattice: &Lattice, holds: impl Fn(&Direction) -> bool) -> Vec<bool> {
        lattice.directions.iter().map(holds).collect()
    }

    #[test]
    fn where_everything_is_usable_the_set_is_nearly_as_good_as_the_table() {
        for count in [5, 12, 20, 35, 58, 100] {
            let lattice = Lattice::new(Band::DEFAULT, 1500);
            let found = spread(count, &lattice, &asked(&lattice, |_| true), usize::MAX, &mut |_| true);
            let best_rad = tammes(count, Band::DEFAULT).unwrap().separation_rad;
            let share = separation_rad(&found) / best_rad;
            assert_eq!((found.len(), found[0].z), (count, 1.0));
            assert!(share > 0.95, "{count}: {share}");
            assert!(found.iter().all(|direction| Band::DEFAULT.contains(direction, 1e-9)));
        }
    }

    #[test]
    fn without_the_top_the_highest_usable_direction_comes_first() {
        let lattice = Lattice::new(Band::DEFAULT, 800);
        let low = |direction: &Direction| direction.z < 0.7;
        let found = spread(15, &lattice, &asked(&lattice, low), usize::MAX, &mut |direction| low(direction));
        assert_eq!(found.len(), 15);
        assert!(found.iter().all(low));
        assert!(found[1..].iter().all(|direction| direction.z <= found[0].z + 1e-9) && found[0].z > 0.65);
    }

    #[test]
    fn fewer_usable_directions_than_asked_for_are_all_given() {
        let lattice = Lattice::new(Band::DEFAULT, 400);
        let cap = |direction: &Direction| direction.x > 0.97;
        let usable = asked(&lattice, cap);
        let count = usable.iter().filter(|usable| **usable).count();
        assert!(count > 0 && count < 50, "{count}");
        let found = spread(50, &lattice, &usable, usize::MAX, &mut |direction| cap(direction));
        assert!(found.len() <= count && 2 * found.len() > count, "{} of {count}", found.len());
        assert!(separation_rad(&found) > 0.45 * lattice.spacing_rad);
        assert!(spread(50, &lattice, &asked(&lattice, |_| false), usize::MAX, &mut |_| false).is_empty());
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(24))]

        #[test]
        fn every_view_is_usable_and_the_same_question_has_the_same_answer(
            x in -1.0..1.0f64, y in -1.0..1.0f64, level in -0.3..0.6f64, count in 1usize..40,
            most_asked in 0usize..3000,
        ) {
            let band = Band::from_degrees(0.0, 80.0).unwrap();
            let lattice = Lattice::new(band, 500);
            let holds = |d: &Direction| d.x * x + d.y * y < level;
            let usable = asked(&lattice, holds);
            let found = spread(count, &lattice, &usable, most_asked, &mut |direction| holds(direction));
            prop_assert!(found.iter().all(|direction| holds(direction) && band.contains(direction, 1e-9)));
            let exist = usable.iter().filter(|usable| **usable).count();
            // Not `>`: where nothing is usable, finding nothing is all there is to find.
            prop_assert!(found.len() == count || 3 * found.len() >= exist, "{} of {exist}", found.len());
            let again = spread(count, &lattice, &usable, most_asked, &mut |direction| holds(direction));
            prop_assert_eq!(found, again);
        }
    }
}

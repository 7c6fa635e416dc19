//! Asks the predicate only where its answer is in doubt.

use super::Lattice;
use crate::geometry::{Direction, Vector};

/// Lattice directions this many spacings around are looked at.
const AROUND: f64 = 2.0;

/// A predicate with what is known about it on the lattice.
pub(super) struct Asker<'a> {
    lattice: &'a Lattice,
    /// For each direction of the lattice's spiral: it is usable, and so is everything around it.
    inside: Vec<bool>,
    /// How often moves may still ask.
    left: usize,
    usable_at: &'a mut dyn FnMut(&Direction) -> bool,
}

impl<'a> Asker<'a> {
    pub(super) fn new(
        lattice: &'a Lattice,
        usable: &[bool],
        most_asked: usize,
        usable_at: &'a mut dyn FnMut(&Direction) -> bool,
    ) -> Self {
        let near = (AROUND * lattice.spacing_rad).powi(2);
        let barred: Vec<Vector> = (lattice.directions.iter().zip(usable))
            .filter(|(_, usable)| !**usable)
            .map(|(direction, _)| direction.into_inner())
            .collect();
        let spiral = lattice.directions.iter().skip(1).take(lattice.equal_areas);
        let inside =
            spiral.map(|d| barred.iter().all(|b| (b - d.into_inner()).norm_squared() > near)).collect();
        Self { lattice, inside, left: most_asked, usable_at }
    }

    /// Whether `place` is usable, or likely to be since everything around it is.
    pub(super) fn is_likely(&mut self, place: &Vector) -> bool {
        self.is_inside(place) || self.may_move_to(place)
    }

    /// Whether `place` is usable, as long as moves may ask.
    pub(super) fn may_move_to(&mut self, place: &Vector) -> bool {
        if self.left == 0 {
            return false;
        }
        self.left -= 1;
        self.is_usable(place)
    }

    /// Whether `place` is usable.
    pub(super) fn is_usable(&mut self, place: &Vector) -> bool {
        (self.usable_at)(&Direction::new_normalize(*place))
    }

    fn is_inside(&self, place: &Vector) -> bool {
        // The spiral goes down evenly: only a window of it can be near.
        let (low, high) = self.lattice.band.heights();
        let count = self.lattice.equal_areas as f64;
        let spacing_rad = self.lattice.spacing_rad;
        let reach = spacing_rad * (place.x.hypot(place.y) + spacing_rad);
        let index = |z: f64| ((high - z) / (high - low).max(1e-12) * count).clamp(0.0, count) as usize;
        let window = index(place.z + reach)..index(place.z - reach) + 1;
        let square = |index: &usize| match self.lattice.directions.get(index + 1) {
            Some(direction) => (direction.into_inner() - place).norm_squared(),
            None => f64::INFINITY,
        };
        let nearest = window.min_by(|a, b| square(a).total_cmp(&square(b)));
        nearest.and_then(|index| self.inside.get(index)).copied().unwrap_or(false)
    }
}

//! Time-optimal motion along a joint path with curvature, from rest to rest.
//!
//! Reachability analysis on a grid over the path (Pham and Pham 2018): with
//! `x` the squared path speed and `u` the path acceleration, constant between
//! grid points, every acceleration limit is linear in `(u, x)`. A backward
//! pass finds the largest `x` from which the rest can still be driven, a
//! forward pass drives as fast as that allows.

use super::joints::Joints;
use super::rounded::Piece;

/// Longest cell of the grid, radians in joint space.
const CELL_RAD: f64 = 0.02;
/// Cells of a piece: at least, at most.
const CELLS: (usize, usize) = (16, 160);
/// Share of the limits that is used: what is left covers rounding.
const USED_SHARE: f64 = 0.9995;

/// A part of the path with constant path acceleration.
#[derive(Clone, Copy, Debug)]
struct Cell {
    piece: usize,
    s0: f64,
    ds: f64,
    /// Path speed at the beginning, path acceleration, duration.
    speed: f64,
    acceleration: f64,
    duration_s: f64,
}

/// A timed path.
#[derive(Clone, Debug)]
pub(crate) struct AlongPath {
    pieces: Vec<Piece>,
    cells: Vec<Cell>,
    /// Beginning of each cell, seconds.
    begins_s: Vec<f64>,
    duration_s: f64,
}

/// The linear bounds `|c u + d x| <= limit` of one cell.
struct Bounds<'a> {
    piece: &'a Piece,
    start: Joints,
    end: Joints,
    ds: f64,
    max_acceleration: &'a Joints,
}

impl AlongPath {
    /// The fastest motion along `pieces` within the speed and acceleration bounds.
    pub fn new(pieces: Vec<Piece>, max_speed: &Joints, max_acceleration: &Joints) -> Self {
        let (speed, acceleration) =
            (max_speed.map(|v| v * USED_SHARE), max_acceleration.map(|a| a * USED_SHARE));
        let mut cells = Vec::new();
        for (index, piece) in pieces.iter().enumerate() {
            let count = ((piece.length / CELL_RAD).ceil() as usize).clamp(CELLS.0, CELLS.1);
            let ds = piece.length / count as f64;
            cells.extend((0..count).map(|i| Cell {
                piece: index,
                s0: ds * i as f64,
                ds,
                speed: 0.0,
                acceleration: 0.0,
                duration_s: 0.0,
            }));
        }
        drive(&pieces, &mut cells, &speed, &acceleration);
        let mut timed = Self { pieces, cells, begins_s: Vec::new(), duration_s: 0.0 };
        let mut now = 0.0;
        timed.begins_s = timed
            .cells
            .iter()
            .map(|cell| {
                let begin = now;
                now += cell.duration_s;
                begin
            })
            .collect();
        timed.duration_s = now;
        timed
    }

    /// Seconds from rest to rest.
    pub fn duration_s(&self) -> f64 {
        self.duration_s
    }

    /// Position, velocity and acceleration at `t_s`.
    pub fn at(&self, t_s: f64) -> (Joints, Joints, Joints) {
        let index = self.begins_s.partition_point(|begin| *begin <= t_s).saturating_sub(1);
        match (self.cells.get(index), self.begins_s.get(index)) {
            (Some(cell), Some(begin)) => self.in_cell(cell, (t_s - begin).clamp(0.0, cell.duration_s)),
            _ => ([0.0; 8], [0.0; 8], [0.0; 8]),
        }
    }

    fn in_cell(&self, cell: &Cell, t: f64) -> (Joints, Joints, Joints) {
        let Some(piece) = self.pieces.get(cell.piece) else { return ([0.0; 8], [0.0; 8], [0.0; 8]) };
        let s = (cell.s0 + t * (cell.speed + 0.5 * t * cell.acceleration)).clamp(cell.s0, cell.s0 + cell.ds);
        let speed = (cell.speed + cell.acceleration * t).max(0.0);
        let (q, first, second) = piece.at(s);
        let velocity = first.map(|d| d * speed);
        let acceleration = std::array::from_fn(|j| first[j] * cell.acceleration + second[j] * speed * speed);
        (q, velocity, acceleration)
    }
}

/// Both passes: sets speed, acceleration and duration of every cell.
fn drive(pieces: &[Piece], cells: &mut [Cell], max_speed: &Joints, max_acceleration: &Joints) {
    let bounds: Vec<(Bounds, f64)> = cells
        .iter()
        .filter_map(|cell| {
            let piece = pieces.get(cell.piece)?;
            let (start, end) = (piece.at(cell.s0).1, piece.at(cell.s0 + cell.ds).1);
            // Derivative and squared speed are linear over the cell: bounding both ends by the
            // larger derivative bounds everything between.
            let steepest = start.iter().zip(&end).map(|(a, b)| a.abs().max(b.abs()));
            let ratios = steepest.zip(max_speed).filter(|(d, _)| *d > 1e-12).map(|(d, v)| v / d);
            let fastest = ratios.fold(f64::INFINITY, f64::min).powi(2);
            Some((Bounds { piece, start, end, ds: cell.ds, max_acceleration }, fastest))
        })
        .collect();
    // largest[i]: largest squared speed at the beginning of cell i from which the end can be reached at rest.
    let mut largest = vec![0.0f64; bounds.len() + 1];
    for (i, (bound, fastest)) in bounds.iter().enumerate().rev() {
        largest[i + 1] = largest[i + 1].min(*fastest);
        largest[i] = bound.largest_start(fastest.min(1e9), largest[i + 1]);
    }
    let mut x = 0.0f64;
    for (i, (cell, (bound, _))) in cells.iter_mut().zip(&bounds).enumerate() {
        let next = largest[i + 1];
        let (least, most) = bound.accelerations(x, next);
        let u = most.max(least);
        let x_next = (x + 2.0 * cell.ds * u).clamp(0.0, next);
        let (v0, v1) = (x.sqrt(), x_next.sqrt());
        cell.speed = v0;
        cell.duration_s = if v0 + v1 > 0.0 { 2.0 * cell.ds / (v0 + v1) } else { 0.0 };
        cell.acceleration = if cell.duration_s > 0.0 { (v1 - v0) / cell.duration_s } else { 0.0 };
        x = x_next;
    }
}

impl Bounds<'_> {
    /// Path accelerations allowed at squared speed `x` that lead to a squared speed within `[0, next]`.
    fn accelerations(&self, x: f64, next: f64) -> (f64, f64) {
        let (mut least, mut most) = (-x / (2.0 * self.ds), (next - x) / (2.0 * self.ds));
        for j in 0..self.start.len() {
            let curve = self.piece.second[j];
            for slope in [self.start[j], self.end[j] + 2.0 * self.ds * curve] {
                let (limit, rest) = (self.max_acceleration[j], curve * x);
                if slope.abs() < 1e-12 {
                    if rest.abs() > limit {
                        return (1.0, 0.0);
                    }
                    continue;
                }
                let (a, b) = ((-limit - rest) / slope, (limit - rest) / slope);
                least = least.max(a.min(b));
                most = most.min(a.max(b));
            }
        }
        (least, most)
    }

    /// The largest squared speed up to `bound` that has an allowed acceleration. 0 always has one.
    fn largest_start(&self, bound: f64, next: f64) -> f64 {
        let allowed = |x: f64| {
            let (least, most) = self.accelerations(x, next);
            least <= most
        };
        if allowed(bound) {
            return bound;
        }
        let (mut low, mut high) = (0.0, bound);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if allowed(middle) { low = middle } else { high = middle }
        }
        low
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::motion::joints::{difference, lerp, norm};
    use crate::motion::trapezoid::Trapezoid;
    use proptest::prelude::*;

    /// The path through `waypoints` with every corner rounded over `share` of its shorter side.
    fn pieces(waypoints: &[Joints], share: f64) -> Vec<Piece> {
        let mut at = waypoints[0];
        let mut pieces = Vec::new();
        for triple in waypoints.windows(3) {
            let (length_in, length_out) =
                (norm(&difference(&triple[0], &triple[1])), norm(&difference(&triple[1], &triple[2])));
            let reach = share * length_in.min(length_out);
            let a = lerp(&triple[1], &triple[0], reach / length_in);
            let b = lerp(&triple[1], &triple[2], reach / length_out);
            pieces.extend(Piece::line(&at, &a));
            pieces.push(Piece::corner(&a, &triple[1], &b, reach));
            at = b;
        }
        pieces.extend(Piece::line(&at, &waypoints[waypoints.len() - 1]));
        pieces
    }

    fn waypoint() -> impl Strategy<Value = Joints> {
        proptest::array::uniform6(-1.5..1.5f64).prop_map(|q| crate::motion::joints::joints_from(&q))
    }

    proptest! {
        #[test]
        fn a_rounded_path_keeps_its_limits_and_beats_stopping_at_corners(
            waypoints in proptest::collection::vec(waypoint(), 3..6), share in 0.05..0.45f64, v in 0.5..4.0f64, a in 1.0..15.0f64,
        ) {
            let (speed, acceleration) = ([v; 8], [a; 8]);
            let path = AlongPath::new(pieces(&waypoints, share), &speed, &acceleration);
            let n = 2000;
            let h = path.duration_s() / f64::from(n);
            let mut last = path.at(0.0);
            prop_assert!(norm(&difference(&last.0, &waypoints[0])) < 1e-9 && norm(&last.1) < 1e-9);
            for i in 1..=n {
                let now = path.at(h * f64::from(i));
                for j in 0..6 {
                    prop_assert!((now.0[j] - last.0[j]).abs() <= v * h * (1.0 + 1e-6) + 1e-12);
                    prop_assert!((now.1[j] - last.1[j]).abs() <= a * h * (1.0 + 1e-6) + 1e-9);
                }
                last = now;
            }
            let end = waypoints[waypoints.len() - 1];
            prop_assert!(norm(&difference(&last.0, &end)) < 1e-6 && norm(&last.1) < 1e-3);
            let stopping: f64 = waypoints
                .windows(2)
                .map(|w| Trapezoid::new(&difference(&w[0], &w[1]), &speed, &acceleration).duration_s())
                .sum();
            prop_assert!(path.duration_s() < stopping * 1.01, "{} {}", path.duration_s(), stopping);
        }
    }
}

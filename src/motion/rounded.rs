//! Joint paths with rounded corners: lines joined by parabolas.

use super::joints::{Joints, difference, lerp, norm};
use super::scene::Scene;
use super::sweep::Sweeper;

/// Share of the shorter neighbour of a corner that its rounding may take.
const LARGEST_SHARE: f64 = 0.45;
/// How often a rounding that collides is halved before the arm stops at the corner instead.
const HALVINGS: usize = 6;
/// Cosine of the turn beyond which the arm stops: it nearly goes back where it came from.
const REVERSAL: f64 = -0.95;
/// Chords by which a rounding is checked.
const CHORDS: usize = 6;

/// A piece of a path, parametrised so that the path's derivative is continuous.
///
/// `q(s) = start + s first + s^2/2 second` for `s` in `[0, length]`; `first`
/// has unit length at the ends of every piece.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Piece {
    pub start: Joints,
    pub first: Joints,
    pub second: Joints,
    pub length: f64,
}

impl Piece {
    /// Position, first and second derivative at `s`.
    pub fn at(&self, s: f64) -> (Joints, Joints, Joints) {
        let position =
            std::array::from_fn(|j| self.start[j] + s * (self.first[j] + 0.5 * s * self.second[j]));
        let first = std::array::from_fn(|j| self.first[j] + s * self.second[j]);
        (position, first, self.second)
    }

    /// The straight piece; `None` for one without length.
    pub fn line(from: &Joints, to: &Joints) -> Option<Self> {
        let step = difference(from, to);
        let length = norm(&step);
        (length > 1e-9).then(|| Self {
            start: *from,
            first: step.map(|d| d / length),
            second: [0.0; 8],
            length,
        })
    }

    /// The parabola from `a` towards `corner` and on to `b`; both at distance `reach` from the corner.
    pub fn corner(a: &Joints, corner: &Joints, b: &Joints, reach: f64) -> Self {
        let first = difference(a, corner).map(|d| d / reach);
        let last = difference(corner, b).map(|d| d / reach);
        let length = 2.0 * reach;
        Self { start: *a, first, second: std::array::from_fn(|j| (last[j] - first[j]) / length), length }
    }
}

/// Parts of a path from rest to rest: cut where a corner cannot be rounded.
/// Roundings are checked for collisions, with margins less by `relief_m`.
pub(crate) fn rounded(
    scene: &Scene,
    sweeper: &mut Sweeper,
    waypoints: &[Joints],
    relief_m: f64,
) -> Vec<Vec<Piece>> {
    let mut parts: Vec<Vec<Piece>> = Vec::new();
    let mut pieces: Vec<Piece> = Vec::new();
    let Some(mut at) = waypoints.first().copied() else { return parts };
    for triple in waypoints.windows(3) {
        let [before, corner, after] = triple else { continue };
        match rounding(scene, sweeper, before, corner, after, relief_m) {
            Some((a, piece, b)) => {
                pieces.extend(Piece::line(&at, &a));
                pieces.push(piece);
                at = b;
            }
            None => {
                pieces.extend(Piece::line(&at, corner));
                parts.push(std::mem::take(&mut pieces));
                at = *corner;
            }
        }
    }
    if let Some(end) = waypoints.last() {
        pieces.extend(Piece::line(&at, end));
    }
    parts.push(pieces);
    parts.retain(|part| !part.is_empty());
    parts
}

fn rounding(
    scene: &Scene,
    sweeper: &mut Sweeper,
    before: &Joints,
    corner: &Joints,
    after: &Joints,
    relief_m: f64,
) -> Option<(Joints, Piece, Joints)> {
    let (inward, outward) = (difference(before, corner), difference(corner, after));
    let (length_in, length_out) = (norm(&inward), norm(&outward));
    let cosine = inward.iter().zip(&outward).map(|(a, b)| a * b).sum::<f64>() / (length_in * length_out);
    // A NaN from a repeated waypoint is no turn to round.
    if cosine.is_nan() || cosine <= REVERSAL {
        return None;
    }
    let mut reach = LARGEST_SHARE * length_in.min(length_out);
    for _ in 0..HALVINGS {
        let a = lerp(corner, before, reach / length_in);
        let b = lerp(corner, after, reach / length_out);
        let piece = Piece::corner(&a, corner, &b, reach);
        if is_free(scene, sweeper, &piece, relief_m) {
            return Some((a, piece, b));
        }
        reach *= 0.5;
    }
    None
}

fn is_free(scene: &Scene, sweeper: &mut Sweeper, piece: &Piece, relief_m: f64) -> bool {
    // A parabola strays from a chord over ds by at most |q''| ds^2 / 8.
    let ds = piece.length / CHORDS as f64;
    let deviation = piece.second.map(|c| c.abs() * ds * ds / 8.0);
    (0..CHORDS).all(|i| {
        let (from, to) = (piece.at(i as f64 * ds).0, piece.at((i + 1) as f64 * ds).0);
        sweeper.is_free(scene, &from, &to, &deviation, relief_m)
    })
}

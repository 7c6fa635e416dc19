//! The shortest curve between two points around a ball and above a table.
//!
//! Let `q` be the point of the segment nearest to the ball's centre and `d` its distance from
//! it. If the segment misses the ball it is the curve. If not, consider the planes through the
//! segment. Each cuts the ball in a disc; on either side of the segment a tangent, an arc of the
//! disc and another tangent lead from one end to the other. The plane through the centre has the
//! largest disc, whose short way round is the shortest curve outside the ball (the geodesic).
//!
//! Its arc may dip below the table although both ends are above it: when they are below the
//! centre's height, or the centre is below the table. The plane is then turned about the segment,
//! the short way towards the plane on whose upper side the curve runs entirely above its lower
//! end, just as far as the arc clears the table. That is the shortest such planar curve, not
//! always the shortest of all: the latter would follow the circle in which the ball meets the
//! table.

use super::Obstacle;
use super::obstacle::TOUCH_M;
use crate::geometry::{Point, Vector};

/// Halvings of the turn when the arc must clear the table: 2^-48 of half a turn.
const HALVINGS: usize = 48;

/// A curve between two points: a segment, or tangent, arc, tangent.
#[derive(Debug, Clone, PartialEq)]
pub struct LocalPath {
    from: Point,
    to: Point,
    around: Option<Arc>,
}

/// The part of a curve that lies on the ball.
#[derive(Debug, Clone, PartialEq)]
struct Arc {
    center: Point,
    /// Unit vector along the segment, angle 0.
    along: Vector,
    /// Unit vector away from the segment on the curve's side, a right angle from `along`.
    aside: Vector,
    radius_m: f64,
    /// Angles of the tangent points; the arc runs downwards from the first to the second.
    begin_rad: f64,
    end_rad: f64,
}

impl LocalPath {
    /// The curve from `from` to `to`, both outside the obstacle (see [`Obstacle::check`]).
    pub fn between(from: Point, to: Point, obstacle: &Obstacle) -> LocalPath {
        LocalPath { from, to, around: arc_around(from, to, obstacle) }
    }

    /// Its length, metres.
    pub fn length_m(&self) -> f64 {
        match &self.around {
            None => (self.to - self.from).norm(),
            Some(arc) => {
                (arc.at(arc.begin_rad) - self.from).norm()
                    + arc.length_m()
                    + (self.to - arc.at(arc.end_rad)).norm()
            }
        }
    }

    /// Whether the curve is the segment itself.
    pub fn is_straight(&self) -> bool {
        self.around.is_none()
    }

    /// Points along the curve, both ends included, neighbours at most `step_m` apart along each
    /// piece (the chords of an arc are shorter still, and cut up to `step_m^2 / (8 radius)` into
    /// the ball). A step that is not positive, or so small that it would need more than a
    /// million points, is enlarged.
    pub fn sample(&self, step_m: f64) -> Vec<Point> {
        let length_m = self.length_m();
        let step_m = if step_m > 0.0 { step_m.max(length_m * 1e-6) } else { length_m };
        let mut points = vec![self.from];
        match &self.around {
            None => extend_straight(&mut points, self.from, self.to, step_m),
            Some(arc) => {
                let (begin, end) = (arc.at(arc.begin_rad), arc.at(arc.end_rad));
                extend_straight(&mut points, self.from, begin, step_m);
                let steps = steps(arc.length_m(), step_m);
                for k in 1..=steps {
                    let share = k as f64 / steps as f64;
                    points.push(arc.at(arc.begin_rad + share * (arc.end_rad - arc.begin_rad)));
                }
                extend_straight(&mut points, end, self.to, step_m);
            }
        }
        points
    }
}

impl Arc {
    fn at(&self, angle_rad: f64) -> Point {
        let (sin, cos) = angle_rad.sin_cos();
        self.center + (self.along * cos + self.aside * sin) * self.radius_m
    }

    fn length_m(&self) -> f64 {
        self.radius_m * (self.begin_rad - self.end_rad)
    }

    fn lowest_z(&self) -> f64 {
        let (begin, end) = (self.at(self.begin_rad).z, self.at(self.end_rad).z);
        // The circle's lowest point, if the arc passes through it.
        let bottom = (-self.aside.z).atan2(-self.along.z);
        let turn = std::f64::consts::TAU;
        let passes = [bottom - turn, bottom, bottom + turn]
            .iter()
            .any(|angle| (self.end_rad..=self.begin_rad).contains(angle));
        if passes { self.at(bottom).z } else { begin.min(end) }
    }
}

fn arc_around(from: Point, to: Point, obstacle: &Obstacle) -> Option<Arc> {
    let chord = to - from;
    let length = chord.norm();
    if length < TOUCH_M {
        return None;
    }
    let along = chord / length;
    let nearest = (obstacle.center - from).dot(&along);
    if nearest <= 0.0 || nearest >= length {
        return None;
    }
    let foot = from + along * nearest;
    let outward = foot - obstacle.center;
    let offset = outward.norm();
    if offset >= obstacle.radius_m - TOUCH_M {
        return None;
    }
    let up = most_upward(&along);
    // A segment through the centre has no side; upwards is as short as any.
    let aside = if offset > 1e-12 * obstacle.radius_m.max(1.0) { outward / offset } else { up };
    let section = Section { from, to, foot, along, aside, offset, obstacle };
    let geodesic = section.arc(0.0);
    let Some(table_z_m) = obstacle.table_z_m else { return Some(geodesic) };
    if geodesic.lowest_z() >= table_z_m {
        return Some(geodesic);
    }
    // Between the geodesic (under the table) and the upward plane (above it) lies the least turn.
    let full_turn = along.cross(&aside).dot(&up).atan2(aside.dot(&up));
    let (mut under, mut over) = (0.0, 1.0);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (under + over);
        if section.arc(middle * full_turn).lowest_z() >= table_z_m { over = middle } else { under = middle }
    }
    Some(section.arc(over * full_turn))
}

/// The unit vector square to `along` that points up most; x if `along` is vertical.
fn most_upward(along: &Vector) -> Vector {
    let up = Vector::z() - along * along.z;
    if up.norm() > 1e-9 { up.normalize() } else { Vector::x() }
}

/// The planes through a segment that cuts the ball.
struct Section<'a> {
    from: Point,
    to: Point,
    /// Point of the segment nearest to the ball's centre.
    foot: Point,
    along: Vector,
    /// From the centre to the foot, unit.
    aside: Vector,
    /// Distance of the foot from the centre, metres.
    offset: f64,
    obstacle: &'a Obstacle,
}

impl Section<'_> {
    /// Tangent, arc, tangent in the plane turned by `turn_rad` from the one through the centre.
    fn arc(&self, turn_rad: f64) -> Arc {
        let (sin, cos) = turn_rad.sin_cos();
        let aside = self.aside * cos + self.along.cross(&self.aside) * sin;
        let out_of_plane = self.offset * sin;
        let radius_m = (self.obstacle.radius_m.powi(2) - out_of_plane * out_of_plane).max(0.0).sqrt();
        // Height of the segment over the disc's centre.
        let height = self.offset * cos;
        let center = self.foot - aside * height;
        let before = (self.foot - self.from).norm();
        let after = (self.to - self.foot).norm();
        let tangent = |reach: f64| (radius_m / reach.hypot(height).max(radius_m)).acos();
        Arc {
            center,
            along: self.along,
            aside,
            radius_m,
            begin_rad: std::f64::consts::PI - height.atan2(before) - tangent(before),
            end_rad: height.atan2(after) + tangent(after),
        }
    }
}

fn steps(length_m: f64, step_m: f64) -> usize {
    if length_m > 0.0 && step_m > 0.0 { (length_m / step_m).ceil().max(1.0) as usize } else { 1 }
}

fn extend_straight(points: &mut Vec<Point>, from: Point, to: Point, step_m: f64) {
    let steps = steps((to - from).norm(), step_m);
    points.extend((1..=steps).map(|k| from + (to - from) * (k as f64 / steps as f64)));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::direction_from_azimuth_elevation;
    use proptest::prelude::*;

    /// A point `gap` outside the ball of the tests, above the table.
    fn outside() -> impl Strategy<Value = Point> {
        (-3.1..3.1f64, -1.5..1.5f64, 1e-3..0.5f64).prop_map(|(azimuth, elevation, gap)| {
            let direction = direction_from_azimuth_elevation(azimuth, elevation);
            CENTER + direction.into_inner() * (RADIUS_M + gap)
        })
    }

    const CENTER: Point = Point::new(0.4, -0.1, 0.05);
    const RADIUS_M: f64 = 0.2;

    fn clear_of(obstacle: &Obstacle, points: &[Point], step_m: f64) -> bool {
        let sag = step_m * step_m / RADIUS_M;
        points.iter().all(|p| (p - CENTER).norm() >= RADIUS_M - 1e-9)
            && points.iter().all(|p| obstacle.table_z_m.is_none_or(|z| p.z >= z - 1e-9))
            && points.windows(2).all(|w| {
                let middle = nalgebra::center(&w[0], &w[1]);
                (middle - CENTER).norm() >= RADIUS_M - sag && (w[1] - w[0]).norm() <= step_m + 1e-9
            })
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(500))]

        #[test]
        fn without_a_table_the_curve_is_the_geodesic(a in outside(), b in outside()) {
            let obstacle = Obstacle { center: CENTER, radius_m: RADIUS_M, table_z_m: None };
            let path = LocalPath::between(a, b, &obstacle);
            prop_assert!(clear_of(&obstacle, &path.sample(0.01), 0.01));
            // Tangent lengths and the angle left between the tangents' ends.
            let (u, v) = (a - CENTER, b - CENTER);
            let reach = |w: &Vector| (RADIUS_M / w.norm()).min(1.0).acos();
            let arc = u.angle(&v) - reach(&u) - reach(&v);
            let expected = if arc > 0.0 {
                RADIUS_M * arc + (u.norm_squared() - RADIUS_M * RADIUS_M).sqrt()
                    + (v.norm_squared() - RADIUS_M * RADIUS_M).sqrt()
            } else {
                (a - b).norm()
            };
            prop_assert!((path.length_m() - expected).abs() < 1e-7, "{} {expected}", path.length_m());
        }

        #[test]
        fn above_a_table_the_curve_clears_ball_and_table(a in outside(), b in outside(), table in -0.3..0.3f64) {
            let table = table.min(a.z).min(b.z);
            let obstacle = Obstacle { center: CENTER, radius_m: RADIUS_M, table_z_m: Some(table) };
            let path = LocalPath::between(a, b, &obstacle);
            let points = path.sample(0.01);
            prop_assert!(clear_of(&obstacle, &points, 0.01));
            prop_assert_eq!(points[0], a);
            prop_assert!((points[points.len() - 1] - b).norm() < 1e-12);
            let sampled: f64 = points.windows(2).map(|w| (w[1] - w[0]).norm()).sum();
            prop_assert!(sampled <= path.length_m() + 1e-9 && sampled > 0.99 * path.length_m());
            let free = LocalPath::between(a, b, &Obstacle { table_z_m: None, ..obstacle });
            prop_assert!(path.length_m() >= free.length_m() - 1e-9);
        }

        #[test]
        fn the_way_back_is_as_long(a in outside(), b in outside()) {
            let table = (-0.05f64).min(a.z).min(b.z);
            let obstacle = Obstacle { center: CENTER, radius_m: RADIUS_M, table_z_m: Some(table) };
            let there = LocalPath::between(a, b, &obstacle).length_m();
            prop_assert!((there - LocalPath::between(b, a, &obstacle).length_m()).abs() < 1e-7);
        }
    }

    #[test]
    fn opposite_points_go_over_the_top() {
        let (a, b) = (CENTER + Vector::x() * 0.3, CENTER - Vector::x() * 0.3);
        let obstacle = Obstacle { center: CENTER, radius_m: RADIUS_M, table_z_m: Some(0.0) };
        let points = LocalPath::between(a, b, &obstacle).sample(0.005);
        assert!(points.iter().any(|p| p.z > CENTER.z + RADIUS_M - 1e-3));
    }
}

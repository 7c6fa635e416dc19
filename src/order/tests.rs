//! The solver against simpler ones.

use std::time::Duration;

use proptest::prelude::*;

use super::*;
use crate::geometry::{Point, Vector};

/// The optimum by trying every subset (Held and Karp's dynamic programme).
fn by_subsets(matrix: &CostMatrix, start: usize) -> f64 {
    let n = matrix.len();
    let mut best = vec![f64::INFINITY; n << n];
    best[(1 << start) * n + start] = 0.0;
    for set in 0..1usize << n {
        for last in 0..n {
            let cost = best[set * n + last];
            if cost.is_finite() {
                for next in (0..n).filter(|next| set & (1 << next) == 0) {
                    let entry = &mut best[(set | 1 << next) * n + next];
                    *entry = entry.min(cost + matrix.get(last, next));
                }
            }
        }
    }
    (0..n).map(|last| best[((1 << n) - 1) * n + last]).fold(f64::INFINITY, f64::min)
}

/// The optimum by trying every order.
fn by_trying_all(matrix: &CostMatrix, path: &mut Vec<usize>) -> f64 {
    if path.len() == matrix.len() {
        return matrix.path_length(path);
    }
    let mut best = f64::INFINITY;
    for next in 0..matrix.len() {
        if !path.contains(&next) {
            path.push(next);
            best = best.min(by_trying_all(matrix, path));
            path.pop();
        }
    }
    best
}

/// Points on a sphere around an obstacle.
fn points(n: std::ops::Range<usize>) -> impl Strategy<Value = Vec<Point>> {
    prop::collection::vec((-3.1..3.1f64, 0.05..1.55f64, 0.2..0.4f64), n).prop_map(|list| {
        list.into_iter()
            .map(|(azimuth, elevation, radius)| {
                let direction = crate::geometry::direction_from_azimuth_elevation(azimuth, elevation);
                Point::origin() + direction.into_inner() * radius
            })
            .collect()
    })
}

const BALL: Obstacle = Obstacle { center: Point::new(0.0, 0.0, 0.0), radius_m: 0.12, table_z_m: Some(0.0) };
const BUDGET: Duration = Duration::from_secs(5);

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    #[test]
    fn small_problems_agree_with_trying_every_order(points in points(1..9), pick in 0usize..100) {
        let start = pick % points.len();
        let matrix = CostMatrix::from_points(&points, &BALL).unwrap();
        let path = shortest_path(&matrix, start, BUDGET).unwrap();
        let optimum = by_trying_all(&matrix, &mut vec![start]);
        prop_assert!((path.length - optimum).abs() <= 1e-9 * optimum.max(1e-9));
        prop_assert!(path.lower_bound <= optimum * (1.0 + 1e-12));
        prop_assert_eq!(path.order[0], start);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(16))]

    #[test]
    fn larger_problems_agree_with_dynamic_programming(points in points(10..14), pick in 0usize..100) {
        let start = pick % points.len();
        let matrix = CostMatrix::from_points(&points, &BALL).unwrap();
        let path = shortest_path(&matrix, start, BUDGET).unwrap();
        let optimum = by_subsets(&matrix, start);
        prop_assert!(path.optimal && (path.length - optimum).abs() <= 1e-9 * optimum);
        prop_assert!(path.lower_bound <= optimum * (1.0 + 1e-12));
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(30))]

    #[test]
    fn directed_costs_get_a_path_between_bound_and_optimum(
        costs in prop::collection::vec(0.0..1.0f64, 64), start in 0usize..8,
    ) {
        let matrix = CostMatrix::from_rows(8, costs).unwrap();
        let path = shortest_path(&matrix, start, BUDGET).unwrap();
        let optimum = by_subsets(&matrix, start);
        prop_assert!(path.lower_bound <= optimum + 1e-12 && optimum <= path.length + 1e-12);
        prop_assert!(!path.optimal || path.length <= optimum * (1.0 + 1e-9));
    }

    #[test]
    fn equal_costs_everywhere_are_no_trouble(n in 3usize..40) {
        // Every order is optimal: the most ties there can be.
        let path = shortest_path(&CostMatrix::from_rows(n, vec![1.0; n * n]).unwrap(), n / 2, BUDGET).unwrap();
        prop_assert!(path.optimal && path.length == (n - 1) as f64);
    }
}

#[test]
fn a_tammes_set_is_ordered_to_the_proven_optimum() {
    let space = crate::views::ViewSpace {
        center_in_base: Point::new(0.5, 0.0, 0.1),
        radius_m: 0.3,
        band: crate::views::Band::DEFAULT,
    };
    let ball = Obstacle { center: space.center_in_base, radius_m: 0.10625, table_z_m: Some(0.0) };
    for n in [17, 35, 58] {
        let set = crate::views::tammes(n, space.band).unwrap();
        let points: Vec<Point> = set.directions.iter().map(|d| space.position(d)).collect();
        let path = order_points(&points, 0, &ball, BUDGET).unwrap();
        let mut sorted = path.order.clone();
        sorted.sort_unstable();
        assert_eq!(sorted, (0..n).collect::<Vec<_>>());
        assert!(path.optimal, "{n}: {} {}", path.length, path.lower_bound);
        assert_eq!(path, order_points(&points, 0, &ball, BUDGET).unwrap());
    }
}

#[test]
fn a_budget_of_nothing_still_gives_a_path_and_a_valid_bound() {
    let points: Vec<Point> =
        (0..30).map(|k| Point::new((k * 7 % 11) as f64, (k * 5 % 13) as f64, (k % 3) as f64)).collect();
    let hurried = order_points(&points, 4, &Obstacle::none(), Duration::ZERO).unwrap();
    let patient = order_points(&points, 4, &Obstacle::none(), BUDGET).unwrap();
    assert!(patient.optimal);
    assert!(hurried.lower_bound <= patient.length && patient.length <= hurried.length);
}

#[test]
fn bad_problems_are_refused_with_their_numbers() {
    let a = Point::new(0.0, 0.0, 1.0);
    let order = |points: &[Point], start| order_points(points, start, &BALL, BUDGET);
    assert_eq!(order(&[], 0), Err(OrderError::Empty));
    assert_eq!(order(&[a], 1), Err(OrderError::Start { start: 1, count: 1 }));
    assert!(matches!(
        order(&[a, Point::new(f64::NAN, 0.0, 1.0)], 0),
        Err(OrderError::Coordinate { field, .. }) if field == "points[1].x"
    ));
    assert!(matches!(
        order(&[a, Point::new(0.0, 0.05, 0.0)], 0),
        Err(OrderError::InsideObstacle { index: 1, depth_m }) if (depth_m - 0.07).abs() < 1e-12
    ));
    assert!(matches!(
        order(&[a, Point::new(0.0, 0.5, -0.2)], 0),
        Err(OrderError::BelowTable { index: 1, depth_m }) if (depth_m - 0.2).abs() < 1e-12
    ));
    assert!(matches!(
        CostMatrix::from_rows(2, vec![0.0, -1.0, 1.0, 0.0]),
        Err(OrderError::Cost { from: 0, to: 1, .. })
    ));
}

#[test]
fn random_views_whose_combs_once_swung_for_ever_are_solved() {
    use rand::Rng;
    use rand_chacha::{ChaCha8Rng, rand_core::SeedableRng};
    let mut rng = ChaCha8Rng::seed_from_u64(5);
    let points: Vec<Point> = (0..100)
        .map(|_| {
            let z: f64 = rng.random_range(5f64.to_radians().sin()..1.0);
            let azimuth: f64 = rng.random_range(0.0..std::f64::consts::TAU);
            let horizontal = (1.0 - z * z).sqrt();
            let direction = Vector::new(horizontal * azimuth.cos(), horizontal * azimuth.sin(), z);
            Point::new(0.5, 0.0, 0.1) + direction * 0.3
        })
        .collect();
    let ball = Obstacle { center: Point::new(0.5, 0.0, 0.1), radius_m: 0.10625, table_z_m: Some(0.0) };
    assert!(order_points(&points, 0, &ball, BUDGET).unwrap().optimal);
}

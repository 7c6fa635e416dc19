//! The solver against simpler ones.

use std::time::Duration;

use proptest::prelude::*;

use super::*;
use crate::geometry::Point;

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
        prop_assert!(path.length <= 1.05 * optimum);
        prop_assert!(path.lower_bound <= optimum * (1.0 + 1e-12));
    }
}

use super::*;
use proptest::prelude::*;

fn row(entries: &[(usize, f64)], right: f64, equality: bool) -> Row {
    Row { entries: entries.to_vec(), right, equality }
}

proptest! {
    #[test]
    fn a_knapsack_is_filled_greedily(gains in prop::collection::vec((0.1..5.0f64, 0.1..5.0f64), 1..12), room in 0.0..20.0f64) {
        // The fractional knapsack has a closed solution: best gain per weight first.
        let mut lp = LinearProgram::new(gains.iter().map(|&(gain, _)| -gain).collect());
        let entries: Vec<_> = gains.iter().enumerate().map(|(k, &(_, weight))| (k, weight)).collect();
        lp.add_row(&row(&entries, room, false));
        prop_assert_eq!(lp.solve(f64::INFINITY, 1000, u64::MAX), Outcome::Optimal);
        let mut sorted = gains.clone();
        sorted.sort_by(|a, b| (b.0 / b.1).total_cmp(&(a.0 / a.1)));
        let (mut left, mut best) = (room, 0.0);
        for (gain, weight) in sorted {
            let share = (left / weight).clamp(0.0, 1.0);
            best += share * gain;
            left -= share * weight;
        }
        prop_assert!((lp.safe_bound() + best).abs() < 1e-9);
    }
}

#[test]
fn contradicting_rows_are_infeasible() {
    let mut lp = LinearProgram::new(vec![1.0, 1.0]);
    lp.add_row(&row(&[(0, 1.0), (1, 1.0)], 1.5, true));
    assert_eq!(lp.solve(f64::INFINITY, 100, u64::MAX), Outcome::Optimal);
    lp.add_row(&row(&[(0, 1.0), (1, 1.0)], 1.0, false));
    assert_eq!(lp.solve(f64::INFINITY, 100, u64::MAX), Outcome::Infeasible);
}

#[test]
fn a_fresh_inverse_changes_nothing() {
    let mut lp = LinearProgram::new(vec![1.0, 2.0, -1.0, 0.5]);
    lp.add_row(&row(&[(0, 1.0), (1, 1.0), (2, 1.0)], 1.5, true));
    lp.add_row(&row(&[(1, 1.0), (2, 1.0), (3, 2.0)], 1.2, false));
    assert_eq!(lp.solve(f64::INFINITY, 100, u64::MAX), Outcome::Optimal);
    let before = (lp.safe_bound(), lp.values().to_vec());
    lp.refactor();
    assert_eq!(lp.solve(f64::INFINITY, 100, u64::MAX), Outcome::Optimal);
    assert!((lp.safe_bound() - before.0).abs() < 1e-12);
    assert!(lp.values().iter().zip(&before.1).all(|(a, b)| (a - b).abs() < 1e-12));
}

#[test]
fn a_solve_ends_with_its_work() {
    let count = 60;
    let mut lp = LinearProgram::new((0..count).map(|k| 1.0 + (k * 7 % 11) as f64).collect());
    for k in 0..count {
        let entries = [k, (k + 1) % count, (k + 7) % count].map(|column| (column, 1.0)).to_vec();
        lp.add_row(&Row { entries, right: 1.5, equality: true });
    }
    let before = lp.work;
    assert_eq!(lp.clone().solve(f64::INFINITY, 1000, u64::MAX), Outcome::Optimal);
    assert_eq!(lp.solve(f64::INFINITY, 1000, 5_000), Outcome::Unfinished);
    assert!((5_000..50_000).contains(&(lp.work - before)), "{}", lp.work - before);
}

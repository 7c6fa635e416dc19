//! The linear programme behind one exact step: how to move all points a little so that the least
//! of the linearised squared distances becomes as large as possible. Primal-dual interior point.

use super::cholesky::Envelope;

/// Coordinates per point: along the parallel, along the meridian.
pub(super) const MOVES: usize = 2;
/// Most Newton steps.
const STEPS: usize = 40;
/// Share of the way to the nearest bound that a step may go.
const TO_BOUND: f64 = 0.97;

/// A pair's squared distance and how it changes with the moves of both its points. A point that
/// does not move has index `None`.
#[derive(Debug, Clone)]
pub(super) struct Pair {
    pub square: f64,
    pub points: [Option<usize>; 2],
    pub slopes: [[f64; MOVES]; 2],
}

impl Pair {
    /// Non-zero slopes as (variable, slope).
    fn slopes(&self) -> impl Iterator<Item = (usize, f64)> + '_ {
        self.points.iter().zip(&self.slopes).flat_map(|(point, slopes)| {
            let variable = point.map(|p| p * MOVES);
            slopes.iter().enumerate().filter_map(move |(k, &slope)| variable.map(|v| (v + k, slope)))
        })
    }

    fn value(&self, moves: &[f64]) -> f64 {
        self.square + self.slopes().map(|(variable, slope)| slope * moves[variable]).sum::<f64>()
    }
}

/// Moves within `low..high` that maximise the least of the pairs' linearised squared distances,
/// and that least. Stops when it is known to about `accuracy`.
pub(super) fn best_moves(pairs: &[Pair], low: &[f64], high: &[f64], accuracy: f64) -> (Vec<f64>, f64) {
    let n = low.len();
    let mut x: Vec<f64> = low.iter().zip(high).map(|(l, h)| 0.5 * (l + h)).collect();
    let spread = pairs.iter().map(|pair| pair.square).fold(0.0f64, f64::max);
    let least = |x: &[f64]| pairs.iter().map(|pair| pair.value(x)).fold(f64::INFINITY, f64::min);
    let width = low.iter().zip(high).map(|(l, h)| h - l).fold(0.0f64, f64::max);
    let t = least(&x) - 0.1 * width.min(spread);
    let mut slack: Vec<f64> = pairs.iter().map(|pair| pair.value(&x) - t).collect();
    let mut price: Vec<f64> = vec![1.0 / pairs.len() as f64; pairs.len()];
    let mean_slack = slack.iter().sum::<f64>() / slack.len() as f64;
    let first_gap = mean_slack / pairs.len() as f64;
    let mut price_low: Vec<f64> = x.iter().zip(low).map(|(x, l)| first_gap / (x - l)).collect();
    let mut price_high = price_low.clone();
    let mut matrix = Envelope::new(envelope(pairs, n));
    let bounds = (pairs.len() + 2 * n) as f64;

    for _ in 0..STEPS {
        let mut gap: f64 = slack.iter().zip(&price).map(|(s, p)| s * p).sum();
        for k in 0..n {
            gap += (x[k] - low[k]) * price_low[k] + (high[k] - x[k]) * price_high[k];
        }
        if gap < accuracy {
            break;
        }
        let centre = 0.12 * gap / bounds;
        matrix.clear();
        let mut right = vec![0.0; n];
        let mut border = vec![0.0; n];
        let (mut border_weight, mut border_right) = (0.0, -1.0);
        for ((pair, s), p) in pairs.iter().zip(&slack).zip(&price) {
            let weight = p / s;
            border_weight += weight;
            border_right += centre / s;
            for (a, slope_a) in pair.slopes() {
                right[a] += slope_a * centre / s;
                border[a] += weight * slope_a;
                for (b, slope_b) in pair.slopes().filter(|&(b, _)| b <= a) {
                    matrix.add(a, b, weight * slope_a * slope_b);
                }
            }
        }
        for k in 0..n {
            let (to_low, to_high) = (x[k] - low[k], high[k] - x[k]);
            matrix.add(k, k, price_low[k] / to_low + price_high[k] / to_high);
            right[k] += centre / to_low - centre / to_high;
        }
        matrix.factor(1e-300);
        let mut by_border = border.clone();
        matrix.solve(&mut right);
        matrix.solve(&mut by_border);
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let denominator = border_weight - dot(&border, &by_border);
        if !(denominator > 0.0) {
            break;
        }
        let dt = (dot(&border, &right) - border_right) / denominator;
        let dx: Vec<f64> = right.iter().zip(&by_border).map(|(r, b)| r + b * dt).collect();

        if !dt.is_finite() || dx.iter().any(|d| !d.is_finite()) {
            break;
        }
        let mut primal = 1.0f64;
        let mut dual = 1.0f64;
        let shorten = |value: f64, change: f64, step: &mut f64| {
            if change < 0.0 {
                *step = step.min(-TO_BOUND * value / change);
            }
        };
        let mut d_slack = Vec::with_capacity(pairs.len());
        let mut d_price = Vec::with_capacity(pairs.len());
        for ((pair, &s), &p) in pairs.iter().zip(&slack).zip(&price) {
            let ds = pair.slopes().map(|(variable, slope)| slope * dx[variable]).sum::<f64>() - dt;
            let dp = centre / s - p - p / s * ds;
            shorten(s, ds, &mut primal);
            shorten(p, dp, &mut dual);
            d_slack.push(ds);
            d_price.push(dp);
        }
        let mut d_low = Vec::with_capacity(n);
        let mut d_high = Vec::with_capacity(n);
        for k in 0..n {
            let (to_low, to_high) = (x[k] - low[k], high[k] - x[k]);
            let dl = centre / to_low - price_low[k] - price_low[k] / to_low * dx[k];
            let dh = centre / to_high - price_high[k] + price_high[k] / to_high * dx[k];
            shorten(to_low, dx[k], &mut primal);
            shorten(to_high, -dx[k], &mut primal);
            shorten(price_low[k], dl, &mut dual);
            shorten(price_high[k], dh, &mut dual);
            d_low.push(dl);
            d_high.push(dh);
        }
        let advance = |values: &mut [f64], change: &[f64], step: f64| {
            values.iter_mut().zip(change).for_each(|(v, c)| *v += step * c);
        };
        advance(&mut x, &dx, primal);
        advance(&mut slack, &d_slack, primal);
        advance(&mut price, &d_price, dual);
        advance(&mut price_low, &d_low, dual);
        advance(&mut price_high, &d_high, dual);
        if primal.max(dual) < 1e-9 {
            break;
        }
    }
    let reached = least(&x);
    (x, reached)
}

/// Where each row of the normal matrix begins: at the first variable it shares a pair with.
fn envelope(pairs: &[Pair], variables: usize) -> Vec<usize> {
    let mut first: Vec<usize> = (0..variables).map(|k| k - k % MOVES).collect();
    for pair in pairs {
        if let [Some(a), Some(b)] = pair.points {
            let (low, high) = (a.min(b) * MOVES, a.max(b) * MOVES);
            for row in &mut first[high..high + MOVES] {
                *row = (*row).min(low);
            }
        }
    }
    first
}

//! Limited-memory BFGS with a backtracking line search, deterministic and without libm.

/// Steps remembered.
const MEMORY: usize = 8;
/// Least share of the predicted decrease that a step must bring.
const ARMIJO: f64 = 1e-4;

/// When to stop.
#[derive(Debug, Clone, Copy)]
pub(super) struct Stop {
    /// Largest number of evaluations.
    pub evaluations: usize,
    /// Relative decrease over one step below which the minimum counts as reached.
    pub decrease: f64,
}

/// Minimises `evaluate` (value returned, gradient written) from `x`, in place.
/// No coordinate moves by more than `max_step` at once. Returns the number of evaluations.
pub(super) fn minimise(
    x: &mut Vec<f64>,
    max_step: f64,
    stop: Stop,
    mut evaluate: impl FnMut(&[f64], &mut [f64]) -> f64,
) -> usize {
    let n = x.len();
    let mut gradient = vec![0.0; n];
    let mut value = evaluate(x, &mut gradient);
    let mut evaluations = 1;
    let mut history: std::collections::VecDeque<(Vec<f64>, Vec<f64>, f64)> = Default::default();
    let mut next = vec![0.0; n];
    let mut next_gradient = vec![0.0; n];
    let mut calm = 0;
    while evaluations < stop.evaluations {
        let mut direction = search_direction(&gradient, &history);
        let mut slope = dot(&direction, &gradient);
        if !(slope < 0.0) {
            history.clear();
            direction = gradient.iter().map(|g| -g).collect();
            slope = -dot(&gradient, &gradient);
        }
        let longest = direction.iter().fold(0.0f64, |m, d| m.max(d.abs()));
        if !(slope < 0.0) || !longest.is_finite() {
            break;
        }
        let mut step = (max_step / longest).min(1.0);
        if history.is_empty() {
            step = step.min(0.1 * max_step / longest);
        }
        let mut accepted = false;
        while evaluations < stop.evaluations {
            for ((t, x), d) in next.iter_mut().zip(x.iter()).zip(&direction) {
                *t = x + step * d;
            }
            let next_value = evaluate(&next, &mut next_gradient);
            evaluations += 1;
            if next_value <= value + ARMIJO * step * slope {
                accepted = true;
                calm = if value - next_value <= stop.decrease * value { calm + 1 } else { 0 };
                value = next_value;
                break;
            }
            // Minimum of the parabola through both values and the slope, kept within bounds.
            let bend = 2.0 * (next_value - value - step * slope);
            let ratio = if bend.is_finite() && bend > 0.0 { -slope * step / bend } else { 0.1 };
            step *= ratio.clamp(0.1, 0.5);
            if step * longest < 1e-14 {
                break;
            }
        }
        if !accepted {
            break;
        }
        let s: Vec<f64> = next.iter().zip(x.iter()).map(|(a, b)| a - b).collect();
        let y: Vec<f64> = next_gradient.iter().zip(&gradient).map(|(a, b)| a - b).collect();
        let curvature = dot(&s, &y);
        if curvature > 1e-12 * dot(&s, &s) {
            if history.len() == MEMORY {
                history.pop_front();
            }
            history.push_back((s, y, 1.0 / curvature));
        }
        std::mem::swap(x, &mut next);
        std::mem::swap(&mut gradient, &mut next_gradient);
        if calm >= 3 {
            break;
        }
    }
    evaluations
}

fn search_direction(
    gradient: &[f64],
    history: &std::collections::VecDeque<(Vec<f64>, Vec<f64>, f64)>,
) -> Vec<f64> {
    let mut q: Vec<f64> = gradient.iter().map(|g| -g).collect();
    let mut alphas = Vec::with_capacity(history.len());
    for (s, y, rho) in history.iter().rev() {
        let alpha = rho * dot(s, &q);
        add(&mut q, -alpha, y);
        alphas.push(alpha);
    }
    if let Some((_, y, rho)) = history.back() {
        let scale = 1.0 / (rho * dot(y, y));
        q.iter_mut().for_each(|v| *v *= scale);
    }
    for ((s, y, rho), alpha) in history.iter().zip(alphas.into_iter().rev()) {
        let beta = rho * dot(y, &q);
        add(&mut q, alpha - beta, s);
    }
    q
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn add(to: &mut [f64], factor: f64, of: &[f64]) {
    to.iter_mut().zip(of).for_each(|(t, o)| *t += factor * o);
}

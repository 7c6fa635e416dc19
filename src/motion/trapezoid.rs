//! Time-optimal rest-to-rest motion along a straight joint move.

use super::joints::Joints;

/// Shortest duration of a move, seconds: keeps time strictly increasing where nothing moves.
const SHORTEST_S: f64 = 1e-3;

/// Progress from 0 to 1 with bounded speed and acceleration: ramp up, cruise, ramp down.
///
/// All joints share the progress, so they start and stop together.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Trapezoid {
    acceleration: f64,
    ramp_s: f64,
    duration_s: f64,
}

impl Trapezoid {
    /// The fastest progress that moves the joints by `step` within their speed and acceleration bounds.
    pub fn new(step: &Joints, max_speed: &Joints, max_acceleration: &Joints) -> Self {
        let least = |bounds: &Joints| {
            let ratios = step.iter().zip(bounds).filter(|(d, _)| d.abs() > 0.0).map(|(d, b)| b / d.abs());
            ratios.fold(f64::INFINITY, f64::min)
        };
        let (speed, acceleration) = (least(max_speed), least(max_acceleration));
        let (ramp_s, duration_s) = if speed * speed >= acceleration {
            let ramp_s = (1.0 / acceleration).sqrt();
            (ramp_s, 2.0 * ramp_s)
        } else {
            (speed / acceleration, 1.0 / speed + speed / acceleration)
        };
        if duration_s.is_nan() || duration_s < SHORTEST_S {
            // Next to no move: ramps of half the shortest duration.
            let ramp_s = 0.5 * SHORTEST_S;
            return Self { acceleration: 1.0 / (ramp_s * ramp_s), ramp_s, duration_s: SHORTEST_S };
        }
        Self { acceleration, ramp_s, duration_s }
    }

    /// Seconds from rest to rest.
    pub fn duration_s(&self) -> f64 {
        self.duration_s
    }

    /// Progress, its speed and its acceleration (of the interval that begins) at time `t_s`.
    pub fn at(&self, t_s: f64) -> (f64, f64, f64) {
        let (a, ramp, end) = (self.acceleration, self.ramp_s, self.duration_s);
        let t = t_s.clamp(0.0, end);
        let left = end - t;
        if t < ramp && t <= left {
            (0.5 * a * t * t, a * t, a)
        } else if left > ramp {
            (0.5 * a * ramp * ramp + a * ramp * (t - ramp), a * ramp, 0.0)
        } else {
            (1.0 - 0.5 * a * left * left, a * left, -a)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn progress_is_continuous_ends_at_one_and_uses_a_limit(d in 1e-4..6.0f64, e in 1e-4..6.0f64, v in 0.1..4.0f64, a in 0.1..20.0f64) {
            let mut step = [0.0; 8];
            step[0] = d;
            step[1] = -e;
            let profile = Trapezoid::new(&step, &[v; 8], &[a; 8]);
            let (mut last, n) = (profile.at(0.0), 500);
            prop_assert_eq!(last.0, 0.0);
            let h = profile.duration_s() / f64::from(n);
            let mut fastest = 0.0f64;
            for i in 1..=n {
                let now = profile.at(h * f64::from(i));
                let longest = d.max(e);
                fastest = fastest.max(now.1 * longest / v);
                prop_assert!((now.0 - last.0) * longest <= v * h * (1.0 + 1e-9));
                prop_assert!((now.1 - last.1).abs() * longest <= a * h * (1.0 + 1e-6) + 1e-12);
                let trapezoidal = 0.5 * h * (now.1 + last.1);
                prop_assert!((now.0 - last.0 - trapezoidal).abs() * longest <= 0.25 * a * h * h + 1e-9);
                last = now;
            }
            prop_assert!((last.0 - 1.0).abs() < 1e-12 && last.1.abs() < 1e-9);
            prop_assert!(fastest > 0.99 || (d.max(e) <= v * v / a * 1.01));
        }
    }

    proptest! {
        #[test]
        fn no_motion_within_the_limits_is_faster(
            d in 1e-2..6.0f64, e in 1e-2..6.0f64, v in 0.1..4.0f64, w in 0.1..4.0f64, a in 0.1..20.0f64, b in 0.1..20.0f64,
        ) {
            // On a straight joint move from rest, no joint can be faster at progress s than its
            // speed limit, than what its acceleration gives until s, and than what it can still
            // brake: the integral of the inverse of the slowest of all is a lower bound.
            let (mut step, mut speed, mut acceleration) = ([0.0; 8], [1.0; 8], [1.0; 8]);
            (step[0], step[1], speed[0], speed[1], acceleration[0], acceleration[1]) = (d, -e, v, w, a, b);
            let fastest = |s: f64| {
                let joint = |d: f64, v: f64, a: f64| (v / d).min((2.0 * a / d * s.min(1.0 - s)).sqrt());
                joint(d, v, a).min(joint(e, w, b))
            };
            let n = 20_000;
            // Midpoints of equal steps in the angle of s = (1 - cos u) / 2: dense where the speed is 0.
            let bound: f64 = (0..n)
                .map(|i| {
                    let du = std::f64::consts::PI / f64::from(n);
                    let u = du * (f64::from(i) + 0.5);
                    0.5 * u.sin() * du / fastest(0.5 * (1.0 - u.cos()))
                })
                .sum();
            let found = Trapezoid::new(&step, &speed, &acceleration).duration_s();
            prop_assert!(found <= bound * (1.0 + 1e-4) && found >= bound * (1.0 - 1e-4), "{found} {bound}");
        }
    }

    #[test]
    fn a_move_of_nothing_takes_a_millisecond() {
        let profile = Trapezoid::new(&[0.0; 8], &[1.0; 8], &[1.0; 8]);
        assert_eq!(profile.duration_s(), SHORTEST_S);
        assert_eq!(profile.at(SHORTEST_S).0, 1.0);
    }
}

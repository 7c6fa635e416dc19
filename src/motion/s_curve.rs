//! Time-optimal rest-to-rest motion along a straight joint move with bounded jerk.
//!
//! Seven segments of constant jerk (up to: ramp the acceleration up, hold it, ramp it down, cruise,
//! and the same mirrored), in closed form on the path parameter (Biagiotti and Melchiorri,
//! *Trajectory Planning for Automatic Machines and Robots*, section 3.4).

use super::joints::Joints;

/// Shortest duration of a move, seconds: keeps time strictly increasing where nothing moves.
const SHORTEST_S: f64 = 1e-3;

/// Progress from 0 to 1 with bounded speed, acceleration and jerk.
///
/// All joints share the progress, so they start and stop together.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SCurve {
    jerk: f64,
    /// Time in which the acceleration is ramped up (and down).
    jerk_s: f64,
    /// Time until the cruise.
    ramp_s: f64,
    cruise_s: f64,
}

impl SCurve {
    /// The fastest progress that moves the joints by `step` within their bounds.
    pub fn new(step: &Joints, max_speed: &Joints, max_acceleration: &Joints, max_jerk: &Joints) -> Self {
        let least = |bounds: &Joints| {
            let ratios = step.iter().zip(bounds).filter(|(d, _)| d.abs() > 0.0).map(|(d, b)| b / d.abs());
            ratios.fold(f64::INFINITY, f64::min)
        };
        let (speed, acceleration, jerk) = (least(max_speed), least(max_acceleration), least(max_jerk));
        let (jerk_s, ramp_s, cruise_s) = phases(1.0 / speed, 1.0 / acceleration, 1.0 / jerk);
        let duration_s = 2.0 * ramp_s + cruise_s;
        if duration_s.is_nan() || duration_s < SHORTEST_S {
            // Next to no move: four jerks of a quarter of the shortest duration.
            let jerk_s = 0.25 * SHORTEST_S;
            return Self { jerk: 0.5 / jerk_s.powi(3), jerk_s, ramp_s: 2.0 * jerk_s, cruise_s: 0.0 };
        }
        // Rounding in the durations must not show in the distance: the jerk takes it up.
        let covered = jerk_s * (ramp_s - jerk_s) * (ramp_s + cruise_s);
        Self { jerk: 1.0 / covered, jerk_s, ramp_s, cruise_s }
    }

    /// Seconds from rest to rest.
    pub fn duration_s(&self) -> f64 {
        2.0 * self.ramp_s + self.cruise_s
    }

    /// Progress, its speed and its acceleration at time `t_s`.
    pub fn at(&self, t_s: f64) -> (f64, f64, f64) {
        let end = self.duration_s();
        let t = t_s.clamp(0.0, end);
        if t <= self.ramp_s {
            return self.on_ramp(t);
        }
        if t < self.ramp_s + self.cruise_s {
            let (s, speed, _) = self.on_ramp(self.ramp_s);
            return (s + speed * (t - self.ramp_s), speed, 0.0);
        }
        let (left, speed, acceleration) = self.on_ramp(end - t);
        (1.0 - left, speed, -acceleration)
    }

    /// Progress, speed and acceleration `t` after the start, until the cruise.
    fn on_ramp(&self, t: f64) -> (f64, f64, f64) {
        let (j, tj, held) = (self.jerk, self.jerk_s, self.ramp_s - self.jerk_s);
        let up = t.min(tj);
        let (mut s, mut v, mut a) = (j * up.powi(3) / 6.0, 0.5 * j * up * up, j * up);
        if t > tj {
            let dt = t.min(held) - tj;
            s += dt * (v + 0.5 * a * dt);
            v += a * dt;
        }
        if t > held {
            let dt = t - held.max(tj);
            s += dt * (v + dt * (0.5 * a - j * dt / 6.0));
            v += dt * (a - 0.5 * j * dt);
            a -= j * dt;
        }
        (s, v, a)
    }
}

/// Seconds of the fastest progress from 0 to 1, at rest at both ends, with speed at most `1 / p`,
/// acceleration at most `1 / q` and jerk at most `1 / r`.
pub(crate) fn rest_to_rest_s(p: f64, q: f64, r: f64) -> f64 {
    let (_, ramp_s, cruise_s) = phases(p, q, r);
    2.0 * ramp_s + cruise_s
}

/// The same progress: the time in which the acceleration is ramped up, the time until the cruise,
/// and the cruise.
fn phases(p: f64, q: f64, r: f64) -> (f64, f64, f64) {
    let (jerk_s, ramp_s) = if q * q >= p * r {
        (r / q, r / q + q / p)
    } else {
        let jerk_s = (r / p).sqrt();
        (jerk_s, 2.0 * jerk_s)
    };
    let cruise_s = p - ramp_s;
    // A NaN (nothing moves) is no cruise.
    if cruise_s >= 0.0 {
        return (jerk_s, ramp_s, cruise_s);
    }
    // The speed limit is not reached.
    if q * q * q >= 2.0 * r * r {
        let jerk_s = r / q;
        (jerk_s, 0.5 * jerk_s + (0.25 * jerk_s * jerk_s + q).sqrt(), 0.0)
    } else {
        let jerk_s = (0.5 * r).cbrt();
        (jerk_s, 2.0 * jerk_s, 0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::motion::trapezoid::Trapezoid;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn progress_ends_at_one_within_its_limits_and_always_uses_one_of_them(
            d in 1e-4..6.0f64, e in 1e-4..6.0f64, v in 0.1..4.0f64, a in 0.1..20.0f64, j in 1.0..1000.0f64,
        ) {
            let step = [d, -e, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
            let profile = SCurve::new(&step, &[v; 8], &[a; 8], &[j; 8]);
            let longest = d.max(e);
            let n = 2000;
            let h = profile.duration_s() / f64::from(n);
            let mut last = profile.at(0.0);
            prop_assert_eq!(last, (0.0, 0.0, 0.0));
            let mut unused = 0;
            for i in 1..=n {
                let now = profile.at(h * f64::from(i));
                let (speed, acceleration) = (now.1 * longest, now.2.abs() * longest);
                let jerk = (now.2 - last.2).abs() / h * longest;
                prop_assert!(speed <= v * (1.0 + 1e-9) && acceleration <= a * (1.0 + 1e-9));
                prop_assert!(jerk <= j * (1.0 + 1e-6) + 1e-9 / h);
                prop_assert!((now.0 - last.0 - 0.5 * h * (now.1 + last.1)).abs() * longest <= j * h.powi(3) + 1e-12);
                // Time-optimal motion has no moment that spares all limits (but where one changes to another).
                let uses = |value: f64, limit: f64| value > limit * (1.0 - 1e-6);
                if !(uses(speed, v) || uses(acceleration, a) || uses(jerk, j)) {
                    unused += 1;
                }
                last = now;
            }
            prop_assert!((last.0 - 1.0).abs() < 1e-12 && last.1.abs() < 1e-12 && last.2.abs() < 1e-9);
            prop_assert!(unused <= 8, "{unused}");
            let without = Trapezoid::new(&step, &[v; 8], &[a; 8]).duration_s();
            prop_assert!(profile.duration_s() >= without * (1.0 - 1e-9));
            let stiff = SCurve::new(&step, &[v; 8], &[a; 8], &[1e9; 8]).duration_s();
            prop_assert!((stiff - without).abs() < 1e-3 * without + 1e-6);
        }
    }

    #[test]
    fn a_move_of_nothing_takes_a_millisecond() {
        let profile = SCurve::new(&[0.0; 8], &[1.0; 8], &[1.0; 8], &[1.0; 8]);
        assert!((profile.duration_s() - SHORTEST_S).abs() < 1e-15);
        assert!((profile.at(SHORTEST_S).0 - 1.0).abs() < 1e-12);
    }
}

//! An arm that follows a trajectory.

use super::SimulateError;
use crate::plan::{Trajectory, TrajectoryPoint};

/// A trajectory that can be asked for its joints at any time.
///
/// Between two samples each joint follows the quintic through their positions, velocities and
/// accelerations, as ROS' joint trajectory controller does.
#[derive(Clone, Debug)]
pub struct Following {
    trajectory: Trajectory,
}

impl Following {
    /// Checks `trajectory` for an arm of `joints` joints.
    ///
    /// # Errors
    /// [`SimulateError::Trajectory`] for the first point that cannot be followed.
    pub fn new(trajectory: Trajectory, joints: usize) -> Result<Self, SimulateError> {
        let wrong = |index, problem: String| Err(SimulateError::Trajectory { index, problem });
        if trajectory.points.is_empty() {
            return wrong(0, "there is none".to_owned());
        }
        let mut last_s = f64::NEG_INFINITY;
        for (index, point) in trajectory.points.iter().enumerate() {
            let rows = [&point.positions_rad, &point.velocities_rad_per_s, &point.accelerations_rad_per_s2];
            if rows.iter().any(|row| row.len() != joints || row.iter().any(|value| !value.is_finite())) {
                return wrong(index, format!("must hold {joints} finite numbers a row"));
            }
            if !(point.time_s > last_s && point.time_s.is_finite()) {
                return wrong(index, format!("time {} s does not follow {last_s} s", point.time_s));
            }
            last_s = point.time_s;
        }
        Ok(Self { trajectory })
    }

    /// The samples.
    pub fn points(&self) -> &[TrajectoryPoint] {
        &self.trajectory.points
    }

    /// Names of the joints.
    pub fn joint_names(&self) -> &[String] {
        &self.trajectory.joint_names
    }

    /// Time of the last sample, seconds.
    pub fn duration_s(&self) -> f64 {
        self.points().last().map_or(0.0, |point| point.time_s)
    }

    /// Joint angles at `time_s`, radians; before the start and after the end those of the first and
    /// last sample.
    pub fn joints_at(&self, time_s: f64) -> Vec<f64> {
        let points = self.points();
        let after = points.partition_point(|point| point.time_s <= time_s);
        match (after.checked_sub(1).and_then(|i| points.get(i)), points.get(after)) {
            (Some(a), Some(b)) => between(a, b, time_s),
            (Some(only), None) | (None, Some(only)) => only.positions_rad.clone(),
            (None, None) => Vec::new(),
        }
    }
}

fn between(a: &TrajectoryPoint, b: &TrajectoryPoint, time_s: f64) -> Vec<f64> {
    let span = b.time_s - a.time_s;
    let s = (time_s - a.time_s) / span;
    let joint = |j: usize| {
        let row = |row: &[f64]| row.get(j).copied().unwrap_or(0.0);
        let (p0, p1) = (row(&a.positions_rad), row(&b.positions_rad));
        let (v0, v1) = (row(&a.velocities_rad_per_s) * span, row(&b.velocities_rad_per_s) * span);
        let (a0, a1) =
            (row(&a.accelerations_rad_per_s2) * span * span, row(&b.accelerations_rad_per_s2) * span * span);
        let d = p1 - p0;
        let c3 = 10.0 * d - 6.0 * v0 - 4.0 * v1 - 1.5 * a0 + 0.5 * a1;
        let c4 = -15.0 * d + 8.0 * v0 + 7.0 * v1 + 1.5 * a0 - a1;
        let c5 = 6.0 * d - 3.0 * (v0 + v1) - 0.5 * (a0 - a1);
        p0 + s * (v0 + s * (0.5 * a0 + s * (c3 + s * (c4 + s * c5))))
    };
    (0..a.positions_rad.len()).map(joint).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn sample(time_s: f64, q: f64, v: f64, a: f64) -> TrajectoryPoint {
        TrajectoryPoint {
            positions_rad: vec![q],
            velocities_rad_per_s: vec![v],
            accelerations_rad_per_s2: vec![a],
            time_s,
            view: None,
        }
    }

    proptest! {
        #[test]
        fn a_quintic_motion_is_followed_exactly(c in proptest::array::uniform6(-1.0..1.0f64), t in 0.0..2.0f64) {
            let q = |t: f64| c.iter().rev().fold(0.0, |sum, k| sum * t + k);
            let v = |t: f64| c.iter().enumerate().skip(1).rev().fold(0.0, |sum, (i, k)| sum * t + i as f64 * k);
            let a = |t: f64| {
                c.iter().enumerate().skip(2).rev().fold(0.0, |sum, (i, k)| sum * t + (i * (i - 1)) as f64 * k)
            };
            let points = [0.0, 0.5, 2.0].map(|t| sample(t, q(t), v(t), a(t))).to_vec();
            let arm = Following::new(Trajectory { joint_names: vec!["j".into()], points }, 1).unwrap();
            prop_assert!((arm.joints_at(t)[0] - q(t)).abs() < 1e-9);
        }
    }

    #[test]
    fn times_that_stand_still_are_refused() {
        let points = vec![sample(0.0, 0.0, 0.0, 0.0), sample(0.0, 1.0, 0.0, 0.0)];
        let refused = Following::new(Trajectory { joint_names: vec!["j".into()], points }, 1);
        assert!(matches!(refused, Err(SimulateError::Trajectory { index: 1, .. })));
    }

    #[test]
    fn the_arm_rests_before_the_start_and_after_the_end() {
        let points = vec![sample(0.0, 0.3, 0.0, 0.0), sample(1.0, 1.0, 0.0, 0.0)];
        let arm = Following::new(Trajectory { joint_names: vec!["j".into()], points }, 1).unwrap();
        assert_eq!((arm.joints_at(-1.0)[0], arm.joints_at(7.0)[0]), (0.3, 1.0));
    }
}

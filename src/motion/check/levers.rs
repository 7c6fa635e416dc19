//! How far joints can carry a body, from the lengths between the joints alone.
//!
//! Link `n`'s frame sits on the axis of the joint that moves it, so the
//! distance between the origins of neighbouring links does not change. A point
//! of link `k` is never farther from the axis of joint `n` than the lengths
//! from there to link `k` and on to the point.

use parry3d_f64::math::Vec3;

use crate::robot::Kinematics;

/// Distances between the origins of neighbouring links, metres: entry `n` from link `n` to `n + 1`.
pub(super) struct Lengths(Vec<f64>);

impl Lengths {
    pub fn new(kinematics: &dyn Kinematics) -> Self {
        let zero = vec![0.0; kinematics.dof()];
        let origins: Vec<_> = kinematics.link_poses(&zero).iter().map(|p| p.translation.vector).collect();
        Self(origins.windows(2).map(|pair| if let [a, b] = pair { (b - a).norm() } else { 0.0 }).collect())
    }

    /// For each joint the most metres that a radian of it moves a body on link `link`, held in the
    /// ball of `radius` about `center` there; joints up to link `still` do not count.
    pub fn levers(&self, link: usize, still: usize, center: Vec3, radius: f64) -> Vec<f64> {
        let mut levers = vec![0.0; self.0.len()];
        let mut reach = center.length() + radius;
        for joint in (0..link).rev() {
            // Joint n moves link n + 1, whose frame sits on its axis.
            if joint + 1 > still
                && let Some(lever) = levers.get_mut(joint)
            {
                *lever = reach;
            }
            reach += self.0.get(joint).copied().unwrap_or(0.0);
        }
        levers
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Point;
    use crate::robot::RobotModel;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn no_move_carries_a_body_farther_than_its_levers_say(
            q in proptest::array::uniform7(-3.1..3.1f64), d in proptest::array::uniform7(-1.0..1.0f64),
            still in 0usize..=5, above in 1usize..=6, robot in 0usize..3,
        ) {
            let arm = RobotModel::named(["ur10e", "panda", "xarm6"][robot]).unwrap().kinematics;
            let link = (still + above).min(arm.dof());
            let center = Vec3::new(0.02, -0.05, 0.1);
            let levers = Lengths::new(arm.as_ref()).levers(link, still, center, 0.0);
            let moved: Vec<f64> = q.iter().zip(&d).map(|(a, b)| a + b).collect();
            let seen = |q: &[f64]| {
                let poses = arm.link_poses(q);
                poses[still].inverse() * poses[link] * Point::new(center.x, center.y, center.z)
            };
            let bound: f64 = levers.iter().zip(&d).map(|(lever, d)| lever * d.abs()).sum();
            prop_assert!((seen(&moved) - seen(&q)).norm() <= bound + 1e-12);
        }
    }
}

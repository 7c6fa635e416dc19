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

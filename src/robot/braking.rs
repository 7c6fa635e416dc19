//! A speed limit that falls towards the ends of a joint's range, kept by constant limits.

use super::Joint;

/// Share of the deceleration behind the falling limit that a joint is given. The less, the slower;
/// the more, the farther the ends move in.
const SHARE: f64 = 0.8;
/// What controllers take off the limit for rounding, rad/s.
const ROUNDING_RAD_PER_S: f64 = 1e-3;

/// A limit of the form `-offset + sqrt(2 deceleration (upper - q))` on speeds towards `upper`, and its
/// mirror image on speeds towards `lower`: what a joint that brakes by `deceleration` can still
/// stop from, less an offset. Franka Research 3 has such limits beside constant ones.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Braking {
    offset_rad_per_s: f64,
    deceleration_rad_per_s2: f64,
    lower_rad: f64,
    upper_rad: f64,
}

impl Braking {
    /// Offset (rad/s), deceleration (rad/s2) and the two ends (radians) of the formula.
    pub(super) const fn new(
        offset_rad_per_s: f64,
        deceleration_rad_per_s2: f64,
        lower_rad: f64,
        upper_rad: f64,
    ) -> Self {
        Self { offset_rad_per_s, deceleration_rad_per_s2, lower_rad, upper_rad }
    }

    /// `joint` with a range and an acceleration within which every motion that stays in the range
    /// keeps the falling limit.
    ///
    /// A joint that must be able to stop at `end` with acceleration `a` is nowhere faster than
    /// `sqrt(2 a x)` at a distance `x` from it. With `c` the offset and `d` the deceleration,
    /// `sqrt(2 a x) + c <= sqrt(2 d (x + m))` for all `x` if `a < d` and the margin `m` from `end` to
    /// the formula's end is at least `c^2 / (2 (d - a))`: the difference of the squares is least at
    /// `sqrt(2 a x) = c a / (d - a)`.
    pub(super) fn kept_by(&self, joint: Joint) -> Joint {
        let acceleration = joint.max_acceleration_rad_per_s2.min(SHARE * self.deceleration_rad_per_s2);
        let offset = self.offset_rad_per_s + ROUNDING_RAD_PER_S;
        let margin_rad = offset * offset / (2.0 * (self.deceleration_rad_per_s2 - acceleration));
        Joint {
            lower_rad: joint.lower_rad.max(self.lower_rad + margin_rad),
            upper_rad: joint.upper_rad.min(self.upper_rad - margin_rad),
            max_acceleration_rad_per_s2: acceleration,
            ..joint
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::robot::RobotModel;
    use proptest::prelude::*;

    /// libfranka, rate_limiting.h: `c`, `2 d` and the ends of joints 1 to 7 of Franka Research 3.
    const PUBLISHED: [(f64, f64, f64, f64); 7] = [
        (0.30, 12.0, -2.7501, 2.7501),
        (0.20, 5.17, -1.7918, 1.7918),
        (0.20, 7.0, -2.9065, 2.9065),
        (0.30, 8.0, -3.0481, -0.1458),
        (0.35, 34.0, -2.8101, 2.8101),
        (0.35, 11.0, 0.54092, 4.5205),
        (0.35, 34.0, -3.0196, 3.0196),
    ];

    proptest! {
        /// The fastest that a joint can be anywhere in its range, towards both ends.
        #[test]
        fn no_state_from_which_a_joint_can_stop_breaks_the_published_limit(i in 0usize..7, share in 0.0..=1.0f64) {
            let joint = &RobotModel::named("fr3").unwrap().joints[i];
            let (offset, twice, lower, upper) = PUBLISHED[i];
            let q = joint.lower_rad + share * (joint.upper_rad - joint.lower_rad);
            let fastest = |room: f64| {
                (2.0 * joint.max_acceleration_rad_per_s2 * room).sqrt().min(joint.max_speed_rad_per_s)
            };
            let most = |room: f64| (twice * room).max(0.0).sqrt() - offset;
            prop_assert!(fastest(joint.upper_rad - q) <= most(upper - q));
            prop_assert!(fastest(q - joint.lower_rad) <= most(q - lower));
        }
    }

    #[test]
    fn the_ends_move_in_by_less_than_four_degrees() {
        let published = [
            (-2.7437, 2.7437),
            (-1.7837, 1.7837),
            (-2.9007, 2.9007),
            (-3.0421, -0.1518),
            (-2.8065, 2.8065),
            (0.5445, 4.5169),
            (-3.0159, 3.0159),
        ];
        for (joint, (lower, upper)) in RobotModel::named("fr3").unwrap().joints.iter().zip(published) {
            for inwards in [joint.lower_rad - lower, upper - joint.upper_rad] {
                assert!((0.0..4f64.to_radians()).contains(&inwards), "{}: {inwards}", joint.name);
            }
        }
    }
}

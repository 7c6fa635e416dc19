//! Whole turns: the same arm posture at other joint angles.

use std::f64::consts::TAU;

use super::Joint;

/// How far outside a limit rounding may put an angle that is then moved onto it, radians.
const EDGE: f64 = 1e-9;

/// The angle equal to `angle_rad` up to whole turns that is nearest to
/// `target_rad` within the joint's limits; `None` if no turn fits.
pub fn nearest_wrap(joint: &Joint, angle_rad: f64, target_rad: f64) -> Option<f64> {
    let (low, high) = (joint.lower_rad - EDGE, joint.upper_rad + EDGE);
    let turns = ((target_rad - angle_rad) / TAU).round();
    let mut wrapped = angle_rad + turns * TAU;
    if wrapped < low {
        wrapped += ((low - wrapped) / TAU).ceil() * TAU;
    } else if wrapped > high {
        wrapped -= ((wrapped - high) / TAU).ceil() * TAU;
    }
    // A NaN fails both comparisons.
    (wrapped >= low && wrapped <= high).then(|| wrapped.max(joint.lower_rad).min(joint.upper_rad))
}

/// Every joint state that differs from `state_rad` by whole turns and lies
/// within the limits, in lexicographic order; at most `most` of them (the
/// first ones). Empty if a joint has no such angle or a value is not finite.
pub fn all_wraps(joints: &[Joint], state_rad: &[f64], most: usize) -> Vec<Vec<f64>> {
    let mut states: Vec<Vec<f64>> = vec![Vec::with_capacity(joints.len())];
    for (joint, &angle) in joints.iter().zip(state_rad) {
        let choices = joint_wraps(joint, angle, most);
        states = states
            .iter()
            .flat_map(|head| {
                choices.iter().map(move |&tail| {
                    let mut state = head.clone();
                    state.push(tail);
                    state
                })
            })
            .take(most)
            .collect();
    }
    if state_rad.len() < joints.len() { Vec::new() } else { states }
}

/// The angles equal to `angle_rad` up to whole turns within the limits, ascending, at most `most`.
fn joint_wraps(joint: &Joint, angle_rad: f64, most: usize) -> Vec<f64> {
    let first = nearest_wrap(joint, angle_rad, joint.lower_rad);
    let Some(first) = first else { return Vec::new() };
    (0..most.min(64))
        .map(|turn| first + turn as f64 * TAU)
        .take_while(|&q| q <= joint.upper_rad + EDGE)
        .map(|q| q.min(joint.upper_rad))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn joint(lower_rad: f64, upper_rad: f64) -> Joint {
        Joint {
            name: "j".into(),
            lower_rad,
            upper_rad,
            max_speed_rad_per_s: 1.0,
            max_acceleration_rad_per_s2: 1.0,
            max_jerk_rad_per_s3: None,
            continuous: false,
        }
    }

    #[test]
    fn a_joint_of_two_turns_has_two_wraps_and_three_at_its_seam() {
        let joint = joint(-TAU, TAU);
        assert_eq!(all_wraps(std::slice::from_ref(&joint), &[1.0], 64), vec![vec![1.0 - TAU], vec![1.0]]);
        assert_eq!(all_wraps(&[joint], &[0.0], 64), vec![vec![-TAU], vec![0.0], vec![TAU]]);
    }

    #[test]
    fn a_narrow_joint_without_room_has_none() {
        assert!(all_wraps(&[joint(0.5, 1.0)], &[2.0], 64).is_empty());
        assert!(all_wraps(&[joint(0.5, 1.0)], &[f64::NAN], 64).is_empty());
        assert!(all_wraps(&[joint(0.5, 1.0)], &[f64::INFINITY], 64).is_empty());
    }

    #[test]
    fn the_number_of_wraps_is_bounded() {
        let joints = vec![joint(-TAU, TAU); 7];
        assert_eq!(all_wraps(&joints, &[1.0; 7], 1000).len(), 128);
        assert_eq!(all_wraps(&joints, &[1.0; 7], 10).len(), 10);
    }

    proptest! {
        #[test]
        fn the_nearest_wrap_is_the_nearest_of_all(angle in -20.0..20.0f64, target in -6.0..6.0f64, low in -7.0..0.0f64, width in 0.1..9.0f64) {
            let joint = joint(low, low + width);
            let all = joint_wraps(&joint, angle, 64);
            match nearest_wrap(&joint, angle, target) {
                None => prop_assert!(all.is_empty()),
                Some(q) => {
                    prop_assert!(joint.contains(q));
                    prop_assert!(((q - angle) / TAU - ((q - angle) / TAU).round()).abs() < 1e-9);
                    let best = all.iter().map(|w| (w - target).abs()).fold(f64::INFINITY, f64::min);
                    prop_assert!((q - target).abs() <= best + 1e-9);
                }
            }
        }
    }
}

//! Arms whose last joint rolls the camera.

use std::f64::consts::TAU;

use super::cell::Cell;
use crate::geometry::Vector;

/// Whether the optical axis is the last joint's axis and that joint turns all the way: then a
/// pose and the same pose rolled are reached by the same states but for that joint. The number is
/// its turn for a radian of roll, 1 or -1.
pub(crate) fn last_joint_rolls(cell: &Cell) -> Option<f64> {
    let joint = cell.robot.joints.last()?;
    let camera = |last_rad: f64| {
        let mut state = vec![0.3; cell.robot.joints.len()];
        if let Some(last) = state.last_mut() {
            *last = last_rad;
        }
        cell.robot.kinematics.forward(&state) * cell.flange_from_camera
    };
    let (first, turned) = (camera(0.0), camera(1.0));
    let stays = (first.translation.vector - turned.translation.vector).norm() < 1e-9;
    let roll = (first.rotation.inverse() * turned.rotation).scaled_axis();
    let about_axis = (roll - Vector::z() * roll.z).norm() < 1e-9;
    (stays && about_axis && joint.upper_rad - joint.lower_rad >= TAU).then(|| roll.z.signum())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Pose;
    use crate::robot::RobotModel;

    #[test]
    fn the_last_joint_rolls_a_camera_on_its_axis_alone() {
        let ur5e = || RobotModel::named("ur5e").unwrap();
        let ahead = Pose::translation(0.0, 0.0, 0.06);
        assert_eq!(last_joint_rolls(&Cell::new(ur5e(), ahead)), Some(1.0));
        let back = Pose::new(Vector::zeros(), Vector::x() * std::f64::consts::PI);
        assert_eq!(last_joint_rolls(&Cell::new(ur5e(), back)), Some(-1.0));
        assert_eq!(last_joint_rolls(&Cell::new(ur5e(), Pose::translation(0.01, 0.0, 0.06))), None);
        let tilted = Pose::new(Vector::zeros(), Vector::x() * 0.01);
        assert_eq!(last_joint_rolls(&Cell::new(ur5e(), tilted)), None);
        // A Panda's last joint stops before it is round.
        assert_eq!(last_joint_rolls(&Cell::new(RobotModel::named("panda").unwrap(), ahead)), None);
    }
}

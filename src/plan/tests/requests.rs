//! Requests that the scenarios share.

use crate::geometry::Point;
use crate::motion::{ObjectShape, Objective, Roll, Timing};
use crate::plan::{Arm, ObjectSphere, PlanRequest, Surroundings, UnreachableViews, ViewShell, ViewSource};
use crate::robot::{DhConvention, DhRow, RobotModel};
use crate::views::Band;

/// `views` views 0.3 m around a 0.1 m object on the table in front of `model`.
pub fn request(model: RobotModel, views: usize) -> PlanRequest {
    PlanRequest {
        source: ViewSource::Count(views),
        photo_poses: None,
        camera: None,
        object: Some(ObjectSphere {
            center_in_base: Point::new(0.45, 0.0, 0.1),
            radius_m: 0.1,
            table_z_m: Some(0.0),
            shape: ObjectShape::Sphere,
        }),
        shell: ViewShell { radius_m: 0.3, band: Band::DEFAULT },
        arm: Some(Arm {
            model,
            flange_from_camera: None,
            start_rad: None,
            roll: Roll::Fixed,
            objective: Objective::Distance,
            unreachable_views: UnreachableViews::Replace,
            surroundings: Surroundings::default(),
            timing: Timing::default(),
        }),
    }
}

/// An arm whose inverse kinematics nobody knows a formula for.
pub fn general_arm() -> RobotModel {
    let row = |a_m: f64, alpha_rad: f64, d_m: f64| DhRow::new(a_m, alpha_rad, d_m, 0.0);
    let rows = vec![
        row(0.02, 1.5, 0.2),
        row(-0.4, 0.1, 0.02),
        row(-0.38, -0.1, 0.0),
        row(0.03, 1.45, 0.11),
        row(0.02, -1.5, 0.09),
        row(0.0, 0.0, 0.09),
    ];
    RobotModel::from_dh(&rows, DhConvention::Standard).unwrap()
}

//! Requests that are refused for the work they are, or end for want of it.

use super::requests::{general_arm, request};
use crate::motion::{KeepOut, MotionError, Roll, Stop};
use crate::plan::{
    FieldValue, PlanError, ViewSource, check, make_plan_until, reachability, reachability_until,
};
use crate::robot::{LinkShape, RobotModel};

const NO_PREDICTOR: Result<&crate::predict::Predictor, &str> = Err("none");

fn refusal(error: PlanError) -> (&'static str, String, f64, String) {
    match error {
        PlanError::Invalid { code, field, value: FieldValue::Number(value), bound } => {
            (code, field, value, bound)
        }
        other => panic!("{other}"),
    }
}

#[test]
fn more_rolls_than_an_arm_can_be_searched_for_are_refused_with_the_number_that_fits() {
    let mut request = request(general_arm(), 200);
    for (rolls, views) in [(12, 200), (64, 30)] {
        request.source = ViewSource::Count(views);
        request.arm.as_mut().unwrap().roll = Roll::Free { samples: rolls };
        assert!(check(&request).is_ok(), "{rolls} {views}");
    }
    request.source = ViewSource::Count(200);
    let (code, field, value, bound) = refusal(check(&request).unwrap_err());
    assert_eq!((code, field.as_str(), value), ("too_much_work", "roll_samples", 64.0));
    let fit: usize = bound.split(' ').nth(2).unwrap().parse().unwrap();
    assert!(bound.starts_with("at most ") && (12..64).contains(&fit), "{bound}");
    request.arm.as_mut().unwrap().roll = Roll::Free { samples: fit };
    assert!(check(&request).is_ok());
}

#[test]
fn a_grid_of_reachability_counts_with_its_rolls() {
    let mut request = request(general_arm(), 5);
    request.arm.as_mut().unwrap().roll = Roll::Free { samples: 64 };
    let (code, field, ..) = refusal(reachability(&request, Some(20), Some(20)).unwrap_err());
    assert_eq!((code, field.as_str()), ("too_much_work", "roll_samples"));
}

#[test]
fn the_most_that_a_request_can_hold_of_a_usual_arm_is_not_refused() {
    let mut request = request(RobotModel::named("ur5e").unwrap(), 100);
    let arm = request.arm.as_mut().unwrap();
    arm.roll = Roll::Free { samples: 64 };
    for i in 0..64 {
        let shape_in_base = LinkShape::capsule([0.1, 0.6, 0.01 * f64::from(i)], [0.1, 0.6, 0.5], 0.01);
        arm.surroundings.keep_out.push(KeepOut { name: i.to_string(), shape_in_base });
    }
    arm.surroundings.tool = vec![LinkShape::capsule([0.0; 3], [0.0, 0.0, 0.02], 0.01); 32];
    arm.surroundings.camera_body = Some(arm.surroundings.tool.clone());
    assert!(check(&request).is_ok());
}

#[test]
fn what_is_stopped_has_no_answer() {
    let request = request(RobotModel::named("ur5e").unwrap(), 5);
    let stop = Stop::default();
    stop.ask();
    let stopped = |error: PlanError| matches!(error, PlanError::Motion(MotionError::Stopped));
    assert!(stopped(make_plan_until(&request, NO_PREDICTOR, &stop).unwrap_err()));
    assert!(stopped(reachability_until(&request, None, None, &stop).unwrap_err()));
}

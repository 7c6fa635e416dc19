use super::cells::{as_order, by_camera_path, cell, views};
use crate::motion::*;

fn planned_for(objective: Objective, roll: Roll, start: Option<&[f64]>) -> (MotionPlan, Vec<Violation>) {
    planned_by(objective, roll, start, false)
}

fn planned_by(
    objective: Objective,
    roll: Roll,
    start: Option<&[f64]>,
    jerk_limited: bool,
) -> (MotionPlan, Vec<Violation>) {
    let cell = cell("ur5e", 0.45, 0.1);
    let views = views(&cell, 24, 0.3);
    let order = by_camera_path(&cell, &views);
    let mut request = MotionRequest::new(&cell, &views);
    (request.objective, request.roll, request.start) = (objective, roll, start);
    request.order = Order::By(as_order(&order));
    request.timing.jerk_limited = jerk_limited;
    let plan = plan_motion(&request).unwrap();
    let violations = check(&request, &plan);
    (plan, violations)
}

const START: [f64; 6] = [0.0, -1.6, 1.6, -1.6, -1.57, 0.0];

#[test]
fn a_plan_for_time_is_sound_faster_and_says_what_it_is_compared_with() {
    for (roll, start) in [(Roll::Fixed, None), (Roll::FREE, None), (Roll::Fixed, Some(START.as_slice()))] {
        let (by_distance, _) = planned_for(Objective::Distance, roll, start);
        let (by_time, violations) = planned_for(Objective::Time, roll, start);
        assert_eq!(violations, vec![]);
        assert_eq!(by_time.planned_count(), by_distance.planned_count());
        assert!(by_time.duration_s < by_distance.duration_s, "{roll:?}");
        let compared = by_time.compared.unwrap();
        assert_eq!((compared.order, compared.duration_s), (by_distance.order, by_distance.duration_s));
        let least_s = compared.least_duration_s.unwrap();
        assert!(least_s < by_time.duration_s && least_s > 0.5 * by_time.duration_s, "{least_s} s");
        assert!(by_distance.compared.is_none());
    }
}

#[test]
fn with_bounded_jerk_the_bound_is_one_for_s_curves() {
    for roll in [Roll::Fixed, Roll::FREE] {
        let least_s = |plan: &MotionPlan| plan.compared.as_ref().unwrap().least_duration_s.unwrap();
        let (hard, _) = planned_by(Objective::Time, roll, None, false);
        let (smooth, violations) = planned_by(Objective::Time, roll, None, true);
        assert_eq!(violations, vec![]);
        assert!(smooth.duration_s <= smooth.compared.as_ref().unwrap().duration_s);
        // No S-curve is as fast: the same bound would say less of it.
        assert!(least_s(&smooth) > 1.03 * least_s(&hard), "{} {}", least_s(&smooth), least_s(&hard));
        assert!(least_s(&smooth) < smooth.duration_s && least_s(&smooth) > 0.8 * smooth.duration_s);
    }
}

#[test]
fn a_plan_for_time_is_the_same_every_time() {
    let plan = || planned_for(Objective::Time, Roll::FREE, None).0;
    assert_eq!(plan(), plan());
}

#[test]
fn a_given_order_stays_when_time_counts() {
    let cell = cell("ur5e", 0.45, 0.1);
    let views = views(&cell, 12, 0.3);
    let mut request = MotionRequest::new(&cell, &views);
    request.objective = Objective::Time;
    let plan = plan_motion(&request).unwrap();
    assert!(plan.order.is_sorted() && plan.planned_count() > 6);
    assert_eq!(plan.compared, None);
}

#[test]
fn no_plan_beats_its_own_bound_however_far_joints_may_turn() {
    for (half_range_rad, x) in [(3.4, -0.4), (4.0, -0.4), (5.0, -0.45), (6.2, -0.4), (6.27, -0.45)] {
        let mut cell = cell("ur5e", x, 0.1);
        for (index, joint) in cell.robot.joints.iter_mut().enumerate() {
            if index != 2 {
                (joint.lower_rad, joint.upper_rad) = (-half_range_rad, half_range_rad);
            }
        }
        let views = views(&cell, 5, 0.3);
        let order = by_camera_path(&cell, &views);
        let mut request = MotionRequest::new(&cell, &views);
        (request.objective, request.order) = (Objective::Time, Order::By(as_order(&order)));
        request.timing.settle_s = 0.0;
        let plan = plan_motion(&request).unwrap();
        let Some(least_s) = plan.compared.as_ref().and_then(|c| c.least_duration_s) else { continue };
        assert!(least_s <= plan.duration_s, "{half_range_rad}: {least_s} s against {} s", plan.duration_s);
    }
}

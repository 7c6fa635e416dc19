//! Sets adapted to arms whose inverse kinematics are searched for.

use super::requests::{general_arm, request};
use crate::geometry::Direction;
use crate::motion::Roll;
use crate::plan::{ClaimedPlan, Plan, PlanRequest, UnreachableViews, ViewStatus, make_plan, verify};
use crate::views::separation_rad;

fn plan(request: &PlanRequest) -> (Plan, usize) {
    let plan = make_plan(request, Err("none")).unwrap();
    assert_eq!(verify(request, &ClaimedPlan::of(&plan)).findings, vec![]);
    let planned = plan.views.iter().filter(|view| view.status == ViewStatus::Planned).count();
    (plan, planned)
}

#[test]
fn an_adapted_set_has_as_many_views_as_asked_for_when_that_many_are_reachable() {
    for (views, roll) in [(100, Roll::Fixed), (20, Roll::FREE)] {
        let mut request = request(general_arm(), views);
        request.arm.as_mut().unwrap().roll = roll;
        let (plan, planned) = plan(&request);
        assert_eq!(planned, views, "{roll:?}: {:?}", plan.warnings);
        let coverage = plan.coverage.unwrap();
        assert!(coverage.before.views < views && coverage.after.views == views);
        let center = request.object().center_in_base.coords;
        let at =
            |view: &crate::plan::PlanView| Direction::new_normalize(view.pose.translation.vector - center);
        let directions: Vec<Direction> = plan.views.iter().map(at).collect();
        assert!((separation_rad(&directions) - coverage.after.separation_rad).abs() < 1e-6);
        assert!(coverage.after.separation_rad > 0.7 * coverage.before.separation_rad, "{coverage:?}");
    }
}

#[test]
fn replacing_never_plans_fewer_views_than_leaving_out_and_both_tell_the_same_of_the_set() {
    let mut request = request(general_arm(), 30);
    // Out at the end of its reach.
    if let Some(object) = &mut request.object {
        object.center_in_base.x = 0.75;
    }
    let (replaced, more) = plan(&request);
    request.arm.as_mut().unwrap().unreachable_views = UnreachableViews::Skip;
    let (skipped, fewer) = plan(&request);
    assert!(fewer < 30 && more >= fewer, "{more} {fewer}");
    let [replaced, skipped] = [replaced, skipped].map(|plan| plan.coverage.unwrap());
    assert_eq!(replaced.before, skipped.after);
    assert_eq!((replaced.after.views, skipped.before.views), (more, fewer));
}

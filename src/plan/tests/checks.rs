//! Plans that are not what their request asks for.

use super::requests::request;
use crate::motion::MOST_OF_A_KIND;
use crate::plan::{ClaimedPlan, PlanRequest, UnreachableViews, ViewSource, make_plan, verify};
use crate::robot::RobotModel;

fn planned(views: usize) -> (PlanRequest, ClaimedPlan) {
    let mut request = request(RobotModel::named("ur5e").unwrap(), views);
    request.arm.as_mut().unwrap().unreachable_views = UnreachableViews::Skip;
    let plan = make_plan(&request, Err("none")).unwrap();
    (request, ClaimedPlan::of(&plan))
}

#[test]
fn a_plan_with_more_views_than_asked_for_is_not_what_was_asked_for() {
    let (mut request, claimed) = planned(6);
    assert_eq!(verify(&request, &claimed).findings, vec![]);
    request.source = ViewSource::Count(5);
    let codes: Vec<&str> = verify(&request, &claimed).findings.iter().map(|f| f.code).collect();
    assert_eq!(codes, ["view_not_asked_for"]);
    request.source = ViewSource::Count(7);
    let codes: Vec<&str> = verify(&request, &claimed).findings.iter().map(|f| f.code).collect();
    assert_eq!(codes, ["view_missing"]);
}

#[test]
fn what_is_wrong_with_all_views_does_not_hide_what_is_wrong_with_the_motion() {
    let (mut request, mut claimed) = planned(40);
    request.shell.radius_m = 0.31;
    claimed.points.last_mut().unwrap().velocities_rad_per_s[0] = 50.0;
    let findings = verify(&request, &claimed).findings;
    let of = |code: &str| findings.iter().filter(|finding| finding.code == code).count();
    assert_eq!(of("view_off_shell"), MOST_OF_A_KIND);
    assert!(of("speed_limit") > 0, "{findings:?}");
}

use super::cells::{as_order, by_camera_path, cell, views};
use crate::geometry::{Point, Pose, look_at};
use crate::motion::*;
use crate::robot::LinkShape;

fn plan(request: &MotionRequest) -> MotionPlan {
    let plan = plan_motion(request).unwrap();
    assert_eq!(check(request, &plan), vec![]);
    plan
}

fn reason(plan: &MotionPlan, view: usize) -> &SkipReason {
    match &plan.views[view] {
        ViewOutcome::Skipped(reason) => reason,
        ViewOutcome::Planned(_) => panic!("view {view} is planned"),
    }
}

#[test]
fn a_ur5e_visits_most_views_around_an_object_on_its_table() {
    let cell = cell("ur5e", 0.45, 0.0);
    let views = views(&cell, 35, 0.3);
    let order = by_camera_path(&cell, &views);
    let mut request = MotionRequest::new(&cell, &views);
    request.order = Order::By(as_order(&order));
    let fixed = plan(&request);
    request.roll = Roll::FREE;
    let free = plan(&request);
    println!(
        "fixed {} free {} of 35, {:.1} s and {:.1} s",
        fixed.planned_count(),
        free.planned_count(),
        fixed.duration_s,
        free.duration_s
    );
    assert!(fixed.planned_count() >= 20 && free.planned_count() >= fixed.planned_count());
    assert_eq!(free.order[0], 0);
    assert!(free.trajectory.len() > 100 && free.duration_s > 10.0);
}

#[test]
fn a_view_under_the_table_is_skipped_with_its_reason() {
    let cell = cell("ur5e", 0.45, 0.0);
    let target = Point::new(0.45, 0.0, 0.1);
    let views = [
        look_at(&Point::new(0.45, 0.0, 0.4), &target, 0.0),
        look_at(&Point::new(0.40, 0.2, 0.01), &target, 0.0),
    ];
    let plan = plan(&MotionRequest::new(&cell, &views));
    assert_eq!(plan.order, vec![0]);
    assert_eq!(reason(&plan, 1).code(), "table_collision");
    let SkipReason::Collision(contact) = reason(&plan, 1) else { panic!() };
    assert!(contact.depth_m > 0.0 && contact.depth_m < 0.2 && contact.second == "table");
}

#[test]
fn a_view_out_of_reach_tells_how_far() {
    let cell = cell("ur5e", 0.45, 0.0);
    let views = [look_at(&Point::new(2.0, 0.0, 0.5), &Point::new(0.45, 0.0, 0.1), 0.0)];
    let plan = plan(&MotionRequest::new(&cell, &views));
    assert!(plan.order.is_empty() && plan.trajectory.is_empty());
    let SkipReason::NoIk { position_residual_m, .. } = reason(&plan, 0) else { panic!("{:?}", plan.views) };
    assert!(*position_residual_m > 0.5 && *position_residual_m < 2.0);
    assert_eq!(reason(&plan, 0).code(), "no_ik");
}

#[test]
fn a_view_inside_the_object_and_one_in_a_keep_out_box_are_skipped() {
    let mut cell = cell("ur5e", 0.45, 0.0);
    cell.keep_out.push(KeepOut {
        name: "monitor".into(),
        shape_in_base: LinkShape::Cuboid {
            link_from_box: Pose::translation(0.45, -0.3, 0.3),
            half_extents_m: crate::geometry::Vector::new(0.2, 0.05, 0.3),
        },
    });
    let target = Point::new(0.45, 0.0, 0.1);
    let views = [
        look_at(&Point::new(0.45, 0.0, 0.15), &Point::new(0.45, 0.0, 0.05), 0.0),
        look_at(&Point::new(0.45, -0.28, 0.25), &target, 0.0),
    ];
    let plan = plan(&MotionRequest::new(&cell, &views));
    assert_eq!(reason(&plan, 0).code(), "object_collision");
    assert_eq!(reason(&plan, 1).code(), "obstacle_collision");
    let SkipReason::Collision(contact) = reason(&plan, 1) else { panic!() };
    assert_eq!(contact.second, "monitor");
}

#[test]
fn narrow_joint_limits_are_named() {
    let mut cell = cell("ur5e", 0.45, 0.0);
    for joint in &mut cell.robot.joints {
        (joint.lower_rad, joint.upper_rad) = (-0.1, 0.1);
    }
    // The kinematics still hold the wide limits: the model's joints must count all the same.
    let views = [look_at(&Point::new(0.45, 0.0, 0.4), &Point::new(0.45, 0.0, 0.1), 0.0)];
    let plan = plan_motion(&MotionRequest::new(&cell, &views)).unwrap();
    assert_eq!(reason(&plan, 0).code(), "joint_limit");
    let SkipReason::JointLimit { value_rad, limit_rad, .. } = reason(&plan, 0) else { panic!() };
    assert!(value_rad.abs() > limit_rad.abs());
}

#[test]
fn a_leg_through_a_wall_goes_around_it() {
    let mut cell = cell("ur5e", 0.45, 0.0);
    cell.object = None;
    let (a, b) = (Point::new(0.45, -0.3, 0.3), Point::new(0.45, 0.3, 0.3));
    let down = |p: &Point| look_at(p, &Point::new(p.x, p.y, 0.0), 0.0);
    let views = [down(&a), down(&b)];
    let open = plan(&MotionRequest::new(&cell, &views));
    cell.keep_out.push(KeepOut {
        name: "wall".into(),
        shape_in_base: LinkShape::Cuboid {
            link_from_box: Pose::translation(0.6, 0.0, 0.2),
            half_extents_m: crate::geometry::Vector::new(0.35, 0.03, 0.2),
        },
    });
    let walled = plan(&MotionRequest::new(&cell, &views));
    assert_eq!(walled.planned_count(), 2, "{:?}", walled.views);
    assert!(walled.joint_travel_rad > open.joint_travel_rad);
    assert_eq!(plan_motion(&MotionRequest::new(&cell, &views)).unwrap(), walled);
}

#[test]
fn the_motion_begins_at_the_start_and_with_the_nearest_view() {
    let cell = cell("ur5e", 0.45, 0.0);
    let views = views(&cell, 20, 0.3);
    let order = by_camera_path(&cell, &views);
    let mut request = MotionRequest::new(&cell, &views);
    request.order = Order::By(as_order(&order));
    let home = [0.0, -1.6, 1.6, -1.6, -1.57, 2.0 * std::f64::consts::PI + 1e-8];
    request.start = Some(&home);
    let plan = plan(&request);
    assert_eq!(plan.clamped_start.len(), 1);
    assert_eq!(plan.trajectory[0].time_from_start_s, 0.0);
    assert!(plan.trajectory[0].view.is_none());
    let camera = cell.robot.kinematics.forward(&home) * cell.flange_from_camera;
    let distance = |view: usize| (views[view].translation.vector - camera.translation.vector).norm();
    let nearest = plan.order.iter().map(|v| distance(*v)).fold(f64::INFINITY, f64::min);
    assert_eq!(distance(plan.order[0]), nearest);
}

#[test]
fn a_start_in_the_table_and_numbers_that_are_none_are_errors() {
    let cell = cell("ur5e", 0.45, 0.0);
    let views = views(&cell, 5, 0.3);
    let mut request = MotionRequest::new(&cell, &views);
    request.start = Some(&[0.0, 0.5, 0.5, 0.0, 0.0, 0.0]);
    assert!(matches!(plan_motion(&request), Err(MotionError::StartCollides { .. })));
    request.start = Some(&[f64::NAN; 6]);
    assert!(matches!(plan_motion(&request), Err(MotionError::Start(_))));
    request.start = None;
    request.timing.speed_scale = f64::NAN;
    assert!(matches!(plan_motion(&request), Err(MotionError::OutOfRange { .. })));
    let mut bad = cell.clone();
    bad.margin_m = -1.0;
    assert!(matches!(plan_motion(&MotionRequest::new(&bad, &views)), Err(MotionError::OutOfRange { .. })));
    let mut views = views.clone();
    views[1].translation.vector.x = f64::INFINITY;
    assert!(matches!(plan_motion(&MotionRequest::new(&cell, &views)), Err(MotionError::NotFinite { .. })));
    assert!(plan_motion(&MotionRequest::new(&cell, &[])).unwrap().trajectory.is_empty());
}

#[test]
fn an_order_that_is_no_permutation_is_an_error() {
    let cell = cell("ur5e", 0.45, 0.0);
    let views = views(&cell, 5, 0.3);
    let mut request = MotionRequest::new(&cell, &views);
    let twice = |reachable: &[usize], _: usize| vec![0; reachable.len()];
    request.order = Order::By(&twice);
    assert!(matches!(plan_motion(&request), Err(MotionError::BadOrder { .. })));
    let out_of_range = |reachable: &[usize], _: usize| (1..=reachable.len()).collect::<Vec<_>>();
    request.order = Order::By(&out_of_range);
    assert!(matches!(plan_motion(&request), Err(MotionError::BadOrder { .. })));
}

#[test]
fn half_the_speed_takes_twice_the_time() {
    let cell = cell("ur5e", 0.45, 0.0);
    let views = views(&cell, 8, 0.3);
    let mut request = MotionRequest::new(&cell, &views);
    request.timing.settle_s = 0.0;
    let fast = plan(&request);
    request.timing.speed_scale = 0.5;
    let slow = plan(&request);
    assert!((slow.duration_s - 2.0 * fast.duration_s).abs() < 0.02 * slow.duration_s);
}

#[test]
fn the_checker_sees_a_spoilt_plan() {
    let cell = cell("ur5e", 0.45, 0.0);
    let views = views(&cell, 8, 0.3);
    let request = MotionRequest::new(&cell, &views);
    let good = plan(&request);
    let mut late = good.clone();
    late.trajectory[3].time_from_start_s = 0.0;
    assert!(check(&request, &late).iter().any(|v| matches!(v, Violation::Time { .. })));
    let mut fast = good.clone();
    for point in &mut fast.trajectory {
        point.time_from_start_s *= 0.5;
    }
    assert!(check(&request, &fast).iter().any(|v| matches!(v, Violation::Limit { .. })));
    let mut off = good.clone();
    for point in &mut off.trajectory {
        point.positions_rad[0] += 0.01;
    }
    assert!(check(&request, &off).iter().any(|v| matches!(v, Violation::PoseError { .. })));
    let mut blocked = cell.clone();
    let at = good.trajectory[good.trajectory.len() / 2].positions_rad.clone();
    let camera = (cell.robot.kinematics.forward(&at) * cell.flange_from_camera).translation.vector;
    blocked.object = Some(CellObject::sphere(Point::from(camera), 0.05));
    let request = MotionRequest { cell: &blocked, ..request };
    assert!(check(&request, &good).iter().any(|v| matches!(v, Violation::TooNear { .. })));
}

#[test]
fn a_seven_joint_arm_with_numeric_kinematics_is_planned_as_well() {
    let cell = cell("panda", 0.45, 0.0);
    let views = views(&cell, 5, 0.3);
    let mut request = MotionRequest::new(&cell, &views);
    let home = [0.0, -0.6, 0.0, -2.2, 0.0, 1.6, 0.8];
    request.start = Some(&home);
    let plan = plan(&request);
    assert!(plan.planned_count() >= 2, "{:?}", plan.views);
    assert_eq!(plan.joint_names.len(), 7);
}

#[test]
fn a_view_behind_a_wall_that_the_arm_cannot_pass_has_no_path() {
    let mut cell = cell("ur5e", 0.45, 0.0);
    cell.object = None;
    // Only the first joint may turn, and not all the way: the stretched arm has to sweep past the wall.
    let at = |pan: f64| [pan, -1.2, 1.8, -2.1, -1.57, 0.0];
    let flange = |pan: f64| cell.robot.kinematics.forward(&at(pan));
    let views: Vec<Pose> = [-0.6, -0.65, 0.6, -0.7].map(|pan| flange(pan) * cell.flange_from_camera).to_vec();
    let middle = flange(0.0).translation.vector;
    let azimuth = middle.y.atan2(middle.x);
    for (joint, q) in cell.robot.joints.iter_mut().zip(at(0.0)) {
        (joint.lower_rad, joint.upper_rad) = (q - 0.02, q + 0.02);
    }
    (cell.robot.joints[0].lower_rad, cell.robot.joints[0].upper_rad) = (-1.0, 1.0);
    let out = crate::geometry::Vector::new(azimuth.cos(), azimuth.sin(), 0.5);
    cell.keep_out.push(KeepOut {
        name: "wall".into(),
        shape_in_base: LinkShape::Cuboid {
            link_from_box: Pose::new(out * 0.8, crate::geometry::Vector::z() * azimuth),
            half_extents_m: crate::geometry::Vector::new(0.5, 0.01, 0.5),
        },
    });
    let plan = plan(&MotionRequest::new(&cell, &views));
    assert_eq!(plan.order, vec![0, 1, 3], "{:?}", plan.views);
    let SkipReason::NoPath { from, attempts } = reason(&plan, 2) else { panic!("{:?}", plan.views) };
    assert_eq!(*from, LegStart::View(1));
    assert!(*attempts > 0);
}

#[test]
fn the_checker_does_not_miss_a_needle_between_two_points_far_apart() {
    let cell = cell("ur5e", 0.45, 0.0);
    let views = views(&cell, 8, 0.3);
    let mut request = MotionRequest::new(&cell, &views);
    request.timing.sample_period_s = 1.0;
    let sparse = plan(&request);
    let moved = |pair: &[TrajectoryPoint]| (pair[1].positions_rad[0] - pair[0].positions_rad[0]).abs();
    let far = sparse.trajectory.windows(2).max_by(|a, b| moved(a).total_cmp(&moved(b))).unwrap().to_vec();
    assert!(moved(&far) > 0.3);
    // The points lie on the straight line between its ends; so does the cubic between them.
    let at: Vec<f64> =
        far[0].positions_rad.iter().zip(&far[1].positions_rad).map(|(a, b)| a + 0.431 * (b - a)).collect();
    let camera = (cell.robot.kinematics.forward(&at) * cell.flange_from_camera).translation.vector;
    let needle = LinkShape::capsule(camera.into(), camera.into(), 1e-4);
    let mut pricked = cell.clone();
    pricked.margin_m = 0.0;
    pricked.keep_out.push(KeepOut { name: "needle".into(), shape_in_base: needle });
    let request = MotionRequest { cell: &pricked, ..request };
    let found = check(&request, &sparse);
    let hit = |v: &Violation| matches!(v, Violation::TooNear { second, .. } if second == "needle");
    assert!(found.iter().any(hit), "{found:?}");
}

#[test]
fn a_start_that_overlaps_is_refused_even_where_another_part_is_deeper_in_its_margin() {
    let mut cell = cell("ur5e", 0.45, 0.0);
    cell.object = None;
    let start = [0.0, -1.6, 1.6, -1.6, -1.57, 0.0];
    let arm = &cell.robot.kinematics;
    let forearm = cell.robot.links.iter().position(|link| link.name == "forearm_link").unwrap();
    let LinkShape::Capsule { from_in_link, to_in_link, radius_m } = cell.robot.links[forearm].shapes[0]
    else {
        panic!()
    };
    // A ball on the flange that just touches the forearm's side.
    let along = to_in_link - from_in_link;
    let beside =
        along.cross(&crate::geometry::Vector::new(0.3, 0.5, 0.8)).normalize() * (radius_m + 0.02 - 0.003);
    let ball_in_base =
        arm.link_poses(&start)[forearm] * (nalgebra::center(&from_in_link, &to_in_link) + beside);
    let ball = arm.forward(&start).inverse() * ball_in_base;
    cell.tool.push(LinkShape::capsule(ball.into(), ball.into(), 0.02));
    // The upper arm is 0.1 m above the table.
    cell.margin_m = 0.2;
    let mut request = MotionRequest::new(&cell, &[]);
    request.start = Some(&start);
    let refused = plan_motion(&request);
    assert!(
        matches!(&refused, Err(MotionError::StartCollides { second, .. }) if second == "tool"),
        "{refused:?}"
    );
    let mut bare = cell.clone();
    bare.tool.clear();
    assert!(plan_motion(&MotionRequest { cell: &bare, ..request }).is_ok());
}

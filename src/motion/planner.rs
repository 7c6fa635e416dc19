//! The planner: from camera poses to a timed, collision-free motion.

use super::candidates::{Candidate, candidates, rolled};
use super::choice::Layer;
use super::contact::Contact;
use super::error::MotionError;
use super::fastest::{Effort, fastest_order};
use super::joints::{Joints, difference, joints_from};
use super::metric::Metric;
use super::plan::{Compared, Leg, LegStart, MotionPlan, PlannedView, SkipReason, ViewOutcome};
use super::request::{MotionRequest, Objective, Order, Timing};
use super::resolve::{Resolved, StartState, Stop, resolve};
use super::scene::{Placement, Scene};
use super::shape::pose_is_finite;
use super::sweep::{RESOLUTION_M, Sweeper};
use super::trajectory::{Timed, timed};
use super::work::Work;

/// Shares of the work after which stages end, if they come so far: the search for states, the
/// motion for distance beside one for time, and the search for a fast order.
const CANDIDATES: f64 = 0.5;
const BY_DISTANCE: f64 = 0.7;
const FASTEST: f64 = 0.8;
/// What is kept for the rounding of corners.
const ROUNDING: f64 = 0.05;

/// Plans a motion of the arm through all views it can reach.
///
/// # Behaviour
/// Views that cannot be reached are left out with a reason; that none can be
/// reached is a valid answer with an empty trajectory. Margins hold at every
/// moment of the motion up to half a millimetre, except on the way out of a
/// start state that already undercuts them. Where the work that is allowed does not suffice, the
/// views that were not settled are left out.
///
/// # Errors
/// Numbers out of range, a start state beyond its limits or in collision, an
/// ordering function that returns no permutation, a trajectory too long to store; being stopped.
pub fn plan_motion(request: &MotionRequest) -> Result<MotionPlan, MotionError> {
    check_request(request)?;
    let mut scene = Scene::new(request.cell);
    let mut sweeper = Sweeper::new(Work::new(&request.allowance()));
    let robot = &request.cell.robot;
    let (start, clamped_start) = match request.start {
        Some(given) => {
            let (state, clamped) = robot.clamp_start(given)?;
            let start = start_state(&scene, &state, &mut sweeper.placement)?;
            scene.excuse(&start.joints, &mut sweeper.placement);
            (Some(start), clamped)
        }
        None => (None, Vec::new()),
    };
    let seeds: Vec<Vec<f64>> = start.iter().map(|s| s.joints[..scene.dof].to_vec()).collect();
    let rolls_rad = request.roll.rolls_rad();
    let mut skipped: Vec<Option<SkipReason>> = vec![None; request.views.len()];
    let mut reachable: Vec<(usize, Vec<Candidate>)> = Vec::new();
    sweeper.work().bound(request.share_of_work(CANDIDATES));
    for (view, pose) in request.views.iter().enumerate() {
        let known = request.known.and_then(|known| known.get(view)).and_then(Option::as_ref);
        match candidates(&scene, pose, &rolls_rad, &seeds, known, &mut sweeper.placement) {
            Ok(found) => reachable.push((view, found)),
            Err(reason) => {
                if let Some(slot) = skipped.get_mut(view) {
                    *slot = Some(reason);
                }
            }
        }
    }
    let layers = ordered(request, start.as_ref(), reachable)?;
    let joints = &robot.joints;
    // Each stage may use its part of the work, and what those before it left.
    let timed_motion = |metric: Metric, layers: Vec<Layer>, until: f64, sweeper: &mut Sweeper| {
        sweeper.work().bound(request.share_of_work(until));
        let resolved = resolve(&scene, sweeper, &metric, layers, start, request.seed);
        sweeper.work().bound(request.share_of_work(until + ROUNDING));
        Motion::timed(&scene, sweeper, resolved, start.as_ref(), &request.timing)
    };
    let all = 1.0 - ROUNDING;
    let (Motion { stops, dropped, timed }, compared) = match (request.objective, request.order) {
        (Objective::Distance, _) => (timed_motion(Metric::travel(joints), layers, all, &mut sweeper)?, None),
        (Objective::Time, Order::AsGiven) => (
            timed_motion(Metric::time(joints, request.timing.jerk_limited), layers, all, &mut sweeper)?,
            None,
        ),
        (Objective::Time, Order::By(_)) => {
            let by_distance =
                timed_motion(Metric::travel(joints), layers.clone(), BY_DISTANCE, &mut sweeper)?;
            sweeper.work().bound(request.share_of_work(FASTEST));
            let effort = Effort::new(request.timing.jerk_limited, request.seed);
            let fastest = fastest_order(&scene, &mut sweeper, &layers, start.as_ref(), effort);
            let layers = fastest.order.iter().filter_map(|i| layers.get(*i).cloned()).collect();
            let by_time =
                timed_motion(Metric::time(joints, request.timing.jerk_limited), layers, all, &mut sweeper)?;
            let mut compared = by_distance.compared();
            let better = if by_time.rank() < by_distance.rank() { by_time } else { by_distance };
            compared.least_duration_s =
                fastest.lower_bound_s.filter(|_| better.dropped.is_empty()).map(|s| {
                    s / request.timing.speed_scale + request.timing.settle_s * better.stops.len() as f64
                });
            (better, Some(compared))
        }
    };
    if sweeper.work().is_stopped() {
        return Err(MotionError::Stopped);
    }
    for (view, reason) in dropped {
        if let Some(slot) = skipped.get_mut(view) {
            *slot = Some(reason);
        }
    }

    let cut = |q: &Joints| q[..scene.dof].to_vec();
    let mut outcomes: Vec<Option<ViewOutcome>> =
        skipped.into_iter().map(|r| r.map(ViewOutcome::Skipped)).collect();
    let mut legs = Vec::with_capacity(stops.len());
    let mut joint_travel_rad = 0.0;
    let mut from = LegStart::Start;
    for (stop, arrival_s) in stops.iter().zip(&timed.arrivals_s) {
        if let (Some(slot), Some(pose)) = (outcomes.get_mut(stop.view), request.views.get(stop.view)) {
            *slot = Some(ViewOutcome::Planned(PlannedView {
                joints_rad: cut(&stop.joints),
                roll_rad: stop.candidate.roll_rad,
                base_from_camera: rolled(pose, stop.candidate.roll_rad),
                arrival_s: *arrival_s,
            }));
        }
        if !stop.waypoints.is_empty() {
            joint_travel_rad += largest_moves(&stop.waypoints);
            let waypoints_rad = stop.waypoints.iter().map(cut).collect();
            legs.push(Leg { from, to_view: stop.view, waypoints_rad });
        }
        from = LegStart::View(stop.view);
    }
    let unreached = || ViewOutcome::Skipped(SkipReason::NoPath { from: LegStart::Start, attempts: 0 });
    Ok(MotionPlan {
        joint_names: robot.joints.iter().map(|j| j.name.clone()).collect(),
        views: outcomes.into_iter().map(|o| o.unwrap_or_else(unreached)).collect(),
        order: stops.iter().map(|s| s.view).collect(),
        legs,
        duration_s: timed.points.last().map_or(0.0, |p| p.time_from_start_s),
        trajectory: timed.points,
        joint_travel_rad,
        compared,
        clamped_start,
        work: sweeper.work().spent(),
    })
}

/// Legs and their time law.
struct Motion {
    stops: Vec<Stop>,
    dropped: Vec<(usize, SkipReason)>,
    timed: Timed,
}

impl Motion {
    fn timed(
        scene: &Scene,
        sweeper: &mut Sweeper,
        resolved: Resolved,
        start: Option<&StartState>,
        timing: &Timing,
    ) -> Result<Self, MotionError> {
        let relief_m = start.map_or(0.0, |s| s.relief_m);
        let Resolved { stops, dropped, .. } = resolved;
        let timed = timed(scene, sweeper, start.map(|s| &s.joints), &stops, relief_m, timing)?;
        Ok(Self { stops, dropped, timed })
    }

    fn duration_s(&self) -> f64 {
        self.timed.points.last().map_or(0.0, |p| p.time_from_start_s)
    }

    /// Fewer views left out first, then less time.
    fn rank(&self) -> (usize, f64) {
        (self.dropped.len(), self.duration_s())
    }

    /// As what a motion for time is compared with.
    fn compared(&self) -> Compared {
        Compared {
            order: self.stops.iter().map(|s| s.view).collect(),
            duration_s: self.duration_s(),
            least_duration_s: None,
        }
    }
}

fn check_request(request: &MotionRequest) -> Result<(), MotionError> {
    request.cell.validate()?;
    for (i, pose) in request.views.iter().enumerate() {
        if !pose_is_finite(pose) {
            return Err(MotionError::NotFinite { field: format!("views[{i}]") });
        }
    }
    let Timing { speed_scale, settle_s, sample_period_s, .. } = request.timing;
    for (field, value, (least, most)) in [
        ("speed_scale", speed_scale, Timing::SPEED_SCALE),
        ("settle_s", settle_s, Timing::SETTLE_S),
        ("sample_period_s", sample_period_s, Timing::SAMPLE_PERIOD_S),
    ] {
        // A NaN is in no range.
        if !(least..=most).contains(&value) {
            return Err(MotionError::OutOfRange { field: field.into(), value, least, most });
        }
    }
    Ok(())
}

/// The start, and by how much it undercuts its margins. Overlap is an error.
fn start_state(scene: &Scene, state: &[f64], placement: &mut Placement) -> Result<StartState, MotionError> {
    let joints = joints_from(state);
    if let Some(Contact { first, second, distance_m, .. }) = scene.deepest_overlap(&joints, placement) {
        return Err(MotionError::StartCollides { first, second, depth_m: -distance_m });
    }
    let depth_m = scene.deepest_contact(&joints, placement, f64::INFINITY).map(|contact| contact.depth_m);
    Ok(StartState { joints, relief_m: depth_m.map_or(0.0, |depth_m| depth_m + RESOLUTION_M) })
}

fn ordered(
    request: &MotionRequest,
    start: Option<&StartState>,
    reachable: Vec<(usize, Vec<Candidate>)>,
) -> Result<Vec<Layer>, MotionError> {
    let expected = reachable.len();
    let order: Vec<usize> = match request.order {
        Order::By(order_views) if expected > 0 => {
            let views: Vec<usize> = reachable.iter().map(|(view, _)| *view).collect();
            order_views(&views, first_view(request, start, &views))
        }
        _ => (0..expected).collect(),
    };
    let mut layers: Vec<Option<Layer>> = reachable
        .into_iter()
        .map(|(view, candidates)| Some(Layer { view, candidates, priced: Vec::new() }))
        .collect();
    let taken = order.iter().map(|&i| layers.get_mut(i).and_then(Option::take));
    let ordered: Option<Vec<Layer>> = taken.collect();
    ordered.filter(|layers| layers.len() == expected).ok_or(MotionError::BadOrder { expected })
}

/// The reachable view whose camera is nearest to the start's, or the first without a start.
fn first_view(request: &MotionRequest, start: Option<&StartState>, views: &[usize]) -> usize {
    let Some(start) = start else { return 0 };
    let dof = request.cell.robot.kinematics.dof().min(start.joints.len());
    let base_from_camera =
        request.cell.robot.kinematics.forward(&start.joints[..dof]) * request.cell.flange_from_camera;
    let distance = |view: &usize| {
        let position = request.views.get(*view).map(|pose| pose.translation.vector);
        position.map_or(f64::INFINITY, |p| (p - base_from_camera.translation.vector).norm())
    };
    let distances = views.iter().map(distance).enumerate();
    distances.min_by(|a, b| a.1.total_cmp(&b.1)).map_or(0, |(i, _)| i)
}

fn largest_moves(waypoints: &[Joints]) -> f64 {
    let largest = |pair: &[Joints]| match pair {
        [a, b] => difference(a, b).iter().fold(0.0f64, |m, d| m.max(d.abs())),
        _ => 0.0,
    };
    waypoints.windows(2).map(largest).sum()
}

//! The views' order and motion with an arm.

use std::cell::RefCell;
use std::time::{Duration, Instant};

use super::free_path::{ORDER_BUDGET, free_path, obstacle, path_length, points};
use super::skip_reason::reason;
use super::{
    Arm, CameraPath, MotionFigures, MotionTime, PlanError, PlanRequest, Trajectory, TrajectoryPoint,
    ViewStatus, Warning,
};
use crate::geometry::Pose;
use crate::motion::{
    Allowance, Cell, KnownState, MotionPlan, MotionRequest, Objective, Order, SkipReason, Timing,
    ViewOutcome, plan_motion,
};
use crate::order::{OPTIMALITY_TOLERANCE, OrderedPath, order_points};

/// What the arm makes of the views.
pub(super) struct ArmPath {
    pub(super) statuses: Vec<ViewStatus>,
    /// With the roll that was chosen.
    pub(super) poses: Vec<Pose>,
    pub(super) path: CameraPath,
    /// What the motion takes, and what it is compared with; `None` if nothing moves.
    pub(super) motion_time: Option<MotionTime>,
    pub(super) trajectory: Option<Trajectory>,
    pub(super) warnings: Vec<Warning>,
    pub(super) timings: Vec<(&'static str, Duration)>,
    /// Work that it took.
    pub(super) work: u64,
}

impl ArmPath {
    /// Time that planning it took.
    pub(super) fn time(&self) -> Duration {
        self.timings.iter().map(|(_, time)| *time).sum()
    }
}

/// What a motion is planned through, and how.
pub(super) struct Asked<'a> {
    pub(super) poses: &'a [Pose],
    /// For each pose a state that takes it, where one is known; or empty.
    pub(super) known: &'a [Option<KnownState>],
    pub(super) end_at_top: bool,
    pub(super) objective: Objective,
    pub(super) timing: Timing,
    pub(super) allowance: Allowance,
}

/// Plans the motion through `poses`, the first of which is the top view.
///
/// The order is the shortest camera path through the views that the arm can take. It starts at the
/// top view, or with a start state at the view nearest to the camera's place there; `end_at_top`
/// turns it round.
pub(super) fn arm_path(
    request: &PlanRequest,
    arm: &Arm,
    cell: &Cell,
    asked: &Asked,
) -> Result<ArmPath, PlanError> {
    let begin = Instant::now();
    let &Asked { poses, known, end_at_top, objective, timing, ref allowance } = asked;
    let ordering = Ordering { request, poses, last: RefCell::new(None) };
    let by_length = |kept: &[usize], first: usize| ordering.order(kept, first);
    // Initial views are few: their order is fixed beforehand, and the unreachable ones fall out.
    let listed: Vec<usize> = if end_at_top {
        let (statuses, path) = free_path(request, poses, true)?;
        let below = (0..poses.len()).filter(|i| statuses.get(*i) != Some(&ViewStatus::Planned));
        below.chain(path.order).collect()
    } else {
        (0..poses.len()).collect()
    };
    let views: Vec<Pose> = listed.iter().filter_map(|view| poses.get(*view).copied()).collect();
    let known: Vec<Option<KnownState>> =
        listed.iter().map(|view| known.get(*view).cloned().flatten()).collect();
    let motion = plan_motion(&MotionRequest {
        start: arm.start_rad.as_deref(),
        roll: arm.roll,
        order: if end_at_top { Order::AsGiven } else { Order::By(&by_length) },
        objective,
        known: Some(&known),
        allowance: Some(allowance),
        timing,
        ..MotionRequest::new(cell, &views)
    })?;
    let planning_time = begin.elapsed() - ordering.time();
    // From here on everything is in the numbering of `poses`.
    let view_of = |index: usize| listed.get(index).copied().unwrap_or(index);
    let order: Vec<usize> = motion.order.iter().map(|index| view_of(*index)).collect();
    let path = ordering.path(order, end_at_top)?;
    let motion_time = motion_time(request, poses, &motion, &path, view_of)?;
    let mut statuses = vec![ViewStatus::Planned; poses.len()];
    let mut rolled = poses.to_vec();
    for (index, outcome) in motion.views.iter().enumerate() {
        let view = view_of(index);
        if let (Some(status), Some(pose)) = (statuses.get_mut(view), rolled.get_mut(view)) {
            match outcome {
                ViewOutcome::Planned(planned) => *pose = planned.base_from_camera,
                ViewOutcome::Skipped(skipped) => *status = ViewStatus::Skipped(reason(skipped, view_of)),
            }
        }
    }
    let order_time = ordering.time();
    let work = motion.work;
    Ok(ArmPath {
        statuses,
        poses: rolled,
        path,
        motion_time,
        warnings: unsettled(&motion.views).into_iter().collect(),
        trajectory: trajectory(motion, view_of),
        timings: vec![("order", order_time), ("motion", planning_time)],
        work,
    })
}

/// What to say where the work did not suffice.
fn unsettled(views: &[ViewOutcome]) -> Option<Warning> {
    let count =
        views.iter().filter(|view| matches!(view, ViewOutcome::Skipped(SkipReason::WorkLimit))).count();
    (count > 0).then(|| {
        let text = format!(
            "the cell is so hard that the planner's work ended before {count} of {} views were settled: fewer \
             solids, keep-out regions, rolls or views leave more for each",
            views.len()
        );
        Warning::new("work_limit", text)
    })
}

/// How long the motion takes beside what it is compared with.
fn motion_time(
    request: &PlanRequest,
    poses: &[Pose],
    motion: &MotionPlan,
    path: &CameraPath,
    view_of: impl Fn(usize) -> usize,
) -> Result<Option<MotionTime>, PlanError> {
    if motion.order.is_empty() {
        return Ok(None);
    }
    let planned = MotionFigures { duration_s: motion.duration_s, path_length_m: path.length_m };
    let Some(compared) = &motion.compared else {
        return Ok(Some(MotionTime { planned, by_distance: None, least_duration_s: None }));
    };
    let order: Vec<usize> = compared.order.iter().map(|index| view_of(*index)).collect();
    // The shortest order may lead to no view at all where another one leads to some.
    let by_distance = match order.is_empty() {
        true => None,
        false => {
            let path_length_m = path_length(request, poses, &order)?;
            Some(MotionFigures { duration_s: compared.duration_s, path_length_m })
        }
    };
    Ok(Some(MotionTime { planned, by_distance, least_duration_s: compared.least_duration_s }))
}

fn trajectory(motion: MotionPlan, view_of: impl Fn(usize) -> usize) -> Option<Trajectory> {
    let points: Vec<TrajectoryPoint> = motion
        .trajectory
        .into_iter()
        .map(|point| TrajectoryPoint {
            positions_rad: point.positions_rad,
            velocities_rad_per_s: point.velocities_rad_per_s,
            accelerations_rad_per_s2: point.accelerations_rad_per_s2,
            time_s: point.time_from_start_s,
            view: point.view.map(&view_of),
        })
        .collect();
    (!points.is_empty()).then_some(Trajectory { joint_names: motion.joint_names, points })
}

/// The order of the views by length, and what was proven about the last one given.
struct Ordering<'a> {
    request: &'a PlanRequest,
    poses: &'a [Pose],
    last: RefCell<Option<(Vec<usize>, OrderedPath, Duration)>>,
}

impl Ordering<'_> {
    /// The shortest order of the views `kept` from `kept[first]`, as indices into `kept`.
    fn order(&self, kept: &[usize], first: usize) -> Vec<usize> {
        let begin = Instant::now();
        let as_listed = || {
            let rest = (0..kept.len()).filter(|index| *index != first);
            std::iter::once(first).chain(rest).collect()
        };
        let Ok(path) = self.solve(kept, first) else {
            // Points that cannot be ordered are refused before; any order is a plan.
            return as_listed();
        };
        let order = path.order.clone();
        let visited = order.iter().filter_map(|index| kept.get(*index).copied()).collect();
        let before = self.time();
        self.last.replace(Some((visited, path, before + begin.elapsed())));
        order
    }

    fn solve(&self, kept: &[usize], first: usize) -> Result<OrderedPath, PlanError> {
        let points = points(self.poses, kept);
        Ok(order_points(&points, first, &obstacle(self.request), ORDER_BUDGET)?)
    }

    /// Time spent so far.
    fn time(&self) -> Duration {
        self.last.borrow().as_ref().map_or(Duration::ZERO, |(_, _, time)| *time)
    }

    /// What is known about the path in this order. A view that fell out after it was ordered leaves
    /// an order to be judged anew.
    fn path(&self, order: Vec<usize>, end_at_top: bool) -> Result<CameraPath, PlanError> {
        if order.is_empty() {
            return Ok(CameraPath { order, length_m: 0.0, lower_bound_m: 0.0, optimal: true });
        }
        if let Some((visited, path, _)) =
            self.last.borrow().as_ref().filter(|(visited, _, _)| *visited == order)
        {
            return Ok(CameraPath {
                order: visited.clone(),
                length_m: path.length,
                lower_bound_m: path.lower_bound,
                optimal: path.optimal,
            });
        }
        let length_m = path_length(self.request, self.poses, &order)?;
        let fixed_end = if end_at_top { order.len() - 1 } else { 0 };
        let bound = self.solve(&order, fixed_end)?;
        let lower_bound_m = bound.lower_bound.min(length_m);
        let optimal = length_m - lower_bound_m <= OPTIMALITY_TOLERANCE * length_m;
        Ok(CameraPath { order, length_m, lower_bound_m, optimal })
    }
}

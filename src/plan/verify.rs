//! Whether a plan is what its request asks for: from the plan's own numbers, whoever wrote them.

use std::cmp::Ordering;
use std::collections::BTreeMap;

use super::{Arm, PlanRequest, TrajectoryPoint, ViewSource, cell};
use crate::geometry::{Pose, Vector};
use crate::motion::{self, Claim, ClaimedView, Looked, MOST_OF_A_KIND, Roll, Stop, check_claim};

/// What counts as rounding: metres and radians.
const TOLERANCE: f64 = 1e-5;

/// A plan as its JSON claims it to be.
#[derive(Clone, Debug, Default)]
pub struct ClaimedPlan {
    /// The views, by id.
    pub views: Vec<ClaimedView>,
    /// Ids of the visited ones in order.
    pub order: Vec<usize>,
    /// Joint names of the trajectory.
    pub joint_names: Vec<String>,
    /// The trajectory; empty without one.
    pub points: Vec<TrajectoryPoint>,
}

/// Something wrong with a plan.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    /// Stable name.
    pub code: &'static str,
    /// For people.
    pub message: String,
    /// When on the trajectory, seconds.
    pub time_s: Option<f64>,
    /// The numbers of the message by name, with the unit in the name.
    pub numbers: Vec<(&'static str, f64)>,
    /// The joint, or the two parts concerned.
    pub parts: Vec<String>,
}

/// The verdict on a plan.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PlanVerdict {
    /// What is wrong, at most ten entries of a kind; empty for a sound plan.
    pub findings: Vec<Finding>,
    /// What of the motion was looked at.
    pub looked: Looked,
}

/// Collects what is wrong, the first of every kind: what a hundred views have in common must not
/// hide what a single one has.
#[derive(Default)]
struct Findings {
    listed: Vec<Finding>,
    of_kind: BTreeMap<&'static str, usize>,
}

impl Findings {
    fn push(&mut self, finding: Finding) {
        let count = self.of_kind.entry(finding.code).or_insert(0);
        *count += 1;
        if *count <= MOST_OF_A_KIND {
            self.listed.push(finding);
        }
    }
}

impl Finding {
    fn new(code: &'static str, message: String, numbers: Vec<(&'static str, f64)>) -> Self {
        Self { code, message, time_s: None, numbers, parts: Vec::new() }
    }
}

/// Judges `plan` as an answer to `request`, whose numbers have been checked ([`super::check`]).
///
/// The views must lie on the request's shell, look at the object and, on an arm, be taken by a
/// motion that [`check_claim`] finds nothing wrong with.
pub fn verify(request: &PlanRequest, plan: &ClaimedPlan) -> PlanVerdict {
    verify_until(request, plan, &Stop::default())
}

/// [`verify`], which ends soon after `stop` is asked for: then the motion is not proven.
pub fn verify_until(request: &PlanRequest, plan: &ClaimedPlan, stop: &Stop) -> PlanVerdict {
    let mut findings = Findings::default();
    count(request, plan, &mut findings);
    for (id, view) in plan.views.iter().enumerate() {
        let fixed_roll = request.arm.as_ref().is_none_or(|arm| arm.roll == Roll::Fixed);
        view_pose(request, id, &view.base_from_camera, fixed_roll, &mut findings);
    }
    order(request, plan, &mut findings);
    let mut verdict = PlanVerdict { findings: findings.listed, looked: Looked::default() };
    if let Some(arm) = &request.arm {
        motion(request, arm, plan, stop, &mut verdict);
    }
    if request.arm.is_none() && !plan.points.is_empty() {
        let message = "the plan has a trajectory, but the request names no robot to judge it by".to_owned();
        verdict.findings.push(Finding::new("unexpected_trajectory", message, Vec::new()));
    }
    verdict
}

fn count(request: &PlanRequest, plan: &ClaimedPlan, findings: &mut Findings) {
    let asked = match &request.source {
        ViewSource::Count(count) => *count,
        ViewSource::Initial { five } => 3 + 2 * usize::from(*five),
        ViewSource::Photos(_) => return,
    };
    let code = match plan.views.len().cmp(&asked) {
        Ordering::Less => "view_missing",
        Ordering::Equal => return,
        Ordering::Greater => "view_not_asked_for",
    };
    let numbers = vec![("views", plan.views.len() as f64), ("asked", asked as f64)];
    let message = format!("the plan has {} views, {asked} were asked for", plan.views.len());
    findings.push(Finding::new(code, message, numbers));
}

/// Whether a view lies on the shell, in the band, looks at the centre and keeps its horizon.
fn view_pose(
    request: &PlanRequest,
    id: usize,
    base_from_camera: &Pose,
    fixed_roll: bool,
    findings: &mut Findings,
) {
    let center = request.object().center_in_base;
    let from_center = base_from_camera.translation.vector - center.coords;
    let distance_m = from_center.norm();
    let mut find = |code, text: String, number| {
        findings.push(Finding::new(code, format!("view {id}: {text}"), vec![("view", id as f64), number]));
    };
    let radius_m = request.shell.radius_m;
    if !((distance_m - radius_m).abs() <= TOLERANCE) {
        let text = format!("its camera is {distance_m:.5} m from the object's centre, not {radius_m} m");
        find("view_off_shell", text, ("distance_m", distance_m));
    }
    let axis = base_from_camera.rotation * Vector::z();
    let angle_rad = axis.cross(&-from_center).norm().atan2(axis.dot(&-from_center));
    if !(angle_rad <= TOLERANCE) {
        let text = format!("its camera looks {angle_rad:.5} rad past the object's centre");
        find("view_off_aim", text, ("angle_rad", angle_rad));
    }
    let elevation_rad = from_center.z.atan2(from_center.x.hypot(from_center.y));
    let band = &request.shell.band;
    let (low, high) = (band.min_elevation_rad, band.max_elevation_rad);
    let is_initial = matches!(request.source, ViewSource::Initial { .. });
    let in_band = elevation_rad >= low - TOLERANCE && elevation_rad <= high + TOLERANCE;
    if !is_initial && !in_band {
        let text =
            format!("its elevation of {elevation_rad:.5} rad is outside the band, {low:.5} to {high:.5} rad");
        find("view_out_of_band", text, ("elevation_rad", elevation_rad));
    }
    let tilt_rad = (base_from_camera.rotation * Vector::x()).z.asin().abs();
    if fixed_roll && !(tilt_rad <= TOLERANCE) {
        find("view_rolled", format!("its horizon is tilted by {tilt_rad:.5} rad"), ("tilt_rad", tilt_rad));
    }
}

fn order(request: &PlanRequest, plan: &ClaimedPlan, findings: &mut Findings) {
    let mut visits = vec![0usize; plan.views.len()];
    for id in &plan.order {
        match visits.get_mut(*id) {
            Some(count) => *count += 1,
            None => {
                let message = format!("the order names view {id}, which the plan does not have");
                findings.push(Finding::new("wrong_order", message, vec![("view", *id as f64)]));
            }
        }
    }
    for (id, (count, view)) in visits.iter().zip(&plan.views).enumerate() {
        if *count != usize::from(view.planned) {
            let status = if view.planned { "planned" } else { "skipped" };
            let message = format!("view {id} is {status} and {count} times in the order");
            findings.push(Finding::new("wrong_order", message, vec![("view", id as f64)]));
        }
        let below_m = request.object().table_z_m.unwrap_or(f64::NEG_INFINITY)
            - view.base_from_camera.translation.vector.z;
        if view.planned && below_m > TOLERANCE {
            let message = format!("view {id} is planned {below_m:.4} m below the table's surface");
            let numbers = vec![("view", id as f64), ("below_m", below_m)];
            findings.push(Finding::new("view_under_table", message, numbers));
        }
    }
}

fn motion(request: &PlanRequest, arm: &Arm, plan: &ClaimedPlan, stop: &Stop, verdict: &mut PlanVerdict) {
    if plan.points.is_empty() {
        if !plan.order.is_empty() {
            let message = "views are planned for an arm but there is no trajectory".to_owned();
            verdict.findings.push(Finding::new("no_trajectory", message, Vec::new()));
        }
        return;
    }
    let names = arm.model.joints.iter().map(|joint| &joint.name);
    if !names.eq(plan.joint_names.iter()) {
        let message = format!("the trajectory's joints are {:?}, not the robot's", plan.joint_names);
        verdict.findings.push(Finding::new("wrong_joints", message, Vec::new()));
    }
    let cell = cell(request, arm);
    let trajectory: Vec<motion::TrajectoryPoint> = plan
        .points
        .iter()
        .map(|point| motion::TrajectoryPoint {
            positions_rad: point.positions_rad.clone(),
            velocities_rad_per_s: point.velocities_rad_per_s.clone(),
            accelerations_rad_per_s2: point.accelerations_rad_per_s2.clone(),
            time_from_start_s: point.time_s,
            view: point.view,
        })
        .collect();
    let found = check_claim(&Claim {
        cell: &cell,
        start: arm.start_rad.as_deref(),
        // The plan says how each view is turned.
        roll: Roll::Fixed,
        timing: arm.timing,
        views: &plan.views,
        order: &plan.order,
        trajectory: &trajectory,
        stop: Some(stop),
    });
    verdict.looked = found.looked;
    verdict.findings.extend(found.violations.iter().map(|violation| Finding {
        code: violation.code(),
        message: violation.to_string(),
        time_s: violation.time_s(&trajectory),
        numbers: violation.numbers(),
        parts: violation.parts(),
    }));
}

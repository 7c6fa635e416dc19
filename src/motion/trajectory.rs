//! From legs to a sampled trajectory.

use super::along_path::AlongPath;
use super::error::MotionError;
use super::joints::{Joints, difference, joints_from};
use super::plan::TrajectoryPoint;
use super::point_count::{check, samples};
use super::request::Timing;
use super::resolve::Stop;
use super::rounded::rounded;
use super::s_curve::SCurve;
use super::scene::Scene;
use super::sweep::Sweeper;
use super::trapezoid::Trapezoid;
use crate::robot::Joint;

/// A motion from rest to rest.
enum Run {
    Straight { from: Joints, step: Joints, progress: Progress },
    Along(AlongPath),
}

/// Progress along a straight move.
enum Progress {
    Trapezoid(Trapezoid),
    SCurve(SCurve),
}

/// What bounds the joints, scaled by the timing.
struct Bounds {
    speed: Joints,
    acceleration: Joints,
    /// `None` where jerk is not bounded.
    jerk: Option<Joints>,
}

impl Progress {
    fn duration_s(&self) -> f64 {
        match self {
            Progress::Trapezoid(progress) => progress.duration_s(),
            Progress::SCurve(progress) => progress.duration_s(),
        }
    }

    fn at(&self, t_s: f64) -> (f64, f64, f64) {
        match self {
            Progress::Trapezoid(progress) => progress.at(t_s),
            Progress::SCurve(progress) => progress.at(t_s),
        }
    }
}

impl Bounds {
    fn new(joints: &[Joint], timing: &Timing) -> Self {
        let scale = timing.speed_scale;
        let scaled = |limit: fn(&Joint) -> f64, by: f64| {
            let limits: Vec<f64> = joints.iter().map(|joint| limit(joint) * by).collect();
            joints_from(&limits)
        };
        Self {
            speed: scaled(|j| j.max_speed_rad_per_s, scale),
            acceleration: scaled(|j| j.max_acceleration_rad_per_s2, scale * scale),
            jerk: timing.jerk_limited.then(|| scaled(Timing::jerk_limit_rad_per_s3, scale.powi(3))),
        }
    }

    fn straight(&self, from: &Joints, to: &Joints) -> Run {
        let step = difference(from, to);
        let progress = match &self.jerk {
            None => Progress::Trapezoid(Trapezoid::new(&step, &self.speed, &self.acceleration)),
            Some(jerk) => Progress::SCurve(SCurve::new(&step, &self.speed, &self.acceleration, jerk)),
        };
        Run::Straight { from: *from, step, progress }
    }
}

impl Run {
    fn duration_s(&self) -> f64 {
        match self {
            Run::Straight { progress, .. } => progress.duration_s(),
            Run::Along(path) => path.duration_s(),
        }
    }

    fn at(&self, t_s: f64) -> (Joints, Joints, Joints) {
        match self {
            Run::Straight { from, step, progress } => {
                let (s, speed, acceleration) = progress.at(t_s);
                let position = std::array::from_fn(|j| from[j] + s * step[j]);
                (position, step.map(|d| d * speed), step.map(|d| d * acceleration))
            }
            Run::Along(path) => path.at(t_s),
        }
    }
}

/// The sampled motion and when it arrives at each stop.
pub(crate) struct Timed {
    pub points: Vec<TrajectoryPoint>,
    pub arrivals_s: Vec<f64>,
}

/// Times and samples the legs of `stops`, standing still for the settle time at each.
pub(crate) fn timed(
    scene: &Scene,
    sweeper: &mut Sweeper,
    start: Option<&Joints>,
    stops: &[Stop],
    first_relief_m: f64,
    timing: &Timing,
) -> Result<Timed, MotionError> {
    let bounds = Bounds::new(&scene.cell.robot.joints, timing);
    let mut recorder = Recorder { dof: scene.dof, now_s: 0.0, points: Vec::new() };
    let mut arrivals_s = Vec::with_capacity(stops.len());
    if let (Some(start), false) = (start, stops.is_empty()) {
        recorder.rest(start, None);
    }
    let runs = |(i, stop): (usize, &Stop)| {
        let relief_m = if i == 0 { first_relief_m } else { 0.0 };
        match stop.waypoints.as_slice() {
            [] => Vec::new(),
            [from, to] => vec![bounds.straight(from, to)],
            waypoints if bounds.jerk.is_some() => {
                let pieces = waypoints.windows(2).filter(|pair| pair.first() != pair.last());
                let run = |pair: &[Joints]| match pair {
                    [from, to] => Some(bounds.straight(from, to)),
                    _ => None,
                };
                pieces.filter_map(run).collect()
            }
            waypoints => rounded(scene, sweeper, waypoints, relief_m)
                .into_iter()
                .map(|pieces| Run::Along(AlongPath::new(pieces, &bounds.speed, &bounds.acceleration)))
                .collect(),
        }
    };
    let legs: Vec<Vec<Run>> = stops.iter().enumerate().map(runs).collect();
    let durations_s: Vec<f64> = legs.iter().flatten().map(Run::duration_s).collect();
    check(&durations_s, stops.len(), timing)?;
    for (stop, runs) in stops.iter().zip(&legs) {
        for run in runs {
            recorder.record(run, timing.sample_period_s);
        }
        recorder.arrive(&stop.joints, stop.view);
        arrivals_s.push(recorder.now_s);
        if timing.settle_s > 0.0 {
            recorder.now_s += timing.settle_s;
            recorder.rest(&stop.joints, None);
        }
    }
    Ok(Timed { points: recorder.points, arrivals_s })
}

struct Recorder {
    dof: usize,
    now_s: f64,
    points: Vec<TrajectoryPoint>,
}

impl Recorder {
    /// A point at rest. Its acceleration is 0 even where a motion begins, so
    /// that a controller's spline keeps still between two points at rest.
    fn rest(&mut self, q: &Joints, view: Option<usize>) {
        self.push(q, &[0.0; 8], &[0.0; 8], view);
    }

    fn push(&mut self, q: &Joints, velocity: &Joints, acceleration: &Joints, view: Option<usize>) {
        let cut = |v: &Joints| v[..self.dof].to_vec();
        self.points.push(TrajectoryPoint {
            positions_rad: cut(q),
            velocities_rad_per_s: cut(velocity),
            accelerations_rad_per_s2: cut(acceleration),
            time_from_start_s: self.now_s,
            view,
        });
    }

    /// Samples after the beginning of `run`, evenly, its end included.
    fn record(&mut self, run: &Run, period_s: f64) {
        let duration = run.duration_s();
        let count = samples(duration, period_s);
        let begin_s = self.now_s;
        for i in 1..=count as usize {
            let t = duration * i as f64 / count;
            self.now_s = begin_s + t;
            let (q, v, a) = run.at(t);
            if i == count as usize {
                self.rest(&q, None);
            } else {
                self.push(&q, &v, &a, None);
            }
        }
    }

    /// Marks the last point as the arrival at a view; the first point of all if there is none yet.
    fn arrive(&mut self, q: &Joints, view: usize) {
        match self.points.last_mut() {
            Some(point) if point.view.is_none() => {
                // The run ends here up to rounding; the view's own state is exact.
                point.positions_rad = q[..self.dof].to_vec();
                point.view = Some(view);
            }
            Some(_) => {
                self.now_s += 1e-3;
                self.rest(q, Some(view));
            }
            None => self.rest(q, Some(view)),
        }
    }
}

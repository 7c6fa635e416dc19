//! What a motion planner is asked.

use super::cell::Cell;
use super::reach::KnownState;
use super::work::Allowance;
use crate::geometry::Pose;
use crate::robot::Joint;

/// Freedom of the camera to turn about its optical axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Roll {
    /// The poses are taken as given.
    Fixed,
    /// Each view may be turned about its optical axis to one of `samples`
    /// evenly spaced rolls, the given one among them.
    Free {
        /// Number of rolls tried, at least 1; at most [`Roll::MOST_SAMPLES`] are.
        samples: usize,
    },
}

impl Roll {
    /// Free roll with the default number of samples.
    pub const FREE: Roll = Roll::Free { samples: 12 };
    /// Most rolls tried for a view.
    pub const MOST_SAMPLES: usize = 64;

    /// The rolls to try, radians, the given pose (0) first.
    pub fn rolls_rad(&self) -> Vec<f64> {
        match *self {
            Roll::Fixed => vec![0.0],
            Roll::Free { samples } => {
                let count = samples.clamp(1, Self::MOST_SAMPLES);
                (0..count).map(|i| std::f64::consts::TAU * i as f64 / count as f64).collect()
            }
        }
    }
}

/// Orders reachable views: gets their indices into [`MotionRequest::views`],
/// and which of them (an index into that list) comes first; returns the
/// visiting order as indices into the list, beginning with the first.
pub type OrderViews<'a> = &'a dyn Fn(&[usize], usize) -> Vec<usize>;

/// In which order views are visited.
#[derive(Clone, Copy)]
pub enum Order<'a> {
    /// As listed in the request, leaving out those that cannot be reached.
    AsGiven,
    /// As the function says. The path begins at the view whose camera position
    /// is nearest to the start's, or without a start at the first reachable
    /// view of the list (view 0 is the top view).
    By(OrderViews<'a>),
}

impl std::fmt::Debug for Order<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Order::AsGiven => "AsGiven",
            Order::By(_) => "By(..)",
        })
    }
}

/// What makes an order and the states in it good.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Objective {
    /// The order is [`Order`]'s; states are chosen for least joint travel along it.
    #[default]
    Distance,
    /// Order, branch, whole turns and roll are chosen together for the least execution time
    /// (generalised travelling salesman problem over the states of all views). [`Order::By`] is
    /// where the search begins, and the plan by [`Objective::Distance`] is kept should it not be
    /// beaten. [`Order::AsGiven`] stays: only the states are chosen for time.
    Time,
}

/// How the motion is timed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Timing {
    /// Fraction of the joints' speed limits used, in (0, 1]; accelerations are scaled by its square,
    /// jerks by its cube.
    pub speed_scale: f64,
    /// How long the arm stands still at each view before it moves on, seconds.
    pub settle_s: f64,
    /// Largest distance between points of the trajectory while the arm moves, seconds.
    pub sample_period_s: f64,
    /// Whether jerk is bounded too: every leg is an S-curve, and a detour stops at its corners,
    /// since a rounding that joins a line makes the acceleration jump.
    pub jerk_limited: bool,
}

impl Timing {
    /// Least and most of [`Timing::speed_scale`].
    pub const SPEED_SCALE: (f64, f64) = (0.01, 1.0);
    /// Least and most of [`Timing::settle_s`].
    pub const SETTLE_S: (f64, f64) = (0.0, 60.0);
    /// Least and most of [`Timing::sample_period_s`].
    pub const SAMPLE_PERIOD_S: (f64, f64) = (1e-3, 1.0);
    /// Where a robot has no jerk limit and one is asked for, its acceleration limit is reached in
    /// this time, seconds. Assumed: makers of such arms publish none; it is gentle for all of them.
    pub const ASSUMED_JERK_RISE_S: f64 = 0.05;

    /// The jerk limit of a joint, rad/s3: its own, or the assumed one.
    pub fn jerk_limit_rad_per_s3(joint: &Joint) -> f64 {
        joint.max_jerk_rad_per_s3.unwrap_or(joint.max_acceleration_rad_per_s2 / Self::ASSUMED_JERK_RISE_S)
    }
}

impl Default for Timing {
    fn default() -> Self {
        Self { speed_scale: 1.0, settle_s: 0.3, sample_period_s: 0.04, jerk_limited: false }
    }
}

/// A cell, the camera poses to visit in it, and how.
#[derive(Clone, Copy, Debug)]
pub struct MotionRequest<'a> {
    /// The cell.
    pub cell: &'a Cell,
    /// `base_from_camera` of each view, OpenCV axes.
    pub views: &'a [Pose],
    /// Joint state before the motion, radians; see [`crate::robot::clamp_start`].
    /// Without it, the motion starts at its first view, in the posture that suits the rest best.
    pub start: Option<&'a [f64]>,
    /// Freedom about the optical axis.
    pub roll: Roll,
    /// Order of the views.
    pub order: Order<'a>,
    /// What is minimised.
    pub objective: Objective,
    /// Timing.
    pub timing: Timing,
    /// Seed of the detour search. The same request and seed give the same plan.
    pub seed: u64,
    /// For each view a state that takes it, where one is known: searches begin there too.
    pub known: Option<&'a [Option<KnownState>]>,
    /// How much work the plan may take; [`Allowance::PLAN`] without it.
    pub allowance: Option<&'a Allowance>,
}

impl<'a> MotionRequest<'a> {
    /// Views in the given order, fixed roll, no start, default timing, seed 0.
    pub fn new(cell: &'a Cell, views: &'a [Pose]) -> Self {
        Self {
            cell,
            views,
            start: None,
            roll: Roll::Fixed,
            order: Order::AsGiven,
            objective: Objective::Distance,
            timing: Timing::default(),
            seed: 0,
            known: None,
            allowance: None,
        }
    }

    /// The allowance used.
    pub(super) fn allowance(&self) -> Allowance {
        self.allowance.cloned().unwrap_or_default()
    }

    /// A share of the work it allows.
    pub(super) fn share_of_work(&self, share: f64) -> u64 {
        self.allowance().share(share).most
    }
}

//! What inverse kinematics answers: solutions, or why there are none.

/// The answer of inverse kinematics: solutions, or the reason why there are none.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct InverseSolutions {
    /// Joint states, radians, each within limits and checked by forward kinematics.
    pub solutions: Vec<Vec<f64>>,
    /// Why `solutions` is empty; `None` if it is not.
    pub failure: Option<InverseFailure>,
}

/// Why no joint state reaches a pose.
#[derive(Debug, Clone, PartialEq)]
pub struct InverseFailure {
    /// The joint state that comes nearest, radians, within the limits unless
    /// the reason is a joint limit. Empty for a pose that is not finite.
    pub nearest: Vec<f64>,
    /// Distance between the flange at `nearest` and the target, metres.
    pub position_residual_m: f64,
    /// Angle between the flange at `nearest` and the target, radians.
    pub rotation_residual_rad: f64,
    /// What stands in the way.
    pub reason: UnreachableReason,
}

/// What stands between an arm and a pose.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum UnreachableReason {
    /// The pose has NaN or infinite numbers.
    #[error("the target pose is not finite")]
    NotFinite,
    /// The pose is out of the arm's reach, whatever its joint limits.
    #[error("out of reach by {beyond_m:.4} m ({bound})")]
    OutOfReach {
        /// How far, metres.
        beyond_m: f64,
        /// Which bound of the workspace.
        bound: ReachBound,
    },
    /// The arm would reach the pose if this joint could turn further.
    #[error("{joint} would be at {value_rad:.4} rad, its limit is {bound_rad:.4} rad")]
    JointLimit {
        /// The joint's name.
        joint: String,
        /// The angle it would need, radians.
        value_rad: f64,
        /// The limit it breaks, radians.
        bound_rad: f64,
    },
    /// The numeric search found no state; it cannot prove that there is none.
    #[error("no solution found in {attempts} attempts")]
    NotFound {
        /// The number of starting states tried.
        attempts: usize,
    },
}

/// A bound of an arm's workspace.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ReachBound {
    /// Farther than the stretched arm.
    TooFar,
    /// Nearer than the folded arm.
    TooClose,
    /// Within the column around the first axis that the arm's offset keeps it out of.
    InsideShoulderColumn,
}

impl std::fmt::Display for ReachBound {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::TooFar => "farther than the stretched arm",
            Self::TooClose => "nearer than the folded arm",
            Self::InsideShoulderColumn => "within the column around the first axis",
        })
    }
}

impl InverseFailure {
    /// Nothing is known but that no state was found.
    pub(super) fn unknown() -> Self {
        Self {
            nearest: Vec::new(),
            position_residual_m: f64::INFINITY,
            rotation_residual_rad: f64::INFINITY,
            reason: UnreachableReason::NotFound { attempts: 0 },
        }
    }
}

impl InverseSolutions {
    /// Solutions that were found; an empty list must come with a failure, so use [`Self::failed`] for that.
    pub fn found(solutions: Vec<Vec<f64>>) -> Self {
        Self { solutions, failure: None }
    }

    /// No solution, for the reason given.
    pub fn failed(failure: InverseFailure) -> Self {
        Self { solutions: Vec::new(), failure: Some(failure) }
    }

    /// No solution because the target has NaN or infinite numbers.
    pub fn not_finite() -> Self {
        Self::failed(InverseFailure {
            nearest: Vec::new(),
            position_residual_m: f64::INFINITY,
            rotation_residual_rad: f64::INFINITY,
            reason: UnreachableReason::NotFinite,
        })
    }
}

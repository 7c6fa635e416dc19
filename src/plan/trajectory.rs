//! The arm's motion over time.

/// A motion of an arm, sampled.
#[derive(Clone, Debug, PartialEq)]
pub struct Trajectory {
    /// Joint names, in the order of every vector below.
    pub joint_names: Vec<String>,
    /// Samples, times strictly increasing.
    pub points: Vec<TrajectoryPoint>,
}

/// One sample.
#[derive(Clone, Debug, PartialEq)]
pub struct TrajectoryPoint {
    /// Angles, radians.
    pub positions_rad: Vec<f64>,
    /// Speeds, rad/s.
    pub velocities_rad_per_s: Vec<f64>,
    /// Accelerations, rad/s2.
    pub accelerations_rad_per_s2: Vec<f64>,
    /// Seconds since the start.
    pub time_s: f64,
    /// The view whose photo is taken here, where the arm has come to rest.
    pub view: Option<usize>,
}

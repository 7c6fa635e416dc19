//! One revolute joint and its limits.

/// A revolute joint of the chain.
#[derive(Debug, Clone, PartialEq)]
pub struct Joint {
    /// The name used in trajectories, e.g. `shoulder_pan_joint`.
    pub name: String,
    /// Smallest allowed angle, radians.
    pub lower_rad: f64,
    /// Largest allowed angle, radians.
    pub upper_rad: f64,
    /// Largest speed, radians a second.
    pub max_speed_rad_per_s: f64,
    /// Largest acceleration, radians a second squared.
    pub max_acceleration_rad_per_s2: f64,
    /// Largest jerk, radians a second cubed; `None` where the time law need not bound it.
    pub max_jerk_rad_per_s3: Option<f64>,
    /// Whether the hardware turns without end. `lower_rad` and `upper_rad`
    /// still bound the plans (two turns each way would wind up the cables).
    pub continuous: bool,
}

impl Joint {
    /// Whether `angle_rad` lies within the limits. NaN does not.
    pub fn contains(&self, angle_rad: f64) -> bool {
        self.lower_rad <= angle_rad && angle_rad <= self.upper_rad
    }

    /// The middle of the range, radians.
    pub fn middle_rad(&self) -> f64 {
        0.5 * (self.lower_rad + self.upper_rad)
    }

    /// How far `angle_rad` lies outside the limits, radians; 0 inside.
    pub fn violation_rad(&self, angle_rad: f64) -> f64 {
        (self.lower_rad - angle_rad).max(angle_rad - self.upper_rad).max(0.0)
    }
}

//! Where a robot's numbers come from.

/// A group of a robot's numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum NumberGroup {
    /// Lengths, twists and offsets of the chain.
    Kinematics,
    /// Smallest and largest joint angles.
    PositionLimits,
    /// Joint speeds.
    SpeedLimits,
    /// Joint accelerations.
    AccelerationLimits,
    /// The links' shapes.
    LinkShapes,
    /// Limits that were replaced after the model was made.
    ReplacedLimits,
}

impl NumberGroup {
    /// A stable name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Kinematics => "kinematics",
            Self::PositionLimits => "position_limits",
            Self::SpeedLimits => "speed_limits",
            Self::AccelerationLimits => "acceleration_limits",
            Self::LinkShapes => "link_shapes",
            Self::ReplacedLimits => "replaced_limits",
        }
    }
}

/// Where the numbers of one group come from, or why they are assumed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Source {
    /// Which numbers.
    pub group: NumberGroup,
    /// The document, or the reason of the assumption.
    pub text: String,
}

impl Source {
    /// The source of one group.
    pub fn new(group: NumberGroup, text: impl Into<String>) -> Self {
        Self { group, text: text.into() }
    }

    /// The sources of kinematics, position, speed and acceleration limits and shapes, in this order.
    pub(super) fn of_model(texts: [&str; 5]) -> Vec<Self> {
        use NumberGroup::*;
        let groups = [Kinematics, PositionLimits, SpeedLimits, AccelerationLimits, LinkShapes];
        groups.into_iter().zip(texts).map(|(group, text)| Self::new(group, text)).collect()
    }
}

impl std::fmt::Display for Source {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}: {}", self.group.name().replace('_', " "), self.text)
    }
}

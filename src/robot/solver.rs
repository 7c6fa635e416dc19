//! Which inverse kinematics an arm uses.

/// The geometry that an arm's inverse kinematics makes use of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ArmStructure {
    /// Axes 2, 3 and 4 parallel, as in the arms of Universal Robots.
    ThreeParallel,
    /// Three neighbouring axes meet in a point, the other three carry it.
    SphericalWrist,
    /// Axes 4 and 5 meet, axis 6 passes beside: one angle is searched for, the others follow.
    OffsetWrist,
    /// Seven joints; with one of them held, the others have a spherical wrist.
    SpareJoint,
    /// None of these.
    General,
}

/// How an arm's inverse kinematics works.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Solver {
    /// The geometry used.
    pub structure: ArmStructure,
    /// Whether the arm has this geometry to rounding. If not (a calibrated
    /// arm), what the closed form gives are starts for a numeric descent.
    pub exact: bool,
}

impl Solver {
    /// A stable name.
    pub fn name(&self) -> &'static str {
        match (self.structure, self.exact) {
            (ArmStructure::ThreeParallel, true) => "three_parallel",
            (ArmStructure::ThreeParallel, false) => "three_parallel_refined",
            (ArmStructure::SphericalWrist, true) => "spherical_wrist",
            (ArmStructure::SphericalWrist, false) => "spherical_wrist_refined",
            (ArmStructure::OffsetWrist, true) => "offset_wrist",
            (ArmStructure::OffsetWrist, false) => "offset_wrist_refined",
            (ArmStructure::SpareJoint, true) => "spare_joint",
            (ArmStructure::SpareJoint, false) => "spare_joint_refined",
            (ArmStructure::General, _) => "numeric",
        }
    }

    /// What it does, in a sentence or two.
    pub fn description(&self) -> String {
        let what = match self.structure {
            ArmStructure::ThreeParallel => {
                "closed form for arms whose axes 2, 3 and 4 are parallel: all eight branches"
            }
            ArmStructure::SphericalWrist => {
                "closed form for arms of which three neighbouring axes meet in a point: all eight branches"
            }
            ArmStructure::OffsetWrist => {
                "axes 4 and 5 meet: the last angle is searched for over its turn, the others follow in closed form"
            }
            ArmStructure::SpareJoint => {
                "seven joints: closed form of the other six at samples of one joint's angle, at most 16 solutions"
            }
            ArmStructure::General => "damped least squares from a fixed sequence of starts",
        };
        let refined = if self.exact || self.structure == ArmStructure::General {
            ""
        } else {
            "; refined numerically, since the arm is only nearly so built"
        };
        format!("{what}{refined}; every solution is measured by forward kinematics")
    }
}

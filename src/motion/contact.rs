//! A pair of bodies that come too near each other.

/// What kind of collision it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ContactKind {
    /// Two parts of the arm, or the camera and a part of the arm.
    SelfCollision,
    /// A part and the table.
    Table,
    /// A part and the object.
    Object,
    /// A part and a keep-out region.
    Obstacle,
}

/// Two bodies nearer than their margin.
#[derive(Clone, Debug, PartialEq)]
pub struct Contact {
    /// What kind of collision it is.
    pub kind: ContactKind,
    /// A link's name, or `camera`.
    pub first: String,
    /// The link, the camera, `table`, `object`, or the name of the keep-out region.
    pub second: String,
    /// How far they would have to move apart to keep their margin, metres.
    pub depth_m: f64,
    /// Their signed distance, metres; negative when they overlap.
    pub distance_m: f64,
}

impl std::fmt::Display for Contact {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { first, second, depth_m, distance_m, .. } = self;
        write!(f, "{first} and {second} are {distance_m:.4} m apart, {depth_m:.4} m less than their margin")
    }
}

//! What can be wrong with an ordering problem.

/// Why points could not be ordered.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum OrderError {
    /// There is nothing to order.
    #[error("points is empty, must hold at least 1 point")]
    Empty,
    /// More points than the solver takes.
    #[error("points holds {count} points, must hold at most {max}")]
    TooMany {
        /// Number given.
        count: usize,
        /// Largest number taken.
        max: usize,
    },
    /// The start is no index of a point.
    #[error("start is {start}, must be in 0..{count}")]
    Start {
        /// The index given.
        start: usize,
        /// Number of points.
        count: usize,
    },
    /// A coordinate is NaN, infinite or absurdly large.
    #[error("{field} is {value}, must be finite, within {bound} m, and not negative for a radius")]
    Coordinate {
        /// Which number: `points[3].x`, `obstacle.radius` ...
        field: String,
        /// Its value.
        value: f64,
        /// Largest magnitude taken, metres.
        bound: f64,
    },
    /// A point lies inside the obstacle.
    #[error("points[{index}] lies {depth_m} m inside the obstacle")]
    InsideObstacle {
        /// Index of the point.
        index: usize,
        /// Distance to the obstacle's surface, metres.
        depth_m: f64,
    },
    /// A point lies below the table.
    #[error("points[{index}] lies {depth_m} m below the table")]
    BelowTable {
        /// Index of the point.
        index: usize,
        /// Distance to the table's plane, metres.
        depth_m: f64,
    },
    /// A cost is NaN, infinite or negative.
    #[error("cost from {from} to {to} is {value}, must be finite and not negative")]
    Cost {
        /// Row.
        from: usize,
        /// Column.
        to: usize,
        /// The value.
        value: f64,
    },
    /// A cost matrix is not square.
    #[error("cost matrix has {len} entries, must have {n} x {n}")]
    Shape {
        /// Number of rows expected.
        n: usize,
        /// Number of entries given.
        len: usize,
    },
}

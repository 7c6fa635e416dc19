//! What can be wrong with a request for views.

/// Why no views could be placed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ViewsError {
    /// The number of views lies outside the supported range.
    #[error("number of views is {count}, must be in {min}..={max}")]
    Count {
        /// The number asked for.
        count: usize,
        /// Least number supported.
        min: usize,
        /// Largest number supported.
        max: usize,
    },
    /// A bound of the band is not a number or not an elevation.
    #[error("{field} is {value_deg} deg, must be in -90..=90 deg")]
    Elevation {
        /// `min_elevation` or `max_elevation`.
        field: &'static str,
        /// The value, degrees.
        value_deg: f64,
    },
    /// The band ends below its beginning.
    #[error("max_elevation is {max_deg} deg, must be at least min_elevation, {min_deg} deg")]
    EmptyBand {
        /// Lower bound, degrees.
        min_deg: f64,
        /// Upper bound, degrees.
        max_deg: f64,
    },
    /// The radius of a view space is not a positive, finite length.
    #[error("view space radius is {value_m} m, must be positive and finite")]
    Radius {
        /// The value, metres.
        value_m: f64,
    },
}

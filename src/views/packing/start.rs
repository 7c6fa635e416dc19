//! Where the search begins.

use rand::Rng;

use super::Region;
use crate::geometry::Vector;

/// The fixed point and `n - 1` points uniform over the region's area.
pub(super) fn random_points(n: usize, region: &Region, rng: &mut impl Rng) -> Vec<Vector> {
    let mut points = Vec::with_capacity(n);
    points.push(region.top);
    while points.len() < n {
        // A direction in the plane from the unit disc, so that no sine is needed.
        let (x, y): (f64, f64) = (rng.random_range(-1.0..1.0), rng.random_range(-1.0..1.0));
        let square = x * x + y * y;
        if !(1e-6..=1.0).contains(&square) {
            continue;
        }
        let z = region.low + (region.high - region.low) * rng.random::<f64>();
        let scale = ((1.0 - z * z).max(0.0) / square).sqrt();
        points.push(Vector::new(x * scale, y * scale, z));
    }
    points
}

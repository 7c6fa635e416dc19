//! What the camera must not touch on its way: the object's sphere and the table.

use super::OrderError;
use crate::geometry::Point;

/// Largest magnitude of a coordinate or radius, metres.
pub(super) const LARGEST_M: f64 = 1e6;
/// A point may be this deep in the obstacle, metres: it got there by rounding.
pub(super) const TOUCH_M: f64 = 1e-9;

/// A ball that may be cut by a table: the camera keeps out of the ball and above the table.
/// Clearances are the caller's to add to the radius and to the table's height. A radius of
/// zero is no ball.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Obstacle {
    /// Centre of the ball, metres.
    pub center: Point,
    /// Radius of the ball, metres.
    pub radius_m: f64,
    /// Height of the table's plane (z up), metres; none if there is no table.
    pub table_z_m: Option<f64>,
}

impl Obstacle {
    /// Nothing in the way.
    pub fn none() -> Obstacle {
        Obstacle { center: Point::origin(), radius_m: 0.0, table_z_m: None }
    }

    /// Checks that the obstacle's numbers are finite and that every point is outside.
    ///
    /// # Errors
    /// The first number out of range, or the first point inside the ball or below the table,
    /// with its depth.
    pub fn check(&self, points: &[Point]) -> Result<(), OrderError> {
        number("obstacle.center.x", self.center.x)?;
        number("obstacle.center.y", self.center.y)?;
        number("obstacle.center.z", self.center.z)?;
        number("obstacle.radius", self.radius_m)?;
        if self.radius_m < 0.0 {
            let (field, value) = ("obstacle.radius".into(), self.radius_m);
            return Err(OrderError::Coordinate { field, value, bound: LARGEST_M });
        }
        if let Some(table_z_m) = self.table_z_m {
            number("obstacle.table_z", table_z_m)?;
        }
        for (index, point) in points.iter().enumerate() {
            for (axis, value) in [("x", point.x), ("y", point.y), ("z", point.z)] {
                number(&format!("points[{index}].{axis}"), value)?;
            }
            let depth_m = self.radius_m - (point - self.center).norm();
            if depth_m > TOUCH_M {
                return Err(OrderError::InsideObstacle { index, depth_m });
            }
            let depth_m = self.table_z_m.map_or(0.0, |table_z_m| table_z_m - point.z);
            if depth_m > TOUCH_M {
                return Err(OrderError::BelowTable { index, depth_m });
            }
        }
        Ok(())
    }
}

fn number(field: &str, value: f64) -> Result<(), OrderError> {
    if value.abs() <= LARGEST_M {
        Ok(())
    } else {
        Err(OrderError::Coordinate { field: field.into(), value, bound: LARGEST_M })
    }
}

//! Where the optical axes of a set of views meet.

use crate::geometry::{Direction, Point, Vector};

/// Below this the axes are too parallel to meet: the determinant of the mean projection across them,
/// 0 for parallel lines, 8/27 for lines in all directions.
const LEAST_DETERMINANT: f64 = 1e-9;

/// The point nearest to all lines, by least squares: minimises the sum of squared distances to the
/// lines through `position` along `direction`. Frame and unit are those of the lines.
///
/// `None` for fewer than two lines, parallel ones and coordinates that are not finite.
pub fn common_point(lines: &[(Point, Direction)]) -> Option<Point> {
    let mut normal = nalgebra::Matrix3::<f64>::zeros();
    let mut right = Vector::zeros();
    for (position, direction) in lines {
        let across = nalgebra::Matrix3::identity() - direction.as_ref() * direction.transpose();
        normal += across;
        right += across * position.coords;
    }
    let normal = normal / lines.len().max(1) as f64;
    let right = right / lines.len().max(1) as f64;
    if !(normal.determinant() > LEAST_DETERMINANT) {
        return None;
    }
    let point = normal.try_inverse()? * right;
    point.iter().all(|v| v.is_finite()).then(|| Point::from(point))
}

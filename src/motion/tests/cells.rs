//! Cells and views that the scenarios share.

use nalgebra::{Translation3, UnitQuaternion};

use crate::geometry::{Point, Pose};
use crate::motion::{Cell, CellObject, OrderViews};
use crate::order::{Obstacle, order_points};
use crate::robot::RobotModel;
use crate::views::{Band, ViewSpace, tammes};

/// A camera 60 mm ahead of the flange, looking along its z axis.
pub fn camera_ahead() -> Pose {
    Pose::from_parts(Translation3::new(0.0, 0.0, 0.06), UnitQuaternion::identity())
}

/// A robot with a 0.1 m object on the table at (x, y).
pub fn cell(robot: &str, x: f64, y: f64) -> Cell {
    let mut cell = Cell::new(RobotModel::named(robot).unwrap(), camera_ahead());
    cell.object = Some(CellObject::sphere(Point::new(x, y, 0.1), 0.1));
    cell.table_z_m = Some(0.0);
    cell
}

/// `count` views 0.3 m around the cell's object, 5 to 90 degrees.
pub fn views(cell: &Cell, count: usize, radius_m: f64) -> Vec<Pose> {
    let center_in_base = cell.object.unwrap().center_in_base;
    let space = ViewSpace { center_in_base, radius_m, band: Band::DEFAULT };
    tammes(count, Band::DEFAULT).unwrap().directions.iter().map(|d| space.pose(d, 0.0)).collect()
}

/// Orders by the shortest camera path around the object.
pub fn by_camera_path(cell: &Cell, views: &[Pose]) -> impl Fn(&[usize], usize) -> Vec<usize> {
    let object = cell.object.unwrap();
    let obstacle =
        Obstacle { center: object.center_in_base, radius_m: object.radius_m, table_z_m: cell.table_z_m };
    let points: Vec<Point> = views.iter().map(|p| Point::from(p.translation.vector)).collect();
    move |reachable, first| {
        let points: Vec<Point> = reachable.iter().map(|&i| points[i]).collect();
        order_points(&points, first, &obstacle, std::time::Duration::from_secs(5)).unwrap().order
    }
}

/// Keeps the callback's type short.
pub fn as_order<'a>(f: &'a impl Fn(&[usize], usize) -> Vec<usize>) -> OrderViews<'a> {
    f
}

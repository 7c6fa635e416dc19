//! Bounds of a request's numbers. The API description declares what is checked here.

/// Largest coordinate of the object's centre and of the table, metres: beyond any arm's reach.
pub const FARTHEST_M: f64 = 5.0;
/// Least and largest radius of an object, metres.
pub const OBJECT_RADIUS_M: (f64, f64) = (0.005, 1.0);
/// Least and largest radius of the view shell, metres.
pub const SHELL_RADIUS_M: (f64, f64) = (1e-3, 3.0);
/// Smallest edge, radius or height of an object's shape, metres.
pub const SMALLEST_SHAPE_M: f64 = 1e-3;
/// Largest yaw of a box, radians.
pub const LARGEST_YAW_RAD: f64 = std::f64::consts::TAU;
/// Largest clearance kept, metres.
pub const LARGEST_MARGIN_M: f64 = 0.2;
/// Most keep-out regions.
pub const MAX_KEEP_OUT: usize = 64;
/// Most solids of the camera's body, and of the tool.
pub const MAX_SOLIDS: usize = 32;
/// Smallest edge, radius or height of a solid, metres.
pub const SMALLEST_SOLID_M: f64 = 1e-4;
/// Largest coordinate and size of a solid in the cell, metres.
pub const SOLID_IN_CELL_M: (f64, f64) = (5.0, 10.0);
/// Largest coordinate and size of a solid on the flange, metres.
pub const SOLID_ON_FLANGE_M: (f64, f64) = (2.0, 2.0);
/// Most rows and columns of a reachability grid.
pub const MOST_ROWS_AND_COLUMNS: (usize, usize) = (90, 360);

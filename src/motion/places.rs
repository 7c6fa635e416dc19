//! Where in a cell an object could stand.

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::cell::Cell;
use super::distance::shape_shape;
use crate::geometry::Pose;

/// Random states that tell how far the arm reaches.
const REACH_SAMPLES: usize = 500;

/// Whether the cell's object is clear of all its keep-out regions.
pub fn object_stands_clear(cell: &Cell) -> bool {
    let identity = Pose::identity();
    let Some(object) = &cell.object else { return true };
    let solid = object.solid_in_base();
    let apart_m = |shape| shape_shape(&identity, &solid, &identity, shape);
    cell.keep_out.iter().all(|region| apart_m(&region.shape_in_base) > 0.0)
}

/// About the farthest that the camera gets from the base's origin, metres.
pub fn farthest_reach_m(cell: &Cell) -> f64 {
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    let mut farthest_m = 0.0f64;
    for _ in 0..REACH_SAMPLES {
        let joints = cell.robot.joints.iter();
        let state: Vec<f64> =
            joints.map(|j| j.lower_rad + (j.upper_rad - j.lower_rad) * rng.random::<f64>()).collect();
        let base_from_camera = cell.robot.kinematics.forward(&state) * cell.flange_from_camera;
        farthest_m = farthest_m.max(base_from_camera.translation.vector.norm());
    }
    farthest_m
}

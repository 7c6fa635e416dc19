//! The cube a NeRF fills.

use super::NerfError;
use crate::geometry::{Point, Pose, Vector};
use crate::imaging::transforms::SceneCube;

/// An axis-aligned cube in the world frame. What lies outside is not seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// Centre, metres, world frame.
    pub center: Point,
    /// Half the edge, metres.
    pub half_extent_m: f64,
}

impl From<SceneCube> for Bounds {
    fn from(cube: SceneCube) -> Bounds {
        Bounds { center: cube.center, half_extent_m: cube.half_extent_m }
    }
}

impl Bounds {
    /// Checks that the numbers are finite and the cube has a size.
    ///
    /// # Errors
    /// [`NerfError::Bounds`] names the first number that is out of range.
    pub fn check(&self) -> Result<(), NerfError> {
        for (field, value) in
            [("center.x", self.center.x), ("center.y", self.center.y), ("center.z", self.center.z)]
        {
            if !value.is_finite() || value.abs() >= 1e6 {
                return Err(NerfError::Bounds { field, value, bound: "finite and less than 1e6 in size" });
            }
        }
        if !(1e-6..1e6).contains(&self.half_extent_m) {
            let (field, value) = ("half_extent_m", self.half_extent_m);
            return Err(NerfError::Bounds { field, value, bound: "1e-6 to 1e6" });
        }
        Ok(())
    }

    /// The camera's centre in the unit cube.
    pub(super) fn origin_in_cube(&self, world_from_camera: &Pose) -> [f32; 3] {
        let from_center: Vector = world_from_camera.translation.vector - self.center.coords;
        let scaled = from_center / (2.0 * self.half_extent_m);
        [scaled.x as f32 + 0.5, scaled.y as f32 + 0.5, scaled.z as f32 + 0.5]
    }
}

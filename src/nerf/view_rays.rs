//! The rays of one camera at one pose, in the unit cube.

use nalgebra::Vector2;

use super::{Bounds, ray::Ray};
use crate::geometry::{Pose, Vector};
use crate::imaging::Camera;

/// Makes the rays through a camera's pixel centres.
pub(super) struct ViewRays {
    origin: [f32; 3],
    /// World axes of camera x, y and z.
    axes: [[f32; 3]; 3],
    pub width: u32,
    pub height: u32,
    inverse_focal: [f32; 2],
    principal: [f32; 2],
    /// Undistorted x / z and y / z of every pixel centre, if the lens distorts:
    /// undoing that takes an iteration.
    undistorted: Option<Vec<[f32; 2]>>,
}

impl ViewRays {
    pub fn new(camera: &Camera, world_from_camera: &Pose, bounds: &Bounds) -> ViewRays {
        let axis = |v: Vector| {
            let v = world_from_camera.rotation * v;
            [v.x as f32, v.y as f32, v.z as f32]
        };
        let undistorted = (!camera.distortion.is_none()).then(|| {
            let pixels = (0..camera.height).flat_map(|y| (0..camera.width).map(move |x| (x, y)));
            pixels
                .map(|(x, y)| {
                    let ray = camera.ray_in_camera(Vector2::new(f64::from(x) + 0.5, f64::from(y) + 0.5));
                    [ray.x as f32, ray.y as f32]
                })
                .collect()
        });
        ViewRays {
            origin: bounds.origin_in_cube(world_from_camera),
            axes: [axis(Vector::x()), axis(Vector::y()), axis(Vector::z())],
            width: camera.width,
            height: camera.height,
            inverse_focal: [(1.0 / camera.fx) as f32, (1.0 / camera.fy) as f32],
            principal: [camera.cx as f32, camera.cy as f32],
            undistorted,
        }
    }

    /// The ray through the centre of a pixel, counted row by row; `None` if it
    /// misses the cube. `phase` shifts its samples by parts of a step.
    pub fn ray(&self, pixel: u32, phase: f32) -> Option<Ray> {
        let [x, y] = match &self.undistorted {
            Some(table) => *table.get(pixel as usize)?,
            None => {
                let (column, row) = (pixel % self.width, pixel / self.width);
                [
                    (column as f32 + 0.5 - self.principal[0]) * self.inverse_focal[0],
                    (row as f32 + 0.5 - self.principal[1]) * self.inverse_focal[1],
                ]
            }
        };
        let [right, down, forward] = &self.axes;
        let scale = 1.0 / (x * x + y * y + 1.0).sqrt();
        let direction = std::array::from_fn(|a| (x * right[a] + y * down[a] + forward[a]) * scale);
        Ray::through_cube(self.origin, direction, phase)
    }
}

//! The pinhole camera with Brown-Conrady distortion (OpenCV's five-parameter model).

use nalgebra::{Vector2, Vector3};

use crate::geometry::Point;

/// Distortion coefficients in OpenCV's order k1, k2, p1, p2, k3; all zero for none.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Distortion {
    /// Radial, r^2.
    pub k1: f64,
    /// Radial, r^4.
    pub k2: f64,
    /// Tangential.
    pub p1: f64,
    /// Tangential.
    pub p2: f64,
    /// Radial, r^6.
    pub k3: f64,
}

/// Pinhole intrinsics in pixels; pixel centres lie at half-integers, so the
/// image covers `[0, width] x [0, height]`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Image width, pixels.
    pub width: u32,
    /// Image height, pixels.
    pub height: u32,
    /// Focal length along x, pixels.
    pub fx: f64,
    /// Focal length along y, pixels.
    pub fy: f64,
    /// Principal point x, pixels.
    pub cx: f64,
    /// Principal point y, pixels.
    pub cy: f64,
    /// Lens distortion.
    pub distortion: Distortion,
}

/// Why intrinsics cannot be used.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum CameraError {
    /// A number is not finite or outside its bound.
    #[error("camera {field} is {value}, must be {bound}")]
    OutOfRange {
        /// The field's name.
        field: &'static str,
        /// The value given.
        value: f64,
        /// The bound in words.
        bound: &'static str,
    },
}

impl Distortion {
    /// True when every coefficient is zero.
    pub fn is_none(&self) -> bool {
        *self == Self::default()
    }

    /// Distorts normalised image coordinates (x/z, y/z).
    pub fn distort(&self, p: Vector2<f64>) -> Vector2<f64> {
        let r2 = p.norm_squared();
        let radial = 1.0 + r2 * (self.k1 + r2 * (self.k2 + r2 * self.k3));
        let (x, y) = (p.x, p.y);
        Vector2::new(
            x * radial + 2.0 * self.p1 * x * y + self.p2 * (r2 + 2.0 * x * x),
            y * radial + self.p1 * (r2 + 2.0 * y * y) + 2.0 * self.p2 * x * y,
        )
    }

    /// Inverse of [`Self::distort`] by fixed-point iteration (as OpenCV's `undistortPoints`), to 1e-12.
    pub fn undistort(&self, distorted: Vector2<f64>) -> Vector2<f64> {
        if self.is_none() {
            return distorted;
        }
        let mut p = distorted;
        for _ in 0..50 {
            let r2 = p.norm_squared();
            let radial = 1.0 + r2 * (self.k1 + r2 * (self.k2 + r2 * self.k3));
            let (x, y) = (p.x, p.y);
            let shift = Vector2::new(
                2.0 * self.p1 * x * y + self.p2 * (r2 + 2.0 * x * x),
                self.p1 * (r2 + 2.0 * y * y) + 2.0 * self.p2 * x * y,
            );
            let next = (distorted - shift) / radial;
            let step = (next - p).norm();
            p = next;
            if step < 1e-12 {
                break;
            }
        }
        p
    }
}

impl Camera {
    /// Least and most pixels of an image's side.
    pub const SIDE_PX: (u32, u32) = (1, 16_384);
    /// Focal lengths and the principal point's coordinates are less than this, pixels.
    pub const FARTHEST_PX: f64 = 1e6;
    /// Distortion coefficients are less than this in size.
    pub const LARGEST_DISTORTION: f64 = 100.0;

    /// The colour camera of an Intel RealSense D435 as the paper's authors used it
    /// (1280x720; facts of the authors' system).
    pub const REALSENSE_D435: Camera = Camera {
        width: 1280,
        height: 720,
        fx: 915.607,
        fy: 913.327,
        cx: 647.145,
        cy: 372.515,
        distortion: Distortion { k1: 0.0, k2: 0.0, p1: 0.0, p2: 0.0, k3: 0.0 },
    };

    /// A square distortion-free camera of `size_px` pixels a side whose half field
    /// of view has the tangent `tan_half_fov`.
    pub fn square(size_px: u32, tan_half_fov: f64) -> Camera {
        let half = f64::from(size_px) / 2.0;
        let f = half / tan_half_fov;
        Camera {
            width: size_px,
            height: size_px,
            fx: f,
            fy: f,
            cx: half,
            cy: half,
            distortion: Distortion::default(),
        }
    }

    /// Checks that every number is finite and in range.
    ///
    /// # Errors
    /// [`CameraError::OutOfRange`] names the first field that is not.
    pub fn check(&self) -> Result<(), CameraError> {
        let out = |field, value, bound| Err(CameraError::OutOfRange { field, value, bound });
        for (field, value) in [("width", self.width), ("height", self.height)] {
            if !(Self::SIDE_PX.0..=Self::SIDE_PX.1).contains(&value) {
                return out(field, f64::from(value), "1 to 16384 pixels");
            }
        }
        for (field, value) in [("fx", self.fx), ("fy", self.fy)] {
            if !(value.is_finite() && value > 0.0 && value < Self::FARTHEST_PX) {
                return out(field, value, "greater than 0 and less than 1e6 pixels");
            }
        }
        for (field, value) in [("cx", self.cx), ("cy", self.cy)] {
            if !(value.is_finite() && value.abs() < Self::FARTHEST_PX) {
                return out(field, value, "finite and less than 1e6 pixels in size");
            }
        }
        let d = &self.distortion;
        for (field, value) in [("k1", d.k1), ("k2", d.k2), ("p1", d.p1), ("p2", d.p2), ("k3", d.k3)] {
            if !(value.is_finite() && value.abs() < Self::LARGEST_DISTORTION) {
                return out(field, value, "finite and less than 100 in size");
            }
        }
        Ok(())
    }

    /// The pixel at which `point_in_camera` is seen; `None` behind the camera.
    pub fn project(&self, point_in_camera: &Point) -> Option<Vector2<f64>> {
        if point_in_camera.z <= 0.0 {
            return None;
        }
        let p =
            self.distortion.distort(Vector2::new(point_in_camera.x, point_in_camera.y) / point_in_camera.z);
        Some(Vector2::new(self.fx * p.x + self.cx, self.fy * p.y + self.cy))
    }

    /// The ray through `pixel` in the camera frame, scaled so that z = 1 (not a unit vector).
    pub fn ray_in_camera(&self, pixel: Vector2<f64>) -> Vector3<f64> {
        let p = self
            .distortion
            .undistort(Vector2::new((pixel.x - self.cx) / self.fx, (pixel.y - self.cy) / self.fy));
        Vector3::new(p.x, p.y, 1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn a_distorted_pixel_goes_back_along_its_ray(x in -0.4..0.4f64, y in -0.3..0.3f64) {
            let camera = Camera {
                distortion: Distortion { k1: 0.12, k2: -0.25, p1: 0.001, p2: -0.0007, k3: 0.08 },
                ..Camera::REALSENSE_D435
            };
            let pixel = camera.project(&Point::new(x * 0.3, y * 0.3, 0.3)).unwrap();
            let ray = camera.ray_in_camera(pixel);
            prop_assert!((ray.x - x).abs() < 1e-9 && (ray.y - y).abs() < 1e-9);
        }
    }

    #[test]
    fn a_camera_with_nan_names_the_field() {
        let camera = Camera { fy: f64::NAN, ..Camera::REALSENSE_D435 };
        assert!(matches!(camera.check(), Err(CameraError::OutOfRange { field: "fy", .. })));
    }
}

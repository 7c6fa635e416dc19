//! The object to photograph, as what the arm must not touch.

use nalgebra::{Translation3, UnitQuaternion};

use crate::geometry::{Point, Pose, Vector};
use crate::robot::LinkShape;

/// The object: its enclosing sphere, and the solid in it that nothing may enter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CellObject {
    /// Centre of the enclosing sphere and of the solid, in the arm's base frame, metres.
    pub center_in_base: Point,
    /// Radius of the enclosing sphere, metres.
    pub radius_m: f64,
    /// The solid.
    pub shape: ObjectShape,
}

/// What of the enclosing sphere the object fills. All shapes stand upright about its centre.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum ObjectShape {
    /// The whole sphere.
    #[default]
    Sphere,
    /// A cylinder about the vertical.
    Cylinder {
        /// Radius, metres.
        radius_m: f64,
        /// Height, metres.
        height_m: f64,
    },
    /// A box turned about the vertical.
    Cuboid {
        /// Edge lengths along its x, y and z, metres.
        size_m: Vector,
        /// Turn of its x axis from the base's, radians.
        yaw_rad: f64,
    },
}

impl ObjectShape {
    /// Radius of the smallest sphere about the centre that holds the shape, metres;
    /// `None` for the sphere, which is as large as it is said to be.
    pub fn reach_m(&self) -> Option<f64> {
        match self {
            Self::Sphere => None,
            Self::Cylinder { radius_m, height_m } => Some(radius_m.hypot(0.5 * height_m)),
            Self::Cuboid { size_m, .. } => Some(0.5 * size_m.norm()),
        }
    }
}

impl CellObject {
    /// An object that fills its enclosing sphere.
    pub fn sphere(center_in_base: Point, radius_m: f64) -> Self {
        Self { center_in_base, radius_m, shape: ObjectShape::Sphere }
    }

    /// The solid in the base frame.
    pub fn solid_in_base(&self) -> LinkShape {
        let at = Translation3::from(self.center_in_base.coords);
        match self.shape {
            ObjectShape::Sphere => LinkShape::Capsule {
                from_in_link: self.center_in_base,
                to_in_link: self.center_in_base,
                radius_m: self.radius_m,
            },
            ObjectShape::Cylinder { radius_m, height_m } => LinkShape::Cylinder {
                link_from_cylinder: Pose::from_parts(at, UnitQuaternion::identity()),
                half_length_m: 0.5 * height_m,
                radius_m,
            },
            ObjectShape::Cuboid { size_m, yaw_rad } => LinkShape::Cuboid {
                link_from_box: Pose::from_parts(
                    at,
                    UnitQuaternion::from_axis_angle(&Vector::z_axis(), yaw_rad),
                ),
                half_extents_m: 0.5 * size_m,
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::motion::distance::shape_point;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn a_shape_reaches_as_far_as_it_says_and_no_farther(
            x in 0.01..0.3f64, y in 0.01..0.3f64, z in 0.01..0.3f64, yaw in -3.0..3.0f64, azimuth in -3.0..3.0f64,
        ) {
            let center = Point::new(0.3, -0.2, 0.1);
            for shape in [
                ObjectShape::Cylinder { radius_m: x, height_m: z },
                ObjectShape::Cuboid { size_m: Vector::new(x, y, z), yaw_rad: yaw },
            ] {
                let reach = shape.reach_m().unwrap();
                let solid = CellObject { center_in_base: center, radius_m: reach, shape }.solid_in_base();
                let corner = match shape {
                    ObjectShape::Cuboid { size_m, yaw_rad } => {
                        UnitQuaternion::from_axis_angle(&Vector::z_axis(), yaw_rad) * (0.5 * size_m)
                    }
                    _ => Vector::new(x * azimuth.cos(), x * azimuth.sin(), 0.5 * z),
                };
                prop_assert!((corner.norm() - reach).abs() < 1e-12);
                let distance = |p: Point| shape_point(&Pose::identity(), &solid, &p);
                prop_assert!(distance(center + corner).abs() < 1e-12);
                prop_assert!(distance(center + corner * 1.01) > 0.0 && distance(center + corner * 0.99) < 0.0);
                prop_assert!(distance(center) < 0.0);
            }
        }
    }
}

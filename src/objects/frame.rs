//! Where parts are put.

use nalgebra::{Matrix3, Vector3};

use super::exact::{cos_turns, sin_turns};

/// A point or direction, metres.
pub(super) type V = Vector3<f64>;

/// A point from its coordinates.
pub(super) fn v(x: f64, y: f64, z: f64) -> V {
    V::new(x, y, z)
}

/// An affine map from a part's own frame to the object's.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame {
    linear: Matrix3<f64>,
    origin: V,
}

impl Frame {
    /// Leaves everything where it is.
    pub(super) const fn identity() -> Self {
        Self {
            linear: Matrix3::new(1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0),
            origin: V::new(0.0, 0.0, 0.0),
        }
    }

    /// Moves by a vector of the part's frame.
    pub(super) fn moved(self, x: f64, y: f64, z: f64) -> Self {
        Self { origin: self.point(v(x, y, z)), ..self }
    }

    /// Turns about an axis (0: x, 1: y, 2: z) of the part's frame, right-handed.
    pub(super) fn turned(self, axis: usize, turns: f64) -> Self {
        let (s, c) = (sin_turns(turns), cos_turns(turns));
        let turn = match axis {
            0 => Matrix3::new(1.0, 0.0, 0.0, 0.0, c, -s, 0.0, s, c),
            1 => Matrix3::new(c, 0.0, s, 0.0, 1.0, 0.0, -s, 0.0, c),
            _ => Matrix3::new(c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0),
        };
        Self { linear: self.linear * turn, ..self }
    }

    /// Stretches along the part's axes; a negative factor mirrors.
    pub(super) fn stretched(self, x: f64, y: f64, z: f64) -> Self {
        Self { linear: self.linear * Matrix3::from_diagonal(&v(x, y, z)), ..self }
    }

    /// Puts the part's z axis along `direction`, at `origin`; both in this frame.
    pub(super) fn along(self, origin: V, direction: V) -> Self {
        let z = direction.try_normalize(1e-12).unwrap_or(V::z());
        let helper = if z.x.abs() < 0.9 { V::x() } else { V::y() };
        let y = z.cross(&helper).normalize();
        let turn = Matrix3::from_columns(&[y.cross(&z), y, z]);
        Self { linear: self.linear * turn, origin: self.point(origin) }
    }

    /// This map after another.
    pub(super) fn after(self, inner: Frame) -> Self {
        Self { linear: self.linear * inner.linear, origin: self.point(inner.origin) }
    }

    /// A point of the part's frame in the object's.
    pub(super) fn point(&self, p: V) -> V {
        self.linear * p + self.origin
    }

    /// True when the map turns surfaces inside out.
    pub(super) fn mirrors(&self) -> bool {
        self.linear.determinant() < 0.0
    }
}

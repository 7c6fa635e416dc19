//! Joint vectors of fixed size, so that the inner loops neither allocate nor check lengths.

/// The most joints an arm may have in this room; a whole number of vector registers.
pub(crate) const MAX_JOINTS: usize = 8;

/// Joint angles in radians, joint order, unused entries zero.
pub(crate) type Joints = [f64; MAX_JOINTS];

/// `values` padded with zeros; what lies beyond [`MAX_JOINTS`] is dropped.
pub(crate) fn joints_from(values: &[f64]) -> Joints {
    let mut out = [0.0; MAX_JOINTS];
    for (slot, value) in out.iter_mut().zip(values) {
        *slot = *value;
    }
    out
}

/// `from + t (to - from)`.
pub(crate) fn lerp(from: &Joints, to: &Joints, t: f64) -> Joints {
    std::array::from_fn(|j| from[j] + t * (to[j] - from[j]))
}

/// `to - from`.
pub(crate) fn difference(from: &Joints, to: &Joints) -> Joints {
    std::array::from_fn(|j| to[j] - from[j])
}

/// Euclidean length in joint space.
pub(crate) fn norm(step: &Joints) -> f64 {
    step.iter().map(|d| d * d).sum::<f64>().sqrt()
}

//! Aligned storage: samples in lanes, parameters in cache lines.

/// Samples in a block.
pub(in crate::nerf) const LANES: usize = 64;

/// One quantity of the samples of a block.
#[repr(C, align(64))]
#[derive(Clone, Copy, Debug)]
pub(in crate::nerf) struct Lanes(pub [f32; LANES]);

impl Lanes {
    pub(in crate::nerf) const ZERO: Lanes = Lanes([0.0; LANES]);
}

/// Floats in a cache line.
pub(in crate::nerf) const LINE: usize = 16;

/// One cache line of parameters, gradients or moments.
#[repr(C, align(64))]
#[derive(Clone, Copy, Debug)]
pub(in crate::nerf) struct Line(pub [f32; LINE]);

impl Line {
    pub(in crate::nerf) const ZERO: Line = Line([0.0; LINE]);
}

/// The floats of `lines`.
pub(in crate::nerf) fn flat(lines: &[Line]) -> &[f32] {
    // SAFETY: a Line is repr(C) with 16 floats and 64 bytes, so it has no padding.
    unsafe { std::slice::from_raw_parts(lines.as_ptr().cast(), lines.len() * LINE) }
}

/// The floats of `lines`.
pub(in crate::nerf) fn flat_mut(lines: &mut [Line]) -> &mut [f32] {
    // SAFETY: as in `flat`; the borrow is exclusive.
    unsafe { std::slice::from_raw_parts_mut(lines.as_mut_ptr().cast(), lines.len() * LINE) }
}

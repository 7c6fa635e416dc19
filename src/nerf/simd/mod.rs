//! One source for every instruction set.
//!
//! A kernel is written once over [`Simd`], a token that proves that the CPU has
//! the instructions behind its methods. [`kernel!`] compiles it three times and
//! picks by [`InstructionSet`]. Samples sit in lanes: [`Lanes`] holds one
//! quantity of [`LANES`] samples.

#[cfg(target_arch = "x86_64")]
mod avx2;
#[cfg(target_arch = "x86_64")]
mod avx512;
mod dispatch;
mod instruction_set;
mod lanes;
mod lines;
mod portable;
mod prefetch;

#[cfg(target_arch = "x86_64")]
pub(super) use avx2::Avx2;
#[cfg(target_arch = "x86_64")]
pub(super) use avx512::Avx512;
pub(super) use dispatch::kernel;
pub use instruction_set::InstructionSet;
pub(super) use instruction_set::Kind;
pub(super) use lanes::{LANES, LINE, Lanes, Line, flat, flat_mut};
pub(super) use lines::Lines;
pub(super) use portable::Portable;
pub(super) use prefetch::prefetch;

/// Adding and taking away this constant rounds an `f32` below 2^22 to an integer;
/// while it is added, that integer stands in the low bits.
pub(super) const ROUNDING: f32 = 12_582_912.0;

/// The vector operations the kernels need. `V` holds `WIDTH` floats, `Quad` four
/// (one entry of the hash grid) and `Pair` eight (two neighbouring entries).
pub(super) trait Simd: Copy {
    /// Floats in a `V`; divides 16.
    const WIDTH: usize;
    type V: Copy;
    type Pair: Copy;
    type Quad: Copy;

    fn splat(self, x: f32) -> Self::V;
    /// `from[at..at + WIDTH]`
    fn load(self, from: &[f32], at: usize) -> Self::V;
    /// Writes `to[at..at + WIDTH]`.
    fn store(self, to: &mut [f32], at: usize, x: Self::V);
    fn add(self, a: Self::V, b: Self::V) -> Self::V;
    fn sub(self, a: Self::V, b: Self::V) -> Self::V;
    fn mul(self, a: Self::V, b: Self::V) -> Self::V;
    fn div(self, a: Self::V, b: Self::V) -> Self::V;
    /// `a * b + c`
    fn fma(self, a: Self::V, b: Self::V, c: Self::V) -> Self::V;
    fn max(self, a: Self::V, b: Self::V) -> Self::V;
    fn min(self, a: Self::V, b: Self::V) -> Self::V;
    fn sqrt(self, a: Self::V) -> Self::V;
    /// `x` where `mask > 0`, else 0.
    fn where_positive(self, mask: Self::V, x: Self::V) -> Self::V;
    /// 2^n for `n + ROUNDING`, n in -126..=127.
    fn exp2_of_rounded(self, n: Self::V) -> Self::V;

    /// Eight floats from `from`.
    ///
    /// # Safety
    /// `from..from + 8` must be readable.
    unsafe fn load_pair(self, from: *const f32) -> Self::Pair;
    /// `to[0..8] += w * x`
    ///
    /// # Safety
    /// `to..to + 8` must be readable and writable.
    unsafe fn add_to_pair(self, to: *mut f32, w: f32, x: Self::Pair);
    fn scale_pair(self, x: Self::Pair, w: f32) -> Self::Pair;
    /// `x * w + sum`
    fn fma_pair(self, x: Self::Pair, w: f32, sum: Self::Pair) -> Self::Pair;
    /// `(1 - f) * low half + f * high half`
    fn blend_halves(self, x: Self::Pair, f: f32) -> Self::Quad;
    /// The transpose of [`Self::blend_halves`]: `[(1 - f) * x, f * x]`.
    fn spread_halves(self, x: Self::Quad, f: f32) -> Self::Pair;
    /// `from[at..at + 4]`
    fn load_quad(self, from: &[f32], at: usize) -> Self::Quad;
    /// Writes `to[at..at + 4]`.
    fn store_quad(self, to: &mut [f32], at: usize, x: Self::Quad);
    fn transpose(self, rows: [Self::Quad; 4]) -> [Self::Quad; 4];

    /// e^x, relative error below 1e-6; arguments are clamped to +-87.
    #[inline(always)]
    fn exp(self, x: Self::V) -> Self::V {
        let x = self.max(self.min(x, self.splat(87.0)), self.splat(-87.0));
        let rounded = self.fma(x, self.splat(std::f32::consts::LOG2_E), self.splat(ROUNDING));
        let n = self.sub(rounded, self.splat(ROUNDING));
        // ln 2 in two parts keeps the reduced argument exact (Cody and Waite).
        let r = self.fma(n, self.splat(-0.693_359_4), x);
        let r = self.fma(n, self.splat(2.121_944_4e-4), r);
        let mut p = self.splat(1.0 / 720.0);
        for c in [1.0 / 120.0, 1.0 / 24.0, 1.0 / 6.0, 0.5, 1.0, 1.0] {
            p = self.fma(p, r, self.splat(c));
        }
        self.mul(p, self.exp2_of_rounded(rounded))
    }
}

#[cfg(test)]
mod tests;

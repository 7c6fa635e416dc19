//! AVX-512: sixteen floats a vector; pairs and quads as with AVX2.

use std::arch::x86_64::*;

use super::{Avx2, Simd};

/// Proof that the CPU has AVX2, FMA and AVX-512 F, VL, DQ and BW.
#[derive(Clone, Copy)]
pub(in crate::nerf) struct Avx512(Avx2);

impl Avx512 {
    /// # Safety
    /// The CPU must have AVX2, FMA and AVX-512 F, VL, DQ and BW.
    #[inline(always)]
    pub(in crate::nerf) unsafe fn assume() -> Self {
        // SAFETY: the caller vouches for AVX2 and FMA too.
        Avx512(unsafe { Avx2::assume() })
    }
}

macro_rules! lanewise {
    ($($name:ident($($x:ident),*) = $e:expr;)*) => {$(
        #[inline(always)]
        fn $name(self, $($x: __m512),*) -> __m512 {
            // SAFETY: the token proves the features.
            unsafe { $e }
        }
    )*};
}

// SAFETY of every block below: the token proves the features, slices are checked.
impl Simd for Avx512 {
    const WIDTH: usize = 16;
    type V = __m512;
    type Pair = __m256;
    type Quad = __m128;

    #[inline(always)]
    fn splat(self, x: f32) -> __m512 {
        unsafe { _mm512_set1_ps(x) }
    }
    #[inline(always)]
    fn load(self, from: &[f32], at: usize) -> __m512 {
        let from = &from[at..at + 16];
        unsafe { _mm512_loadu_ps(from.as_ptr()) }
    }
    #[inline(always)]
    fn store(self, to: &mut [f32], at: usize, x: __m512) {
        let to = &mut to[at..at + 16];
        unsafe { _mm512_storeu_ps(to.as_mut_ptr(), x) }
    }
    lanewise! {
        add(a, b) = _mm512_add_ps(a, b);
        sub(a, b) = _mm512_sub_ps(a, b);
        mul(a, b) = _mm512_mul_ps(a, b);
        div(a, b) = _mm512_div_ps(a, b);
        fma(a, b, c) = _mm512_fmadd_ps(a, b, c);
        max(a, b) = _mm512_max_ps(a, b);
        min(a, b) = _mm512_min_ps(a, b);
        sqrt(a) = _mm512_sqrt_ps(a);
        where_positive(mask, x) =
            _mm512_maskz_mov_ps(_mm512_cmp_ps_mask::<_CMP_GT_OQ>(mask, _mm512_setzero_ps()), x);
        exp2_of_rounded(n) = _mm512_castsi512_ps(_mm512_add_epi32(
            _mm512_slli_epi32::<23>(_mm512_castps_si512(n)),
            _mm512_set1_epi32(127 << 23),
        ));
    }

    #[inline(always)]
    unsafe fn load_pair(self, from: *const f32) -> __m256 {
        unsafe { self.0.load_pair(from) }
    }
    #[inline(always)]
    unsafe fn add_to_pair(self, to: *mut f32, w: f32, x: __m256) {
        unsafe { self.0.add_to_pair(to, w, x) }
    }
    #[inline(always)]
    fn scale_pair(self, x: __m256, w: f32) -> __m256 {
        self.0.scale_pair(x, w)
    }
    #[inline(always)]
    fn fma_pair(self, x: __m256, w: f32, sum: __m256) -> __m256 {
        self.0.fma_pair(x, w, sum)
    }
    #[inline(always)]
    fn blend_halves(self, x: __m256, f: f32) -> __m128 {
        self.0.blend_halves(x, f)
    }
    #[inline(always)]
    fn spread_halves(self, x: __m128, f: f32) -> __m256 {
        self.0.spread_halves(x, f)
    }
    #[inline(always)]
    fn load_quad(self, from: &[f32], at: usize) -> __m128 {
        self.0.load_quad(from, at)
    }
    #[inline(always)]
    fn store_quad(self, to: &mut [f32], at: usize, x: __m128) {
        self.0.store_quad(to, at, x);
    }
    #[inline(always)]
    fn transpose(self, rows: [__m128; 4]) -> [__m128; 4] {
        self.0.transpose(rows)
    }
}

//! AVX2 with fused multiply-add: eight floats a vector.
//!
//! Every method is sound because an [`Avx2`] exists only where the CPU has AVX2
//! and FMA (see [`Avx2::assume`]); loads and stores take a checked slice, except
//! the pair accesses, whose callers vouch for the address.

use std::arch::x86_64::*;

use super::Simd;

/// Proof that the CPU has AVX2 and FMA.
#[derive(Clone, Copy)]
pub(in crate::nerf) struct Avx2(());

impl Avx2 {
    /// # Safety
    /// The CPU must have AVX2 and FMA.
    #[inline(always)]
    pub(in crate::nerf) unsafe fn assume() -> Self {
        Avx2(())
    }
}

macro_rules! lanewise {
    ($($name:ident($($x:ident),*) = $e:expr;)*) => {$(
        #[inline(always)]
        fn $name(self, $($x: __m256),*) -> __m256 {
            // SAFETY: the token proves the features.
            unsafe { $e }
        }
    )*};
}

// SAFETY of every block below: the token proves the features, slices are checked.
impl Simd for Avx2 {
    const WIDTH: usize = 8;
    type V = __m256;
    type Pair = __m256;
    type Quad = __m128;

    #[inline(always)]
    fn splat(self, x: f32) -> __m256 {
        unsafe { _mm256_set1_ps(x) }
    }
    #[inline(always)]
    fn load(self, from: &[f32], at: usize) -> __m256 {
        let from = &from[at..at + 8];
        unsafe { _mm256_loadu_ps(from.as_ptr()) }
    }
    #[inline(always)]
    fn store(self, to: &mut [f32], at: usize, x: __m256) {
        let to = &mut to[at..at + 8];
        unsafe { _mm256_storeu_ps(to.as_mut_ptr(), x) }
    }
    lanewise! {
        add(a, b) = _mm256_add_ps(a, b);
        sub(a, b) = _mm256_sub_ps(a, b);
        mul(a, b) = _mm256_mul_ps(a, b);
        div(a, b) = _mm256_div_ps(a, b);
        fma(a, b, c) = _mm256_fmadd_ps(a, b, c);
        max(a, b) = _mm256_max_ps(a, b);
        min(a, b) = _mm256_min_ps(a, b);
        sqrt(a) = _mm256_sqrt_ps(a);
        where_positive(mask, x) =
            _mm256_and_ps(_mm256_cmp_ps::<_CMP_GT_OQ>(mask, _mm256_setzero_ps()), x);
        exp2_of_rounded(n) = _mm256_castsi256_ps(_mm256_add_epi32(
            _mm256_slli_epi32::<23>(_mm256_castps_si256(n)),
            _mm256_set1_epi32(127 << 23),
        ));
    }

    #[inline(always)]
    unsafe fn load_pair(self, from: *const f32) -> __m256 {
        unsafe { _mm256_loadu_ps(from) }
    }
    #[inline(always)]
    unsafe fn add_to_pair(self, to: *mut f32, w: f32, x: __m256) {
        unsafe { _mm256_storeu_ps(to, _mm256_fmadd_ps(_mm256_set1_ps(w), x, _mm256_loadu_ps(to))) }
    }
    #[inline(always)]
    fn scale_pair(self, x: __m256, w: f32) -> __m256 {
        unsafe { _mm256_mul_ps(x, _mm256_set1_ps(w)) }
    }
    #[inline(always)]
    fn fma_pair(self, x: __m256, w: f32, sum: __m256) -> __m256 {
        unsafe { _mm256_fmadd_ps(x, _mm256_set1_ps(w), sum) }
    }
    #[inline(always)]
    fn blend_halves(self, x: __m256, f: f32) -> __m128 {
        unsafe {
            let low = _mm256_castps256_ps128(x);
            let high = _mm256_extractf128_ps::<1>(x);
            _mm_fmadd_ps(_mm_sub_ps(high, low), _mm_set1_ps(f), low)
        }
    }
    #[inline(always)]
    fn spread_halves(self, x: __m128, f: f32) -> __m256 {
        unsafe {
            let high = _mm_mul_ps(x, _mm_set1_ps(f));
            _mm256_insertf128_ps::<1>(_mm256_castps128_ps256(_mm_sub_ps(x, high)), high)
        }
    }
    #[inline(always)]
    fn load_quad(self, from: &[f32], at: usize) -> __m128 {
        let from = &from[at..at + 4];
        unsafe { _mm_loadu_ps(from.as_ptr()) }
    }
    #[inline(always)]
    fn store_quad(self, to: &mut [f32], at: usize, x: __m128) {
        let to = &mut to[at..at + 4];
        unsafe { _mm_storeu_ps(to.as_mut_ptr(), x) }
    }
    #[inline(always)]
    fn transpose(self, [a, b, c, d]: [__m128; 4]) -> [__m128; 4] {
        unsafe {
            let (ab0, ab1) = (_mm_unpacklo_ps(a, b), _mm_unpackhi_ps(a, b));
            let (cd0, cd1) = (_mm_unpacklo_ps(c, d), _mm_unpackhi_ps(c, d));
            [
                _mm_movelh_ps(ab0, cd0),
                _mm_movehl_ps(cd0, ab0),
                _mm_movelh_ps(ab1, cd1),
                _mm_movehl_ps(cd1, ab1),
            ]
        }
    }
}

//! Plain Rust that every compiler turns into four-wide vectors where it can.

use super::Simd;

/// Needs nothing of the CPU.
#[derive(Clone, Copy)]
pub(in crate::nerf) struct Portable;

/// Four floats.
#[repr(C, align(16))]
#[derive(Clone, Copy)]
pub(in crate::nerf) struct F4([f32; 4]);

macro_rules! lanewise {
    ($name:ident, |$($x:ident),*| $e:expr) => {
        #[inline(always)]
        fn $name(self, $($x: F4),*) -> F4 {
            let mut out = [0.0; 4];
            for i in 0..4 {
                $(let $x = $x.0[i];)*
                out[i] = $e;
            }
            F4(out)
        }
    };
}

impl Simd for Portable {
    const WIDTH: usize = 4;
    type V = F4;
    type Pair = [F4; 2];
    type Quad = F4;

    #[inline(always)]
    fn splat(self, x: f32) -> F4 {
        F4([x; 4])
    }
    #[inline(always)]
    fn load(self, from: &[f32], at: usize) -> F4 {
        let x = &from[at..at + 4];
        F4([x[0], x[1], x[2], x[3]])
    }
    #[inline(always)]
    fn store(self, to: &mut [f32], at: usize, x: F4) {
        to[at..at + 4].copy_from_slice(&x.0);
    }
    lanewise!(add, |a, b| a + b);
    lanewise!(sub, |a, b| a - b);
    lanewise!(mul, |a, b| a * b);
    lanewise!(div, |a, b| a / b);
    // Not `mul_add`: without the instruction it is a slow library call.
    lanewise!(fma, |a, b, c| a * b + c);
    lanewise!(max, |a, b| if a > b { a } else { b });
    lanewise!(min, |a, b| if a < b { a } else { b });
    lanewise!(sqrt, |a| a.sqrt());
    lanewise!(where_positive, |mask, x| if mask > 0.0 { x } else { 0.0 });
    lanewise!(exp2_of_rounded, |n| f32::from_bits((n.to_bits() << 23).wrapping_add(127 << 23)));

    #[inline(always)]
    unsafe fn load_pair(self, from: *const f32) -> [F4; 2] {
        // SAFETY: the caller grants eight floats.
        unsafe { [F4(from.cast::<[f32; 4]>().read()), F4(from.add(4).cast::<[f32; 4]>().read())] }
    }
    #[inline(always)]
    unsafe fn add_to_pair(self, to: *mut f32, w: f32, x: [F4; 2]) {
        for (half, x) in x.iter().enumerate() {
            for (i, x) in x.0.iter().enumerate() {
                // SAFETY: the caller grants eight floats.
                unsafe { *to.add(4 * half + i) += w * x };
            }
        }
    }
    #[inline(always)]
    fn scale_pair(self, x: [F4; 2], w: f32) -> [F4; 2] {
        x.map(|x| self.mul(x, self.splat(w)))
    }
    #[inline(always)]
    fn fma_pair(self, x: [F4; 2], w: f32, sum: [F4; 2]) -> [F4; 2] {
        [self.fma(x[0], self.splat(w), sum[0]), self.fma(x[1], self.splat(w), sum[1])]
    }
    #[inline(always)]
    fn blend_halves(self, x: [F4; 2], f: f32) -> F4 {
        self.fma(self.sub(x[1], x[0]), self.splat(f), x[0])
    }
    #[inline(always)]
    fn spread_halves(self, x: F4, f: f32) -> [F4; 2] {
        let high = self.mul(x, self.splat(f));
        [self.sub(x, high), high]
    }
    #[inline(always)]
    fn load_quad(self, from: &[f32], at: usize) -> F4 {
        self.load(from, at)
    }
    #[inline(always)]
    fn store_quad(self, to: &mut [f32], at: usize, x: F4) {
        self.store(to, at, x);
    }
    #[inline(always)]
    fn transpose(self, rows: [F4; 4]) -> [F4; 4] {
        let mut out = [[0.0; 4]; 4];
        for (r, row) in rows.iter().enumerate() {
            for (c, x) in row.0.iter().enumerate() {
                out[c][r] = *x;
            }
        }
        out.map(F4)
    }
}

//! Compiles a kernel once an instruction set and picks at run time.

/// Declares `fn name(set: InstructionSet, args..)` that runs
/// `body::<S, T>(token, args..)` with the token of `set`. `body` must be
/// `#[inline(always)]`, else it is compiled without the instructions. `T` is the
/// number of vectors that a register tile is wide.
macro_rules! kernel {
    ($(#[$doc:meta])* fn $name:ident($($arg:ident: $ty:ty),* $(,)?) = $body:ident) => {
        $(#[$doc])*
        pub(in crate::nerf) fn $name(set: $crate::nerf::simd::InstructionSet, $($arg: $ty),*) {
            use $crate::nerf::simd::{Kind, Portable};
            #[cfg(target_arch = "x86_64")]
            use $crate::nerf::simd::{Avx2, Avx512};

            #[cfg(target_arch = "x86_64")]
            #[target_feature(enable = "avx2,fma")]
            fn avx2($($arg: $ty),*) {
                // SAFETY: this function's features are those the token stands for.
                $body::<Avx2, 2>(unsafe { Avx2::assume() }, $($arg),*)
            }
            #[cfg(target_arch = "x86_64")]
            #[target_feature(enable = "avx2,fma,avx512f,avx512vl,avx512dq,avx512bw")]
            fn avx512($($arg: $ty),*) {
                // SAFETY: this function's features are those the token stands for.
                $body::<Avx512, 4>(unsafe { Avx512::assume() }, $($arg),*)
            }
            match set.kind() {
                Kind::Portable => $body::<Portable, 2>(Portable, $($arg),*),
                // SAFETY: an `InstructionSet` of this kind exists only where the CPU has the features.
                #[cfg(target_arch = "x86_64")]
                Kind::Avx2 => unsafe { avx2($($arg),*) },
                // SAFETY: as above.
                #[cfg(target_arch = "x86_64")]
                Kind::Avx512 => unsafe { avx512($($arg),*) },
            }
        }
    };
}
pub(in crate::nerf) use kernel;
